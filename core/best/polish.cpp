#include "core/best/polish.h"

#include "core/base/symmetric_eigen.h"
#include "core/base/tolerances.h"
#include "core/contour/region.h"
#include "core/contour/shape_guard.h"
#include "core/goals/objective.h"
#include "core/optimum/layered_quadric.h"

#include <vector>

namespace massprops {
namespace {

/// Where each vertex goes while the quadric rises by a unit of length; 0 for those that stay.
Points directionsOf(const Region& region, Moving moving, const std::vector<char>& held,
                    const Contour& contour) {
  const Points& vertices = contour.mesh.vertices;
  Points directions = Points::Zero(vertices.rows(), 3);
  InsetProbe probe(region);
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    const On on = contour.on[static_cast<std::size_t>(v)];
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

/// Functions of unit mean square over the vertices that move, orthogonal there: of the terms of a
/// quadric, or of a plane. n×r, 0 for those that stay.
RowMatrix functionsOf(const Points& vertices, const Points& directions, Eigen::Index terms) {
  RowMatrix values = RowMatrix::Zero(vertices.rows(), terms);
  double count = 0.0;
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    if (directions.row(v).isZero(0.0)) continue;
    values.row(v) = monomials(vertices.row(v).transpose()).head(terms).transpose();
    count += 1.0;
  }
  if (count == 0.0) return {};
  const SymmetricEigen<Matrix> spectrum =
      symmetricEigen(Matrix(values.transpose() * values / count));
  constexpr double kLeastSquare = 1e-8; // of the largest
  const Eigen::Index rank =
      (spectrum.values.array() > kLeastSquare * spectrum.values[terms - 1]).count();
  return values * spectrum.vectors.rightCols(rank) *
         spectrum.values.tail(rank).cwiseInverse().cwiseSqrt().asDiagonal();
}

} // namespace

Polished polish(const CavityTask& task, const LayeredQuadric& quadric, Moving moving, double edge,
                const std::vector<char>& held, Contour& contour) {
  constexpr double kFarthest = 0.3; // edges, root mean square of the displacements
  const double farthest = kFarthest * edge;
  const Region region{task.surface, task.wall, nullptr, quadric, edge};
  const Faces& faces = contour.mesh.faces;
  const Points start = contour.mesh.vertices;
  const bool usesInertia = task.goal.usesInertia();
  const Points directions = directionsOf(region, moving, held, contour);
  constexpr double kUnit = 0.05; // of the farthest: what the solver's variables are 1 for
  const RowMatrix functions =
      kUnit * farthest * functionsOf(start, directions, usesInertia ? 10 : 4);
  if (functions.size() == 0) return {};
  const auto displaced = [&](const Vector& q) {
    return Points(start + (functions * q).asDiagonal() * directions);
  };
  const BodyState outer{task.model.solidMoments, MomentJacobian::Zero(10, functions.cols())};
  const double solid = outer.mass[0];
  const auto withJacobian = [&](const MomentsWithRates& both) {
    BodyState state{both.moments, MomentJacobian::Zero(10, functions.cols())};
    state.jacobian.topRows(both.rates.cols()) = both.rates.transpose() * functions;
    return state;
  };
  const auto evaluateAt = [&](const Vector& q) {
    const Points vertices = displaced(q);
    const BodyState cavity =
        withJacobian(momentsWithRates(vertices, faces, directions, usesInertia));
    const std::vector<BodyState> states =
        bodyStates(task.model.fillings, outer, cavity, [&](double level) {
          return withJacobian(momentsBelowWithRates(vertices, faces, directions, level));
        });
    return evaluateBody(task.goal, task.weights, states, 1.0 - cavity.mass[0] / solid,
                        -cavity.jacobian.row(0).transpose() / solid);
  };
  MinimizeOptions options;
  options.feasibility = 0.1 * kFeasibility; // rounding needs the rest
  options.range = 1.0 / kUnit;
  options.maxEvaluations = 40;
  const MinimizeResult result = minimize(evaluateAt, Vector::Zero(functions.cols()), options);
  if (moving == Moving::CutAlone) {
    contour.mesh.vertices = displaced(result.x);
  } else {
    moveSoundly(displaced(result.x), faces, contour.mesh.vertices);
  }
  return {result.evaluations, result.violation};
}

} // namespace massprops
