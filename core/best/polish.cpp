#include "core/best/polish.h"

#include "core/base/tolerances.h"
#include "core/contour/region.h"
#include "core/contour/shape_guard.h"
#include "core/goals/objective.h"
#include "core/optimum/layered_quadric.h"
#include "core/reduced/displacement.h"

#include <algorithm>
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
  displacement.comesNearest = isOutOfReach;
  if (moving == Moving::CutAlone) {
    const Displaced done = displace(displacement, vertices);
    return {done.evaluations, done.violation, done.isFarthest};
  }
  Points targets = vertices;
  const Displaced done = displace(displacement, targets);
  moveSoundly(targets, contour.mesh.faces, vertices);
  return {done.evaluations, done.violation, done.isFarthest};
}

bool withdrawFromWalls(const CavityTask& task, double edge, const std::vector<char>& held,
                       const Contour& contour, Points& vertices) {
  constexpr double kMost = 0.5;    // edges, root mean square
  constexpr double kLittle = 0.05; // of the farthest
  constexpr int kRounds = 10;
  const Region region{task.surface, task.wall};
  InsetProbe probe(region);
  Points inwards = Points::Zero(vertices.rows(), 3);
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    const auto i = static_cast<std::size_t>(v);
    if (contour.on[i] == On::Inset && (held.empty() || held[i] == 0))
      inwards.row(v) = probe.at(vertices.row(v).transpose(), task.wall).slope.transpose();
  }
  const Moments outer = task.model.solidMoments + task.model.attached;
  DisplacementTask displacement{
      task.goal,          task.weights, task.model.fillings, outer, task.model.solidMoments[0],
      contour.mesh.faces, inwards,      kMost * edge};
  displacement.movesLeast = true;
  for (int round = 0; round < kRounds && !inwards.isZero(0.0); ++round) {
    Points moved = vertices;
    if (displace(displacement, moved).violation > kFeasibility) return false;
    const Vector ways = (moved - vertices).cwiseProduct(inwards).rowwise().sum();
    if (ways.minCoeff() >= 0.0) {
      vertices = std::move(moved);
      return true;
    }
    // What would go outwards, or hardly inwards, stays.
    for (Eigen::Index v = 0; v < moved.rows(); ++v) {
      if (ways[v] < kLittle * ways.maxCoeff()) inwards.row(v).setZero();
    }
  }
  return false;
}

} // namespace massprops
