#include "core/best/polish.h"

#include "core/base/tolerances.h"
#include "core/contour/region.h"
#include "core/contour/shape_guard.h"
#include "core/goals/objective.h"
#include "core/optimum/layered_quadric.h"
#include "core/reduced/displacement.h"

#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <vector>

namespace massprops {
namespace {

constexpr double kTiny = 1e-300;

/// Where each vertex goes while the quadric rises by as much as it does along a unit of length on
/// the average; 0 for those that stay.
Points directionsOf(const Region& region, Moving moving, const std::vector<char>& held,
                    const std::vector<On>& ons, const Points& vertices) {
  constexpr double kSteep = 0.2; // where they are nearly parallel the crease would run away
  constexpr double kFar = 3.0;   // so would the cut next to where the gradient vanishes
  Points directions = Points::Zero(vertices.rows(), 3);
  Vector steepness = Vector::Zero(vertices.rows());
  InsetProbe probe(region);
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    const On on = ons[static_cast<std::size_t>(v)];
    if (on != On::Cut && (on != On::Crease || moving == Moving::CutAlone)) continue;
    const Vec3 x = vertices.row(v).transpose();
    const LayeredQuadric& layered = *region.quadric;
    steepness[v] = gradientAt(layered.quadrics[layered.layerAt(x.z())], x).norm();
    if (!held.empty() && held[static_cast<std::size_t>(v)] != 0) continue;
    const Vec3 cut = cutAt(region, x).slope;
    if (on == On::Cut) {
      directions.row(v) = -cut.transpose();
      continue;
    }
    const Vec3 inset = probe.at(x, region.wall).slope;
    const Vec3 along = cut - cut.dot(inset) * inset;
    if (along.squaredNorm() > kSteep)
      directions.row(v) = -(along / along.squaredNorm()).transpose();
  }
  const auto count = static_cast<double>((steepness.array() > 0.0).count());
  const double mean = steepness.sum() / std::max(count, 1.0);
  for (Eigen::Index v = 0; v < vertices.rows(); ++v)
    directions.row(v) *= std::min(mean / std::max(steepness[v], kTiny), kFar);
  return directions;
}

} // namespace

Polished polish(const CavityTask& task, const LayeredQuadric& quadric, Moving moving, double edge,
                const std::vector<char>& held, const Contour& contour, Points& vertices) {
  constexpr double kFarthest = 0.3; // edges, root mean square of the displacements
  const Region region{task.surface, task.wall, {}, quadric, edge};
  const Points directions = directionsOf(region, moving, held, contour.on, vertices);
  const Moments outer = task.model.solidMoments + task.model.attached;
  const bool isOutOfReach = task.bound && !task.bound->isReachable();
  const std::unique_ptr<Goal> instead = isOutOfReach ? task.goal.insteadOfConstraints() : nullptr;
  const Weights weights = instead ? insteadOfConstraints(task.weights) : task.weights;
  DisplacementTask displacement{instead ? *instead : task.goal,
                                weights,
                                task.model.fillings,
                                outer,
                                task.model.solidMoments[0],
                                contour.mesh.faces,
                                directions,
                                kFarthest * edge};
  displacement.raisesLevel = true;
  if (moving == Moving::CutAlone) {
    const Displaced done = displace(displacement, vertices);
    return {done.evaluations, done.violation, done.isFarthest};
  }
  Points targets = vertices;
  const Displaced done = displace(displacement, targets);
  moveSoundly(targets, contour.mesh.faces, vertices);
  return {done.evaluations, done.violation, done.isFarthest};
}

bool withdrawFromWalls(const CavityTask& task, double edge, const Contour& contour,
                       Points& vertices) {
  constexpr std::array<double, 6> kWays{0.001, 0.004, 0.016, 0.064, 0.256, 0.5}; // edges
  constexpr double kChange = 0.1; // of how far they all go, root mean square
  const Region region{task.surface, task.wall};
  InsetProbe probe(region);
  Points inwards = Points::Zero(vertices.rows(), 3);
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    if (contour.on[static_cast<std::size_t>(v)] == On::Inset)
      inwards.row(v) = probe.at(vertices.row(v).transpose(), task.wall).slope.transpose();
  }
  const Moments outer = task.model.solidMoments + task.model.attached;
  for (const double edges : kWays) {
    const double way = edges * edge;
    const DisplacementTask displacement{
        task.goal,          task.weights, task.model.fillings, outer, task.model.solidMoments[0],
        contour.mesh.faces, inwards,      kChange * way};
    Points moved = vertices + way * inwards;
    const Displaced done = displace(displacement, moved);
    const double least = (moved - vertices).cwiseProduct(inwards).rowwise().sum().minCoeff();
    if (done.violation > kFeasibility || least < 0.0) continue;
    vertices = std::move(moved);
    return true;
  }
  return false;
}

} // namespace massprops
