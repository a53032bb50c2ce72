#include "core/reduced/displacement.h"

#include "core/base/symmetric_eigen.h"
#include "core/base/tolerances.h"
#include "core/goals/level_problem.h"
#include "core/goals/objective.h"
#include "core/mesh/components.h"
#include "core/optimum/layered_quadric.h"

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace massprops {
namespace {

/// The rows of the vertices of a part.
template <class Rows>
Rows rowsOf(const Rows& all, const Submesh& part) {
  return all(part.vertexOf, Eigen::all);
}

/// Functions of unit mean square over the vertices of a part that move, orthogonal there: of those
/// that are given or else of the terms of a quadric, or of a plane. m×r, 0 for those that stay.
RowMatrix functionsOn(const Submesh& part, const DisplacementTask& task) {
  const Points& vertices = part.mesh.vertices;
  const bool isGiven = task.functions.size() > 0;
  const Eigen::Index terms = isGiven ? task.functions.cols() : task.goal.usesInertia() ? 10 : 4;
  RowMatrix values = RowMatrix::Zero(vertices.rows(), terms);
  double count = 0.0;
  for (Eigen::Index i = 0; i < vertices.rows(); ++i) {
    const int v = part.vertexOf[static_cast<std::size_t>(i)];
    if (task.directions.row(v).isZero(0.0)) continue;
    if (isGiven) {
      values.row(i) = task.functions.row(v);
    } else {
      values.row(i) = monomials(vertices.row(i).transpose()).head(terms).transpose();
    }
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

/// With a vertex that moves.
Faces movingFaces(const DisplacementTask& task) {
  std::vector<int> moving;
  for (Eigen::Index f = 0; f < task.faces.rows(); ++f) {
    const auto corners = task.faces.row(f);
    if (std::any_of(corners.begin(), corners.end(),
                    [&](int v) { return !task.directions.row(v).isZero(0.0); }))
      moving.push_back(static_cast<int>(f));
  }
  return task.faces(moving, Eigen::all);
}

} // namespace

Displaced displace(const DisplacementTask& task, Points& vertices) {
  const bool usesInertia = task.goal.usesInertia();
  constexpr double kUnit = 0.05; // of the farthest: what the solver's variables are 1 for
  // Of a large cavity often little moves.
  const Submesh part = submesh(vertices, movingFaces(task));
  const RowMatrix functions = kUnit * task.farthest * functionsOn(part, task);
  if (functions.size() == 0) return {};
  const Points directions = rowsOf(task.directions, part);
  const Moments atRest = moments(vertices, task.faces, usesInertia) -
                         moments(part.mesh.vertices, part.mesh.faces, usesInertia);
  const auto displaced = [&](const Vector& q) {
    return Points(part.mesh.vertices + (functions * q).asDiagonal() * directions);
  };
  const auto put = [&](const Points& moved, Points& whole) {
    whole(part.vertexOf, Eigen::all) = moved;
  };
  const BodyState outer{task.outer, MomentJacobian::Zero(10, functions.cols())};
  const auto withJacobian = [&](const MomentsWithRates& both) {
    BodyState state{both.moments, MomentJacobian::Zero(10, functions.cols())};
    state.jacobian.topRows(both.rates.cols()) = both.rates.transpose() * functions;
    return state;
  };
  const Eigen::Index count = functions.cols();
  struct Evaluated {
    std::vector<BodyState> states;
    double volumeShare;
    Vector volumeShareGradient;
  };
  const auto bodyAt = [&](const Vector& q) {
    const Points moved = displaced(q);
    BodyState cavity =
        withJacobian(momentsWithRates(moved, part.mesh.faces, directions, usesInertia));
    cavity.mass += atRest;
    const auto contents = [&](double level) {
      Points whole = vertices;
      put(moved, whole);
      MomentsWithRates below = momentsBelowWithRates(whole, task.faces, task.directions, level);
      below.rates = rowsOf(below.rates, part);
      return withJacobian(below);
    };
    return Evaluated{bodyStates(task.fillings, outer, cavity, contents),
                     outer.mass[0] / task.solidVolume - cavity.mass[0] / task.solidVolume,
                     -cavity.jacobian.row(0).transpose() / task.solidVolume};
  };
  std::optional<LevelProblem> levels;
  if (task.raisesLevel) {
    const std::vector<BodyState> states = bodyAt(Vector::Zero(count)).states;
    if (auto conditions = conditionsOfMeasure(task.goal, states.front().mass))
      levels.emplace(std::move(*conditions), task.weights, states);
  }
  const auto evaluateAt = [&](const Vector& q) {
    const Evaluated body = bodyAt(q.head(count));
    if (levels)
      return levels->at(body.states, body.volumeShare, body.volumeShareGradient, q[count]);
    Evaluation evaluation = evaluateBody(task.goal, task.weights, body.states, body.volumeShare,
                                         body.volumeShareGradient);
    if (task.movesLeast) {
      evaluation.objective = 0.5 * q.squaredNorm();
      evaluation.objectiveGradient = q;
    }
    return evaluation;
  };
  MinimizeOptions options;
  options.feasibility = 0.1 * kFeasibility; // rounding needs the rest
  options.range = 1.0 / kUnit;
  options.maxEvaluations = 40;
  options.comesNearest = task.comesNearest;
  MinimizeResult result;
  int evaluations = 0;
  // From where very many conditions are as good as active, as on a round contact area, SLSQP may
  // not take a step; from below them it does.
  constexpr double kBelow = 5.0;
  for (const double below : {0.0, kBelow}) {
    Vector from = Vector::Zero(levels ? count + 1 : count);
    if (levels) from[count] = -below;
    result = minimize(evaluateAt, from, options);
    evaluations += result.evaluations;
    if (!levels || !result.x.head(count).isZero(0.0)) break;
  }
  if (levels && result.x[count] <= 0.0) result.x.setZero(); // no higher than it was
  put(displaced(result.x.head(count)), vertices);
  constexpr double kNearly = 0.99;
  const bool isFarthest = result.x.head(count).cwiseAbs().maxCoeff() >= kNearly * options.range;
  return {evaluations, levels ? 0.0 : result.violation, isFarthest};
}

} // namespace massprops
