#include "core/best/best_cavity.h"

#include "core/base/stopwatch.h"
#include "core/base/tolerances.h"
#include "core/base/triangle.h"
#include "core/best/adjustment.h"
#include "core/contour/cavity_surface.h"
#include "core/mesh/components.h"
#include "core/mesh/signed_volume.h"
#include "core/reduced/hollow_body.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace massprops {
namespace {

Points delivered(const CavityTask& task, const Points& working) {
  return task.deliverable ? task.deliverable(working) : working;
}

/// The wall that a cavity is made with so that rounding leaves the wanted one: points between those
/// of the surface, which are rounded already, tell how far points move.
double wallBeforeRounding(const CavityTask& task) {
  constexpr double kMore = 2.0; // than any of these
  const Points& vertices = task.surface.vertices();
  const Faces& faces = task.surface.faces();
  constexpr Eigen::Index kSome = 1000;
  const Eigen::Index step = faces.rows() / kSome + 1;
  Points middles((faces.rows() + step - 1) / step, 3);
  for (Eigen::Index i = 0; i < middles.rows(); ++i) {
    const auto corners = faces.row(i * step);
    middles.row(i) =
        (vertices.row(corners[0]) + vertices.row(corners[1]) + vertices.row(corners[2])) / 3.0;
  }
  const double rounded = (delivered(task, middles) - middles).rowwise().norm().maxCoeff();
  constexpr double kLastDigits = 1e-6; // of the wall
  return (1.0 + kLastDigits) * task.wall + kMore * rounded;
}

CavityResult resultOf(const CavityTask& task, const Contour& contour, ClearanceQuery& clearance) {
  CavityResult result;
  result.shape = CavityShape::BestPossible;
  result.isContour = true;
  result.status = CavityStatus::Found;
  result.inner = delivered(task, contour.mesh.vertices);
  result.outer = task.surface.vertices();
  result.cavity.faces = contour.mesh.faces;
  const Stopwatch time;
  result.inspection =
      inspect(result.inner, contour.mesh.faces, task.surface, task.wall, &clearance, task.stored);
  result.effort.secondsInspection = time.seconds();
  return result;
}

CavityResult none(CavityStatus status, const char* reason) {
  CavityResult result;
  result.shape = CavityShape::BestPossible;
  result.status = status;
  result.stopReason = reason;
  return result;
}

/// Whether the quadric leaves something on both sides.
bool isCut(const QuadricCut& cut, const TriangleTree& surface) {
  const Vec3 low = surface.lower();
  const Vec3 high = surface.upper();
  return sideOfCut(cut, 0.5 * (low + high), 0.5 * (high - low).norm()) != Side::Positive;
}

/// Whether the region holds a cavity when nothing is cut off.
bool hasRoom(const FeasibleSet& set, const FeasibleRegion& region) {
  const std::optional<QuadricCut> all;
  Contour contour = dualContour(BorderLattice(set, region, all));
  removeSmallComponents(set.ball, contour);
  return contour.mesh.faces.rows() > 0;
}

/// Corners of the faces that do not pass, where the contour had them.
std::vector<Vec3> faultyPlaces(const Inspection& inspection, const Points& raw) {
  std::vector<Vec3> places;
  for (const std::vector<int>* vertices : {&inspection.thin, &inspection.crossing}) {
    for (const int v : *vertices) places.emplace_back(raw.row(v).transpose());
  }
  return places;
}

/// Vertices that faces use, and nothing else.
void compact(CavityResult& result) {
  Submesh used = submesh(result.inner, result.cavity.faces);
  Inspection& inspection = result.inspection;
  inspection.wall = Vector(inspection.wall(used.vertexOf));
  inspection.wallOfVertexAtLeast = Vector(inspection.wallOfVertexAtLeast(used.vertexOf));
  std::vector<int> nearest;
  for (const int v : used.vertexOf)
    nearest.push_back(inspection.nearestFace[static_cast<std::size_t>(v)]);
  inspection.nearestFace = std::move(nearest);
  result.inner = std::move(used.mesh.vertices);
  result.cavity.faces = std::move(used.mesh.faces);
}

/// Where vertices of a contour were and where they went.
struct Placed {
  Points raw, moved;
};

/// Those of a later contour that have not changed go where they went; flags of the others.
std::vector<char> placeAgain(const Placed& before, Points& vertices) {
  std::vector<char> isNew(static_cast<std::size_t>(vertices.rows()), 1);
  const Eigen::Index known = std::min(before.raw.rows(), vertices.rows());
  for (Eigen::Index v = 0; v < known; ++v) {
    if (vertices.row(v) != before.raw.row(v)) continue;
    vertices.row(v) = before.moved.row(v);
    isNew[static_cast<std::size_t>(v)] = 0;
  }
  return isNew;
}

/// The contour of a lattice on the walls, with `adjust`, which returns its number of evaluations,
/// as the last touch; what does not pass inspection then becomes solid, and the contour is made
/// again.
template <class Adjust>
CavityResult inspectedCavity(const CavityTask& task, const FeasibleSet& set, BorderLattice lattice,
                             const Adjust& adjust) {
  constexpr int kRounds = 5;
  constexpr int kPasses = 3;
  constexpr double kSpare = 5e-4; // of the wall: so triangles need no exact test as a rule
  const double wall = (1.0 + kSpare) * set.wall;
  ClearanceQuery clearance(task.surface);
  Placed placed;
  SearchEffort effort;
  for (int round = 1; round <= kRounds; ++round) {
    Contour contour = dualContour(lattice);
    removeSmallComponents(set.ball, contour);
    if (contour.mesh.faces.rows() == 0)
      return none(CavityStatus::NoGain, "the best possible cavity is none");
    Points& vertices = contour.mesh.vertices;
    Points raw = vertices;
    moveOntoWalls(task.surface, wall, lattice.edge(), placeAgain(placed, vertices), contour);
    placed = {std::move(raw), vertices};
    // What keeps the constraints may leave walls too thin, and the other way round.
    for (int pass = 0; pass < kPasses; ++pass) {
      keepWall(clearance, set.wall, contour.mesh.faces, vertices);
      if (pass == 0) placed.moved = vertices;
      const int evaluations = adjust(contour);
      effort.evaluations += 1 + evaluations; // once to see whether the constraints hold
      if (evaluations == 0) break;
    }
    CavityResult result = resultOf(task, contour, clearance);
    effort.secondsInspection += result.effort.secondsInspection;
    effort.rounds = round;
    result.effort = effort;
    if (result.inspection.isClean()) {
      result.stopReason = "passed inspection";
      compact(result);
      return result;
    }
    lattice.takeOut(faultyPlaces(result.inspection, placed.raw));
  }
  return none(CavityStatus::NoGain, "the best possible cavity cannot be resolved");
}

/// Of the cavity with which the body has the mass that is all that the goal wants.
std::optional<double> wantedVolume(const CavityTask& task) {
  const std::optional<double> mass = task.goal.wantedMass();
  const Filling& filling = task.model.fillings.front();
  if (!mass || task.weights.constraints == 0.0 || filling.isPartial()) return {};
  const double volume = (task.model.solidMoments[0] - *mass) / (1.0 - filling.density);
  return volume > 0.0 ? std::optional(volume) : std::nullopt;
}

/// The depth behind which cells hold the volume, each taken for as deep as its middle; the wall
/// where they do not.
double depthHolding(double volume, const FeasibleSet& set, const AdmissibleCells& cells) {
  std::vector<std::pair<double, double>> parts; // less the depth, volume
  RegionProbe probe(set);
  for (Eigen::Index c = 0; c < cells.rows(); ++c) {
    const Vec3 middle = cells.block<1, 3>(c, 1).transpose() / cells(c, 0);
    parts.emplace_back(-probe.depthAt(middle, 1.0).value, cells(c, 0));
  }
  std::sort(parts.begin(), parts.end());
  for (const auto& [depth, own] : parts) {
    volume -= own;
    if (volume <= 0.0) return std::max(-depth, set.wall);
  }
  return set.wall;
}

/// Moves all vertices along their normals until the triangles to be delivered have the volume to a
/// tenth of what the constraint asks for. Number of steps.
int adjustVolume(const CavityTask& task, double volume, TriangleMesh& cavity) {
  constexpr int kSteps = 8;
  const double perVolume = std::abs(1.0 - task.model.fillings.front().density);
  const double tolerance = 0.1 * kFeasibility * task.model.solidMoments[0] / perVolume;
  for (int step = 0; step < kSteps; ++step) {
    const double missing = volume - signedVolume(delivered(task, cavity.vertices), cavity.faces);
    if (std::abs(missing) <= tolerance) return step;
    cavity.vertices += missing / surfaceArea(cavity.vertices, cavity.faces) *
                       vertexNormals(cavity.vertices, cavity.faces);
  }
  return kSteps;
}

} // namespace

