#include "core/goals/objective.h"

namespace massprops {

double momentObjective(const Goal& goal, const Weights& weights, const Moments& massMoments,
                       double volumeShare) {
  return goal.objective(massMoments).value + weights.volume * volumeShare +
         weights.constraints * (goal.equalities(massMoments).values.squaredNorm() +
                                goal.inequalities(massMoments).values.cwiseMax(0.0).squaredNorm());
}

Evaluation evaluateBody(const Goal& goal, const Weights& weights, const Moments& massMoments,
                        const MomentJacobian& massJacobian, double volumeShare,
                        const Vector& volumeShareGradient) {
  Evaluation e;
  const GoalValue value = goal.objective(massMoments);
  e.objective = value.value + weights.volume * volumeShare;
  e.objectiveGradient =
      (value.gradient * massJacobian).transpose() + weights.volume * volumeShareGradient;
  if (weights.constraints == 0.0) return e;

  GoalConstraints equalities = goal.equalities(massMoments);
  GoalConstraints inequalities = goal.inequalities(massMoments);
  e.equalityJacobian = equalities.gradients * massJacobian;
  e.inequalityJacobian = inequalities.gradients * massJacobian;
  const Vector violation = inequalities.values.cwiseMax(0.0);
  e.objective += weights.constraints * (equalities.values.squaredNorm() + violation.squaredNorm());
  e.objectiveGradient += 2.0 * weights.constraints *
                         (e.equalityJacobian.transpose() * equalities.values +
                          e.inequalityJacobian.transpose() * violation);
  e.equalities = std::move(equalities.values);
  e.inequalities = std::move(inequalities.values);
  return e;
}

} // namespace massprops
