#include "core/model/mending.h"

#include "core/base/interruption.h"
#include "core/mesh/signed_volume.h"
#include "core/model/closed_holes.h"
#include "core/model/empty_shells.h"
#include "core/model/local_crossings.h"
#include "core/model/loose_sheets.h"
#include "core/model/manifold_split.h"
#include "core/model/seams.h"
#include "core/model/shell_orientation.h"
#include "core/model/united_bodies.h"
#include "core/model/wrapping.h"
#include "core/query/enclosed_volume.h"
#include "core/query/self_intersection.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace massprops {
namespace {

using Way = std::vector<MendingStep>;

/// From any triangles to a manifold.
const Way kToManifold = {joinedSeams, orientedShells, withoutLooseSheets, splitToManifold};
/// From there to a solid, after its holes are closed.
const Way kToSolid = {withoutLocalCrossings, withoutEmptyShells};
/// What a union leaves is rounded to what the caller can store, and may have slivers that cross, or
/// gaps where they could not be told.
const Way kAfterUnion = {joinedSeams,    orientedShells,     withoutLooseSheets, splitToManifold,
                         closedOpenings, withFewerCrossings, withoutEmptyShells};
constexpr int kMostUnions = 6;

/// Does the steps and writes down what they did. Returns whether they did anything.
bool take(const Way& way, const MendingTask& task, RepairedMesh& model) {
  bool isChanged = false;
  for (const MendingStep step : way) {
    checkpoint();
    MendedMesh next = step(model.mesh, task);
    if (next.done.empty()) continue;
    isChanged = true;
    model.mesh = std::move(next.mesh);
    model.mesh.vertices = task.representable(model.mesh.vertices);
    Repairs& repairs = model.repairs;
    repairs.mended += (repairs.mended.empty() ? "" : ", ") + next.done;
    repairs.distance = std::max(repairs.distance, next.distance);
    if (!next.warning.empty()) repairs.warning = next.warning;
  }
  return isChanged;
}

std::optional<Solid> solidOf(const RepairedMesh& model, const MendingTask& task) {
  try {
    return withoutCrossings(
        makeSolid(model.mesh, task.keepsOpenings, task.rotation, model.repairs));
  } catch (const DefectiveSurface&) {
    return std::nullopt;
  }
}

/// Whether `open_surface` can make a shell of it.
bool isVase(const RepairedMesh& manifold, MendingTask task) {
  task.keepsOpenings = true;
  try {
    return solidOf(manifold, task).has_value();
  } catch (const InvalidInput&) {
    return false;
  }
}

/// The solid's volume by what the triangles enclose, which is not certain where bodies face
/// inwards.
double shareOfVolume(const TriangleMesh& mesh, const Solid& solid) {
  return signedVolume(solid.vertices(), solid.faces()) / enclosedVolume(mesh);
}

constexpr double kLeastShare = 0.75;
constexpr double kMostShare = 1.5;

/// \pre the holes are closed
std::optional<Solid> solidFrom(RepairedMesh model, const MendingTask& task) {
  take(kToSolid, task, model);
  std::optional<Solid> solid = solidOf(model, task);
  if (solid) return solid;
  const TriangleMesh bodies = model.mesh;
  std::size_t fewest = std::numeric_limits<std::size_t>::max();
  for (int round = 0; !solid && round < kMostUnions; ++round) {
    if (!take({unitedBodies}, task, model)) break;
    take(kAfterUnion, task, model);
    solid = solidOf(model, task);
    if (solid) break;
    const std::size_t crossings =
        selfIntersectingFaces(model.mesh.vertices, model.mesh.faces).size();
    if (crossings >= fewest) break;
    fewest = crossings;
  }
  // What came of a union may lack a body, or be filled where it was hollow.
  const double share = solid ? shareOfVolume(bodies, *solid) : 1.0;
  if (share < kLeastShare || share > kMostShare) solid.reset();
  return solid;
}

constexpr const char* kWasOpen =
    "The surface has an opening like a vase's, but no shell can be made of it: it was closed, so "
    "look at the new outer surface.";

/// By steps, the wrap being the last of them.
std::optional<Solid> mendedFrom(RepairedMesh manifold, const MendingTask& task) {
  try {
    take({closedHoles}, task, manifold);
  } catch (const LargeOpening&) {
    if (isVase(manifold, task)) throw;
    manifold.repairs.warning = kWasOpen;
    take({closedOpenings}, task, manifold);
  }
  std::optional<Solid> solid = solidFrom(manifold, task);
  if (solid) return solid;
  take({wrapped}, task, manifold);
  return solidOf(manifold, task);
}

} // namespace

std::optional<Solid> mended(const TriangleMesh& input, const MendingTask& task) {
  RepairedMesh given = mergedAndCompacted(input);
  RepairedMesh manifold = given;
  const bool isChanged = take(kToManifold, task, manifold);
  if (task.keepsOpenings) return solidOf(manifold, task);

  std::optional<Solid> solid = mendedFrom(std::move(manifold), task);
  if (!solid || !isChanged) return solid;
  const double share = shareOfVolume(given.mesh, *solid);
  if (share >= kLeastShare) return solid;
  // What was turned over or left out as a sheet on the way was a body's.
  take({wrapped}, task, given);
  std::optional<Solid> whole = solidOf(given, task);
  return whole && shareOfVolume(given.mesh, *whole) > share ? whole : solid;
}

} // namespace massprops
