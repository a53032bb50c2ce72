#include "core/goals/objective.h"

#include "core/base/soft_maximum.h"
#include "core/goals/tipping.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace massprops {
namespace {

/// Of the goal's objective over the states: that of the directions in which a body may tip over,
/// whose tangents have the weight of the centre of mass.
double sharpness(const Weights& weights) {
  return weights.centerOfMass > 0.0 ? kTippingSharpness / weights.centerOfMass : kTippingSharpness;
}

/// Values and derivatives by the variables, of all states one below the other.
struct Constraints {
  Vector values;
  Matrix jacobian;
};

Constraints constraints(const std::vector<GoalConstraints>& ofStates,
                        const std::vector<BodyState>& states) {
  Eigen::Index rows = 0;
  for (const GoalConstraints& own : ofStates) rows += own.values.size();
  Constraints all{Vector(rows), Matrix(rows, states.front().jacobian.cols())};
  Eigen::Index row = 0;
  for (std::size_t s = 0; s < states.size(); ++s) {
    const Eigen::Index count = ofStates[s].values.size();
    all.values.segment(row, count) = ofStates[s].values;
    all.jacobian.middleRows(row, count) = ofStates[s].gradients * states[s].jacobian;
    row += count;
  }
  return all;
}

} // namespace

std::vector<BodyState> bodyStates(const Fillings& fillings, const BodyState& outer,
                                  const BodyState& cavity,
                                  const std::function<BodyState(double)>& below) {
  const Eigen::Index k = cavity.jacobian.cols();
  std::vector<BodyState> states;
  states.reserve(fillings.size());
  for (const Filling& filling : fillings) {
    const double density = filling.isPartial() ? 0.0 : filling.density;
    BodyState state{shellMoments(outer.mass, cavity.mass, 1.0, density), outer.jacobian};
    state.jacobian.leftCols(k) += (density - 1.0) * cavity.jacobian;
    if (filling.isPartial()) {
      const BodyState contents = below(filling.level);
      state.mass += filling.density * contents.mass;
      state.jacobian.leftCols(k) += filling.density * contents.jacobian;
    }
    states.push_back(std::move(state));
  }
  return states;
}

Weights insteadOfConstraints(Weights weights) {
  weights.volume = 0.0;
  return weights;
}

double momentObjective(const Goal& goal, const Weights& weights, const std::vector<Moments>& states,
                       double volumeShare) {
  Vector values(static_cast<Eigen::Index>(states.size()));
  double violation = 0.0;
  Eigen::Index s = 0;
  for (const Moments& state : states) {
    values[s++] = goal.objective(state).value;
    violation += goal.equalities(state).values.squaredNorm() +
                 goal.inequalities(state).values.cwiseMax(0.0).squaredNorm();
  }
  return softMaximum(values, sharpness(weights)).value + weights.volume * volumeShare +
         weights.constraints * violation;
}

Evaluation evaluateBody(const Goal& goal, const Weights& weights,
                        const std::vector<BodyState>& states, double volumeShare,
                        const Vector& volumeShareGradient) {
  std::vector<GoalValue> goalValues;
  Vector values(static_cast<Eigen::Index>(states.size()));
  for (const BodyState& state : states) {
    goalValues.push_back(goal.objective(state.mass));
    values[static_cast<Eigen::Index>(goalValues.size()) - 1] = goalValues.back().value;
  }
  const SoftMaximum worst = softMaximum(values, sharpness(weights));
  Evaluation e;
  e.objective = worst.value + weights.volume * volumeShare;
  e.objectiveGradient = weights.volume * volumeShareGradient;
  for (std::size_t s = 0; s < states.size(); ++s) {
    e.objectiveGradient += worst.shares[static_cast<Eigen::Index>(s)] *
                           (goalValues[s].gradient * states[s].jacobian).transpose();
  }
  if (weights.constraints == 0.0) return e;

  std::vector<GoalConstraints> equalities;
  std::vector<GoalConstraints> inequalities;
  for (const BodyState& state : states) {
    equalities.push_back(goal.equalities(state.mass));
    inequalities.push_back(goal.inequalities(state.mass));
  }
  Constraints equal = constraints(equalities, states);
  Constraints below = constraints(inequalities, states);
  const Vector violation = below.values.cwiseMax(0.0);
  e.objective += weights.constraints * (equal.values.squaredNorm() + violation.squaredNorm());
  e.objectiveGradient +=
      2.0 * weights.constraints *
      (equal.jacobian.transpose() * equal.values + below.jacobian.transpose() * violation);
  e.equalities = std::move(equal.values);
  e.equalityJacobian = std::move(equal.jacobian);
  e.inequalities = std::move(below.values);
  e.inequalityJacobian = std::move(below.jacobian);
  return e;
}

double largestViolation(const Goal& goal, const std::vector<Moments>& states) {
  double largest = 0.0;
  for (const Moments& state : states) largest = std::max(largest, largestViolation(goal, state));
  return largest;
}

std::optional<double> measure(const Goal& goal, const std::vector<Moments>& states) {
  std::optional<double> least;
  for (const Moments& state : states) {
    const std::optional<double> own = goal.measure(state);
    if (own && (!least || *own < *least)) least = own;
  }
  return least;
}

} // namespace massprops
