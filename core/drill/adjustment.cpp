#include "core/drill/adjustment.h"

#include "core/base/stopwatch.h"
#include "core/base/tolerances.h"
#include "core/base/triangle.h"
#include "core/reduced/displacement.h"
#include "core/reduced/hollow_body.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <utility>

namespace massprops {
namespace {

/// Outward, as long as the wall has room to spare, in walls, at most 1.
Points directionsOf(const TriangleTree& outer, double wall, const CavityResult& cavity,
                    const std::vector<char>& held) {
  Points directions = vertexNormals(cavity.inner, cavity.cavity.faces);
  for (Eigen::Index v = 0; v < directions.rows(); ++v) {
    double room = 0.0;
    if (held[static_cast<std::size_t>(v)] == 0 && !directions.row(v).isZero(0.0)) {
      const Vec3 x = cavity.inner.row(v).transpose();
      room = std::sqrt(outer.clearance(x).squaredDistance) / wall - 1.0;
    }
    directions.row(v) *= std::clamp(room, 0.0, 1.0);
  }
  return directions;
}

/// Moves the vertices of a cavity.
class Adjustment {
public:
  Adjustment(const CavityTask& task, const CavityResult& cavity)
      : task_(task), cavity_(cavity),
        moved_(task.model.outer
                   ? std::make_unique<const TriangleTree>(cavity.outer, task.surface.faces(),
                                                          TriangleTree::Order::Spatial)
                   : nullptr),
        own_(task.goalFor ? task.goalFor(cavity.outer) : nullptr),
        outerMass_(outerMoments(task, cavity)) {}

  /// Inspected.
  CavityResult with(const std::vector<char>& held) const {
    const Stopwatch time;
    const TriangleTree& outer = moved_ ? *moved_ : task_.surface;
    CavityResult result = cavity_;
    const Points directions = directionsOf(outer, task_.wall, cavity_, held);
    constexpr double kFarthest = 0.25; // walls, root mean square
    DisplacementTask least{own_ ? *own_ : task_.goal,
                           task_.weights,
                           task_.model.fillings,
                           outerMass_,
                           task_.model.solidMoments[0],
                           cavity_.cavity.faces,
                           directions,
                           kFarthest * task_.wall};
    least.movesLeast = true;
    const Displaced done = displace(least, result.inner);
    if (task_.deliverable) result.inner = task_.deliverable(result.inner);
    result.effort.evaluations += done.evaluations;
    result.effort.secondsOptimization += time.seconds();
    const Stopwatch inspection;
    result.inspection =
        inspect(result.inner, result.cavity.faces, outer, task_.wall, nullptr, task_.stored);
    result.effort.secondsInspection += inspection.seconds();
    return result;
  }

private:
  const CavityTask& task_;
  const CavityResult& cavity_;
  const std::unique_ptr<const TriangleTree> moved_; ///< null: the outer surface rests
  const std::unique_ptr<const Goal> own_;           ///< null: it is the task's
  const Moments outerMass_;
};

/// Vertices of faces that do not pass stay, as they were. Whether there was one that did not yet.
bool holdFaulty(const CavityResult& result, std::vector<char>& held) {
  std::vector<char> faulty(held.size(), 0);
  for (const int v : result.inspection.crossing) faulty[static_cast<std::size_t>(v)] = 1;
  for (const int v : result.inspection.thin) faulty[static_cast<std::size_t>(v)] = 1;
  bool isNew = false;
  const auto isFaulty = [&](int v) { return faulty[static_cast<std::size_t>(v)] != 0; };
  for (Eigen::Index f = 0; f < result.cavity.faces.rows(); ++f) {
    const auto corners = result.cavity.faces.row(f);
    if (std::none_of(corners.begin(), corners.end(), isFaulty)) continue;
    for (const int v : corners) {
      isNew = isNew || held[static_cast<std::size_t>(v)] == 0;
      held[static_cast<std::size_t>(v)] = 1;
    }
  }
  return isNew;
}

} // namespace

CavityResult adjusted(const CavityTask& task, const CavityResult& cavity,
                      const std::vector<char>& held) {
  const Body before = hollowBody(task, cavity);
  if (before.violation <= kFeasibility || task.weights.constraints == 0.0) return cavity;
  const Adjustment adjustment(task, cavity);
  std::vector<char> resting = held;
  CavityResult result = cavity;
  do {
    result = adjustment.with(resting);
  } while (holdFaulty(result, resting));
  const bool isBetter =
      result.inspection.isClean() && hollowBody(task, result).violation < before.violation;
  return isBetter ? result : cavity;
}

} // namespace massprops