CavityResult bestPossibleCavity(const CavityTask& task, const FeasibleSet& set,
                                const FeasibleRegion& region) {
  const Stopwatch time;
  constexpr double kFarthest = 1.5; // edges, root mean square, that the cut moves
  std::optional<QuadricCut> cut = QuadricCut{task.bound->worth, region.edge};
  if (!isCut(*cut, task.surface)) cut.reset();
  const auto adjust = [&](Contour& contour) {
    return adjustOnTriangles(task, kFarthest * region.edge, contour);
  };
  const FeasibleSet behind{set.surface, wallBeforeRounding(task), set.ball};
  CavityResult result = inspectedCavity(task, behind, BorderLattice(set, region, cut), adjust);
  if (result.status != CavityStatus::Found && !hasRoom(set, region))
    return none(CavityStatus::NoRoom, "the wall leaves no room");
  if (result.status == CavityStatus::Found &&
      !servesBetter(task, hollowBody(task, result), inputBody(task)))
    result.status = CavityStatus::NoGain;
  result.effort.secondsOptimization = time.seconds() - result.effort.secondsInspection;
  return result;
}

std::optional<CavityResult> uniformlyWalledCavity(const CavityTask& task, const FeasibleSet& set,
                                                  const AdmissibleCells& cells, double edge) {
  constexpr int kRounds = 4;
  constexpr double kNear = 0.2; // edges, that vertices may move to the last digit of the volume
  const Stopwatch time;
  const std::optional<double> volume = wantedVolume(task);
  if (!volume) return {};
  const double least = wallBeforeRounding(task);
  double wall = depthHolding(*volume, set, cells);
  for (int round = 0; round < kRounds; ++round) {
    const FeasibleSet behind{set.surface, wall, set.ball};
    const FeasibleRegion region = feasibleRegion(behind, edge);
    double outwards = 0.0; // that the surface would have to go for the volume
    const auto adjust = [&](Contour& contour) {
      TriangleMesh& cavity = contour.mesh;
      outwards = (*volume - signedVolume(cavity.vertices, cavity.faces)) /
                 surfaceArea(cavity.vertices, cavity.faces);
      return std::abs(outwards) <= kNear * edge ? adjustVolume(task, *volume, cavity) : 0;
    };
    CavityResult result = inspectedCavity(task, behind, BorderLattice(behind, region, {}), adjust);
    if (result.status != CavityStatus::Found) return {};
    if (std::abs(outwards) <= kNear * edge) {
      result.stopReason = "walls as thick everywhere as the mass asks for";
      result.effort.secondsOptimization = time.seconds() - result.effort.secondsInspection;
      return result;
    }
    if (outwards > 0.0 && wall <= least) return {};
    wall = std::max(wall - outwards, least);
  }
  return {};
}

} // namespace massprops
