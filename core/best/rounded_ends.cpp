#include "core/best/rounded_ends.h"

#include "core/base/tolerances.h"
#include "core/best/best_cavity.h"
#include "core/contour/inscribed_ball.h"
#include "core/mesh/components.h"
#include "core/query/grid_sampling.h"
#include "core/reduced/hollow_body.h"
#include "core/reduced/search_strategy.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace massprops {
namespace {

/// With a vertex of a pleated end.
Faces pleatedFaces(const CavityResult& cavity) {
  std::vector<char> isPleated(static_cast<std::size_t>(cavity.inner.rows()), 0);
  for (const int v : cavity.pleated) isPleated[static_cast<std::size_t>(v)] = 1;
  std::vector<int> faces;
  for (Eigen::Index f = 0; f < cavity.cavity.faces.rows(); ++f) {
    const auto corners = cavity.cavity.faces.row(f);
    if (std::any_of(corners.begin(), corners.end(),
                    [&](int v) { return isPleated[static_cast<std::size_t>(v)] != 0; }))
      faces.push_back(static_cast<int>(f));
  }
  return cavity.cavity.faces(faces, Eigen::all);
}

/// A cavity and what is pleated of it; lengths.
struct Pleated {
  const TriangleTree& cavity;
  const TriangleTree& ends;
};

/// How deep points are in a cavity, near its pleated ends in what a ball reaches of it.
class RoundedDepth {
public:
  RoundedDepth(const Pleated& pleated, const Region& asFound, const Region& rounded, double near)
      : ends_(pleated.ends), found_(asFound), rounded_(rounded), near_(near) {}

  double operator()(const Vec3& x, double horizon) {
    const double depth = found_.at(x, horizon).value;
    const double away = horizon + near_;
    nearest_ = ends_.nearest(x, away * away, nearest_.face);
    const double beyond = nearest_.face < 0 ? horizon : std::sqrt(nearest_.squaredDistance) - near_;
    if (depth <= -horizon || beyond >= depth) return depth;
    return std::max(std::min(depth, beyond), rounded_.at(x, horizon).value);
  }

private:
  const TriangleTree& ends_;
  InsetProbe found_, rounded_;
  double near_;
  TriangleTree::Hit nearest_;
};

/// A ball that rounds ends.
struct Ball {
  double width; ///< walls
  /// How far beyond the cavity what it leaves may go, where there is a wall, in edges of the grid:
  /// a little, so that along walls these count, not what the grid knows of them; more where too
  /// little is left for the constraints.
  double more;
};
constexpr Ball kBalls[] = {{2.0, 0.25}, {1.0, 0.25}, {1.0, 1.0}, {0.5, 0.25}};

/// Positive where there is cavity.
GridFunction roundedDepth(const Pleated& pleated, const Ball& ball, double wall, double edge) {
  constexpr double kMostNodes = 4e6;
  GridFunction result;
  result.grid = gridAround(pleated.cavity.vertices(), Mat3::Identity(), edge, kMostNodes);
  const double width = ball.width * wall;
  const double radius = 0.5 * width;
  const Region asFound{pleated.cavity, 0.0};
  const Region rounded{pleated.cavity, 0.0, Opening{radius, radius}};
  const double more = ball.more * result.grid.edge;
  result.values = sampled(result.grid, [&] {
    return [depth = RoundedDepth(pleated, asFound, rounded, width),
            more](const Vec3& x, double horizon) mutable { return depth(x, horizon) + more; };
  });
  return result;
}

/// What it costs to deliver the first in the place of the other, as a share of what is possible;
/// empty: it may not be.
std::optional<double> lossOf(const CavityTask& task, const CavityResult& rounded,
                             const CavityResult& found) {
  if (rounded.status != CavityStatus::Found || isUseless(task, rounded)) return {};
  const Body before =
      found.status == CavityStatus::Found ? hollowBody(task, found) : inputBody(task);
  const Body after = hollowBody(task, rounded);
  if (servesBetter(task, after, before)) return 0.0;
  if (before.violation <= kFeasibility && after.violation > kFeasibility) return {};
  const double wanted = task.goal.wantedLevel();
  if (before.measure && *before.measure >= wanted && *after.measure < wanted) return {};
  constexpr double kMostOfGain = 0.5;
  const Body solid = inputBody(task);
  const auto loss = [&](const OptimalBound& bound) {
    return gapToBound(bound, solid, after) - gapToBound(bound, solid, before);
  };
  OptimalBound raised = *task.bound;
  raiseTo(task, before, raised); // in narrow rooms the limit may see less
  if (loss(raised) > kMostOfGain * (1.0 - gapToBound(raised, solid, before))) return {};
  return loss(*task.bound);
}

/// That a ball of this width finds its room in.
OpenedSet setFor(const CavityTask& task, const OpenedSet& set, double ball) {
  if (ball >= set.ball) return set;
  return openedSet(task.surface, task.wall, ball, std::min(set.edge, kResolves * ball));
}

} // namespace

CavityResult withRoundedEnds(const CavityTask& task, const CavityRoom& room,
                             const CavityResult& found) {
  constexpr double kLittle = 0.02; // of what is possible
  constexpr double kMuch = 0.1;
  const TriangleMesh cavity = submesh(found.inner, found.cavity.faces).mesh;
  const Submesh ends = submesh(found.inner, pleatedFaces(found));
  const TriangleTree cavityTree(cavity.vertices, cavity.faces);
  const TriangleTree endTree(ends.mesh.vertices, ends.mesh.faces);
  CavityResult best = found;
  SearchEffort effort = found.effort;
  double least = kMuch;
  const double widest = 2.0 * largestInscribedBall(cavityTree, task.wall).radius;
  for (const Ball& ball : kBalls) {
    if (ball.width * task.wall > widest) continue;
    OpenedSet set = setFor(task, room.set, ball.width * task.wall);
    set.fill = std::make_shared<const GridFunction>(
        roundedDepth({cavityTree, endTree}, ball, task.wall, set.edge));
    const AdmissibleCells cells = cellsWithin(set, room.behindWalls);
    CavityTask within = task;
    within.bound = withBodyWithin(cells, *task.bound, task.goal, task.weights,
                                  task.model.solidMoments, room.states);
    CavityResult rounded = bestPossibleCavity(within, set, Cubes::OfTheSet);
    effort += rounded.effort;
    const std::optional<double> loss = lossOf(task, rounded, found);
    if (!loss || *loss > least) continue;
    least = *loss;
    best = std::move(rounded);
    best.shape = CavityShape::Offset;
    best.stopReason += ", within the offset surface's, whose ends a ball rounded";
    if (least <= kLittle) break;
  }
  best.outer = found.outer;
  best.outerOffsets = found.outerOffsets;
  best.effort = effort;
  return best;
}

} // namespace massprops
