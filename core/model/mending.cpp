#include "core/model/mending.h"

#include "core/model/closed_holes.h"
#include "core/model/empty_shells.h"
#include "core/model/local_crossings.h"
#include "core/model/manifold_split.h"
#include "core/model/seams.h"
#include "core/model/shell_orientation.h"
#include "core/model/solid.h"
#include "core/model/united_bodies.h"
#include "core/model/wrapping.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace massprops {
namespace {

/// Of an open surface that keeps its openings: what leads to a manifold.
const std::vector<MendingStep> kToManifold = {joinedSeams, orientedShells, splitToManifold};
/// From there to a solid.
const std::vector<MendingStep> kToSolid = {closedHoles, withoutLocalCrossings, withoutEmptyShells};
/// What a union leaves is rounded to what the caller can store, and may have slivers that cross:
/// the same again.
const std::vector<MendingStep> kUnion = {unitedBodies, joinedSeams, withoutLocalCrossings,
                                         withoutEmptyShells};
constexpr int kMostUnions = 3;

bool isSolid(const TriangleMesh& mesh, bool keepsOpenings) {
  try {
    requireNoCrossings(makeSolid(mesh, keepsOpenings));
    return true;
  } catch (const InvalidInput&) {
    return false;
  }
}

/// Does the step and writes down what it did. Returns whether it did anything.
bool take(MendingStep step, const MendingTask& task, RepairedMesh& model) {
  MendedMesh next = step(model.mesh, task);
  if (next.done.empty()) return false;
  model.mesh = std::move(next.mesh);
  model.mesh.vertices = task.representable(model.mesh.vertices);
  Repairs& repairs = model.repairs;
  repairs.mended += (repairs.mended.empty() ? "" : ", ") + next.done;
  repairs.distance = std::max(repairs.distance, next.distance);
  if (!next.warning.empty()) repairs.warning = next.warning;
  return true;
}

/// Whether the way led to a solid.
bool go(const std::vector<MendingStep>& way, const MendingTask& task, RepairedMesh& model) {
  for (const MendingStep step : way) {
    if (take(step, task, model) && isSolid(model.mesh, task.keepsOpenings)) return true;
  }
  return false;
}

} // namespace

RepairedMesh mended(const TriangleMesh& input, const MendingTask& task) {
  RepairedMesh model = mergedAndCompacted(input);
  if (isSolid(model.mesh, task.keepsOpenings)) return model;
  if (go(kToManifold, task, model) || task.keepsOpenings) return model;
  const RepairedMesh manifold = model;
  if (go(kToSolid, task, model)) return model;
  for (int round = 0; round < kMostUnions; ++round) {
    const std::string before = model.repairs.mended;
    if (go(kUnion, task, model)) return model;
    if (model.repairs.mended == before) break;
  }
  // What was tried since is left to the wrap, but for holes that it need not find again.
  RepairedMesh closed = manifold;
  take(closedHoles, task, closed);
  take(wrapped, task, closed);
  return closed;
}

} // namespace massprops
