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

/// The terms of a quadric, or of a plane where moments of inertia do not count, over the vertices
/// of a part that move: of unit mean square and orthogonal there. m×r, 0 for those that stay.
RowMatrix functionsOn(const Submesh& part, const DisplacementTask& task) {
  const Points& vertices = part.mesh.vertices;
  const Eigen::Index terms = task.goal.usesInertia() ? 10 : 4;
  RowMatrix values = RowMatrix::Zero(vertices.rows(), terms);
  double count = 0.0;
  for (Eigen::Index i = 0; i < vertices.rows(); ++i) {
    const int v = part.vertexOf[static_cast<std::size_t>(i)];
    if (task.directions.row(v).isZero(0.0)) continue;
    values.row(i) = monomials(vertices.row(i).transpose()).head(terms).transpose();
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

constexpr double kUnit = 0.05; // of the farthest: what the solver's variables are 1 for

/// The body as its cavity is displaced by q times the functions.
class DisplacedBody {
public:
  DisplacedBody(const DisplacementTask& task, const Points& vertices)
      : task_(task), vertices_(vertices), usesInertia_(task.goal.usesInertia()),
        part_(submesh(vertices, movingFaces(task))),
        functions_(kUnit * task.farthest * functionsOn(part_, task)),
        directions_(task.directions(part_.vertexOf, Eigen::all)),
        atRest_(moments(vertices, task.faces, usesInertia_) -
                moments(part_.mesh.vertices, part_.mesh.faces, usesInertia_)) {}

  Eigen::Index count() const { return functions_.cols(); }

  Points cavityAt(const Vector& q) const { return withPart(partAt(q)); }

  std::vector<BodyState> statesAt(const Vector& q) const { return bodyAt(q).states; }

  /// `q`: with levels their variable is the last.
  Evaluation at(const Vector& q, const std::optional<LevelProblem>& levels) const {
    const Body body = bodyAt(q.head(count()));
    if (levels) return levels->at(body.states, body.share, body.shareGradient, q[count()]);
    Evaluation evaluation =
        evaluateBody(task_.goal, task_.weights, body.states, body.share, body.shareGradient);
    if (task_.movesLeast) {
      evaluation.objective = 0.5 * q.squaredNorm();
      evaluation.objectiveGradient = q;
    }
    return evaluation;
  }

private:
  struct Body {
    std::vector<BodyState> states;
    double share; ///< of the solid volume
    Vector shareGradient;
  };

  Points partAt(const Vector& q) const {
    return part_.mesh.vertices + (functions_ * q).asDiagonal() * directions_;
  }

  Points withPart(const Points& moved) const {
    Points whole = vertices_;
    whole(part_.vertexOf, Eigen::all) = moved;
    return whole;
  }

  BodyState withJacobian(const Moments& moments, const RowMatrix& rates) const {
    BodyState state{moments, MomentJacobian::Zero(10, count())};
    state.jacobian.topRows(rates.cols()) = rates.transpose() * functions_;
    return state;
  }

  Body bodyAt(const Vector& q) const {
    const Points moved = partAt(q);
    const MomentsWithRates all =
        momentsWithRates(moved, part_.mesh.faces, directions_, usesInertia_);
    const BodyState cavity = withJacobian(all.moments + atRest_, all.rates);
    const auto contents = [&](double level) {
      const MomentsWithRates below =
          momentsBelowWithRates(withPart(moved), task_.faces, task_.directions, level);
      return withJacobian(below.moments, below.rates(part_.vertexOf, Eigen::all));
    };
    const BodyState outer{task_.outer, MomentJacobian::Zero(10, count())};
    return {bodyStates(task_.fillings, outer, cavity, contents),
            (outer.mass[0] - cavity.mass[0]) / task_.solidVolume,
            -cavity.jacobian.row(0).transpose() / task_.solidVolume};
  }

  const DisplacementTask& task_;
  const Points vertices_;
  const bool usesInertia_;
  const Submesh part_; ///< of a large cavity often little moves
  const RowMatrix functions_;
  const Points directions_;
  const Moments atRest_;
};

} // namespace

Displaced displace(const DisplacementTask& task, Points& vertices) {
  const DisplacedBody body(task, vertices);
  const Eigen::Index count = body.count();
  if (count == 0) return {};
  std::optional<LevelProblem> levels;
  if (task.raisesLevel) {
    const std::vector<BodyState> states = body.statesAt(Vector::Zero(count));
    if (auto conditions = conditionsOfMeasure(task.goal, states.front().mass))
      levels.emplace(std::move(*conditions), task.weights, states);
  }
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
    result = minimize([&](const Vector& q) { return body.at(q, levels); }, from, options);
    evaluations += result.evaluations;
    if (!levels || !result.x.head(count).isZero(0.0)) break;
  }
  if (levels && result.x[count] <= 0.0) result.x.setZero(); // no higher than it was
  vertices = body.cavityAt(result.x.head(count));
  constexpr double kNearly = 0.99;
  const bool isFarthest = result.x.head(count).cwiseAbs().maxCoeff() >= kNearly * options.range;
  return {evaluations, levels ? 0.0 : result.violation, isFarthest};
}

} // namespace massprops
