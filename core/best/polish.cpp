#include "core/best/polish.h"

#include "core/contour/region.h"
#include "core/contour/shape_guard.h"
#include "core/goals/objective.h"
#include "core/optimum/layered_quadric.h"
#include "core/reduced/displacement.h"

#include <memory>
#include <utility>
#include <vector>

namespace massprops {
namespace {

/// Where each vertex goes while the quadric rises by a unit of length; 0 for those that stay.
Points directionsOf(const Region& region, Moving moving, const std::vector<char>& held,
                    const std::vector<On>& ons, const Points& vertices) {
  Points directions = Points::Zero(vertices.rows(), 3);
  InsetProbe probe(region);
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    const On on = ons[static_cast<std::size_t>(v)];
    if (on != On::Cut && (on != On::Crease || moving == Moving::CutAlone)) continue;
    if (!held.empty() && held[static_cast<std::size_t>(v)] != 0) continue;
    const Vec3 x = vertices.row(v).transpose();
    const Vec3 cut = cutAt(region, x).slope;
    if (on == On::Cut) {
      directions.row(v) = -cut.transpose();
      continue;
    }
    const Vec3 inset = probe.at(x, region.wall).slope;
    const Vec3 along = cut - cut.dot(inset) * inset;
    constexpr double kSteep = 0.2; // where they are nearly parallel the crease would run away
    if (along.squaredNorm() > kSteep)
      directions.row(v) = -(along / along.squaredNorm()).transpose();
  }
  return directions;
}

} // namespace

Polished polish(const CavityTask& task, const LayeredQuadric& quadric, Moving moving, double edge,
                const std::vector<char>& held, const Contour& contour, Points& vertices) {
  constexpr double kFarthest = 0.3; // edges, root mean square of the displacements
  const Region region{task.surface, task.wall, {}, quadric, edge};
  const Points directions = directionsOf(region, moving, held, contour.on, vertices);
  const Moments outer = task.model.solidMoments + task.model.attached;
  const std::unique_ptr<Goal> instead =
      task.bound->isReachable() ? nullptr : task.goal.insteadOfConstraints();
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

} // namespace massprops
