#include "core/best/best_cavity.h"

#include "core/base/stopwatch.h"
#include "core/base/tolerances.h"
#include "core/base/triangle.h"
#include "core/best/polish.h"
#include "core/contour/cavity_contour.h"
#include "core/contour/wall_keeping.h"
#include "core/optimum/admissible_cells.h"
#include "core/reduced/hollow_body.h"
#include "core/reduced/search_strategy.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace massprops {
namespace {

Points delivered(const CavityTask& task, const Points& working) {
  return task.deliverable ? task.deliverable(working) : working;
}

/// How far rounding may move a point.
double roundingOf(const CavityTask& task, const Points& points) {
  return points.rows() == 0 ? 0.0 : (delivered(task, points) - points).rowwise().norm().maxCoeff();
}

/// Not inspected.
CavityResult resultOf(const CavityTask& task, const TriangleMesh& mesh) {
  CavityResult result;
  result.shape = CavityShape::BestPossible;
  result.status = CavityStatus::Found;
  result.outer = task.surface.vertices();
  result.inner = delivered(task, mesh.vertices);
  result.cavity.faces = mesh.faces;
  return result;
}

void addInspection(const CavityTask& task, CavityResult& result) {
  const Stopwatch time;
  result.inspection = inspect(result.inner, result.cavity.faces, task.surface, task.wall, false);
  result.effort.secondsInspection = time.seconds();
}

/// The contour as the goal would have it, or as it was: what serves best of those that are clean,
/// for triangles that give way to the wall cost more in one than in another.
CavityResult polished(const CavityTask& task, const LayeredQuadric& quadric, double wall,
                      const CavityContour& found) {
  int evaluations = 0;
  const auto adjust = [&](Moving moving, Contour& contour) {
    evaluations += polish(task, quadric, moving, found.edge, contour);
  };
  std::vector<CavityResult> candidates{resultOf(task, found.contour.mesh)};
  // Creases that move leave the walls' surface a little, and the constraints with it.
  Contour whole = found.contour;
  adjust(Moving::CutAndCreases, whole);
  if (keepWall(task.surface, wall, whole.mesh, &found.contour.mesh.vertices).empty()) {
    adjust(Moving::CutAlone, whole);
    candidates.push_back(resultOf(task, whole.mesh));
  }
  Contour inside = found.contour;
  adjust(Moving::CutAlone, inside);
  candidates.push_back(resultOf(task, inside.mesh));
  std::stable_sort(
      candidates.begin(), candidates.end(),
      [&](const CavityResult& a, const CavityResult& b) { return servesBetter(task, a, b); });
  CavityResult* best = nullptr;
  for (CavityResult& candidate : candidates) {
    addInspection(task, candidate);
    if (best == nullptr) best = &candidate;
    if (!candidate.inspection.isClean()) continue;
    best = &candidate;
    break;
  }
  best->effort.evaluations = evaluations;
  best->stopReason = "the limit's cavity, adjusted on its triangles";
  return std::move(*best);
}

bool leavesRoom(const TriangleTree& surface, double wall) {
  constexpr double kFewCubes = 8000.0;
  const double edge = edgeOfCubes(surfaceArea(surface.vertices(), surface.faces()), kFewCubes);
  const std::optional<CavityContour> found = cavityContour(openedSet(surface, wall, edge), {});
  return found && found->contour.mesh.faces.rows() > 0;
}

} // namespace

OpenedSet deliverableSet(const TriangleTree& surface, double wall, const RegionParts& behindWall,
                         const AdmissibleCells& cells) {
  constexpr double kFewest = 15000.0;
  constexpr double kMost = 50000.0;
  constexpr double kAcross = 9.0; // a room of the mean width
  constexpr double kLeastEdge = 1.0 / 1000.0;
  const double area = borderArea(behindWall);
  const double width = 2.0 * cells.col(0).sum() / area;
  const double edge =
      std::clamp(width / kAcross, edgeOfCubes(area, kMost), edgeOfCubes(area, kFewest));
  return openedSet(surface, wall, std::max(edge, kLeastEdge));
}

CavityResult bestPossibleCavity(const CavityTask& task, const OpenedSet& deliverable) {
  const Stopwatch time;
  const LayeredQuadric& quadric = task.bound->worth;
  double wall = task.wall;
  CavityResult result;
  constexpr int kRounds = 3;
  for (int round = 1; round <= kRounds; ++round) {
    const std::optional<CavityContour> found =
        round == 1 ? cavityContour(deliverable, quadric)
                   : cavityContour(openedSet(task.surface, wall, deliverable.edge), quadric);
    if (!found || found->contour.mesh.faces.rows() == 0) {
      result = {};
      // Where there is room the limit's body is the solid one.
      if (leavesRoom(task.surface, task.wall)) result.status = CavityStatus::NoGain;
      result.stopReason = found ? "the best possible cavity is none"
                                : "the best possible cavity cannot be resolved";
      break;
    }
    result = polished(task, quadric, wall, *found);
    result.effort.rounds = round;
    if (result.inspection.isClean()) break;
    // Rounding took too much.
    wall += 2.0 * roundingOf(task, found->contour.mesh.vertices);
  }
  result.shape = CavityShape::BestPossible;
  if (result.status == CavityStatus::Found) {
    if (!result.inspection.isClean()) {
      // There is room, but none of the surfaces passed.
      result = {};
      result.status = CavityStatus::NoGain;
      result.stopReason = "the best possible cavity cannot be resolved";
    } else if (!servesBetter(task, hollowBody(task, result), inputBody(task))) {
      result.status = CavityStatus::NoGain;
    }
  }
  result.effort.secondsOptimization = time.seconds() - result.effort.secondsInspection;
  return result;
}

double largestWallForBestPossible(const CavityTask& task,
                                  const std::function<void(double)>& progress) {
  // Without cells there is no limit, and no quadric to go by.
  const auto hasRoom = [&](double wall) {
    return admissibleCells(task.surface, wall).rows() > 0 && leavesRoom(task.surface, wall);
  };
  return greatestWall(task.wall, hasRoom, progress);
}

} // namespace massprops
