#include "core/goals/level_problem.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace massprops {

std::optional<LinearConditions> conditionsOfMeasure(const Goal& goal, const Moments& body) {
  std::vector<LinearConditions> conditions = goal.conditions();
  const bool isAll = conditions.size() == 1 && goal.measure(body) &&
                     goal.equalities(body).values.size() == 0 &&
                     goal.inequalities(body).values.size() == 0;
  if (!isAll) return std::nullopt;
  return std::move(conditions.front());
}

LevelProblem::LevelProblem(LinearConditions conditions, const Weights& weights,
                           const std::vector<BodyState>& start)
    : conditions_(std::move(conditions)), volumeWeight_(weights.volume),
      levelWeight_(weights.centerOfMass), start_(std::numeric_limits<double>::infinity()) {
  for (const BodyState& state : start)
    start_ = std::min(start_, levelReached(conditions_, state.mass));
  perLevel_ = Vector::Ones(rows() * static_cast<Eigen::Index>(start.size()));
  const Eigen::Index k = start.front().jacobian.cols();
  const Matrix raw = at(start, 0.0, Vector::Zero(k), 0.0).inequalityJacobian;
  perLevel_ = raw.col(k);
  const double change = raw.leftCols(k).rowwise().norm().cwiseQuotient(perLevel_).maxCoeff();
  if (change > 0.0) unit_ = change;
}

Evaluation LevelProblem::at(const std::vector<BodyState>& states, double volumeShare,
                            const Vector& volumeShareGradient, double level) const {
  const Eigen::Index k = volumeShareGradient.size();
  Evaluation e;
  e.objective = volumeWeight_ * volumeShare - levelWeight_ * unit_ * level;
  e.objectiveGradient.resize(k + 1);
  e.objectiveGradient << volumeWeight_ * volumeShareGradient, -levelWeight_ * unit_;
  e.inequalities.resize(perLevel_.size());
  e.inequalityJacobian.resize(perLevel_.size(), k + 1);
  const AffineRows& slopes = conditions_.slopes;
  const AffineRows together = conditions_.atZero + (start_ + unit_ * level) * slopes;
  Eigen::Index row = 0;
  for (const BodyState& state : states) {
    e.inequalities.segment(row, rows()) = together.leftCols<10>() * state.mass + together.col(10);
    auto jacobian = e.inequalityJacobian.middleRows(row, rows());
    jacobian.leftCols(k) = together.leftCols<10>() * state.jacobian;
    jacobian.col(k) = unit_ * (slopes.leftCols<10>() * state.mass + slopes.col(10));
    row += rows();
  }
  e.inequalities.array() /= perLevel_.array();
  e.inequalityJacobian.array().colwise() /= perLevel_.array();
  return e;
}

} // namespace massprops
