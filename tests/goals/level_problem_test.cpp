// The level itself as a variable, against closed forms and the smooth objective.
#include "core/goals/level_problem.h"

#include "core/goals/mass.h"
#include "core/goals/stand.h"
#include "core/goals/tipping.h"
#include "goals/goal_checks.h"

#include <gtest/gtest.h>

#include <cmath>

namespace massprops::testing {
namespace {

/// A body of mass 1 with its centre at (x, y, 0.5 − 0.1 x) plus where it begins.
BodyState bodyWith(const Vector& q, const Vec3& start) {
  BodyState state{Moments::Zero(), MomentJacobian::Zero(10, 2)};
  state.mass[0] = 1.0;
  state.mass.segment<3>(1) = start + Vec3(q[0], q[1], -0.1 * q[0]);
  state.jacobian(1, 0) = 1.0;
  state.jacobian(2, 1) = 1.0;
  state.jacobian(3, 0) = -0.1;
  return state;
}

TEST(LevelProblem, StopsAtTheKinkThatTheSmoothObjectiveRounds) {
  const Vec3 start(0.03, -0.02, 0.497);
  const auto goal = makeStandGoal(square(0.5), {});
  const auto conditions = conditionsOfMeasure(*goal, bodyAt(start));
  ASSERT_TRUE(conditions);
  const LevelProblem problem(*conditions, {}, {bodyWith(Vector::Zero(2), start)});
  const auto levelled = [&](const Vector& x) {
    return problem.at({bodyWith(x.head(2), start)}, 0.0, Vector::Zero(2), x[2]);
  };
  const auto smooth = [&](const Vector& x) {
    return evaluateBody(*goal, {}, {bodyWith(x, start)}, 0.0, Vector::Zero(2));
  };
  // Off the middle the body gets lower by less than it gets nearer to the edge.
  const Vector sharp = minimize(levelled, Vector::Zero(3)).x;
  EXPECT_LT(std::abs(start.x() + sharp[0]), 1e-6);
  EXPECT_LT(std::abs(start.y() + sharp[1]), 1e-6);
  const Vector rounded = minimize(smooth, Vector::Zero(2)).x;
  EXPECT_GT(std::abs(start.x() + rounded[0]), 1e-4);
  const auto reached = [&](const Vector& q) {
    return levelReached(*conditions, bodyWith(q, start).mass);
  };
  EXPECT_NEAR(reached(sharp.head(2)), 0.25 / 0.5, 1e-6);
  EXPECT_LT(reached(rounded), reached(sharp.head(2)));
}

TEST(LevelProblem, CountsTheWorstOfAllStates) {
  const auto goal = makeStandGoal(ellipse(0.2, 0.2), {});
  const auto conditions = conditionsOfMeasure(*goal, bodyAt({0, 0, 0.5}));
  ASSERT_TRUE(conditions);
  // What moves one body to the right moves both: the best is half way.
  const auto states = [](const Vector& q) {
    return std::vector<BodyState>{bodyWith(q, {0.06, 0, 0.5}), bodyWith(q, {-0.02, 0, 0.5})};
  };
  const LevelProblem problem(*conditions, {}, states(Vector::Zero(2)));
  const Vector x = minimize(
                       [&](const Vector& v) {
                         return problem.at(states(v.head(2)), 0.0, Vector::Zero(2), v[2]);
                       },
                       Vector::Zero(3))
                       .x;
  EXPECT_NEAR(x[0], -0.02, 1e-5);
}

TEST(LevelProblem, HasTheDerivativesOfItsConditions) {
  const Vec3 start(0.03, -0.02, 0.45);
  const auto goal = makeStandGoal(ellipse(0.2, 0.1), {});
  Weights weights;
  weights.volume = 0.7;
  const LevelProblem problem(*conditionsOfMeasure(*goal, bodyAt(start)), weights,
                             {bodyWith(Vector::Zero(2), start)});
  const Vector volumeSlope = Eigen::Vector2d(0.3, -0.2);
  const auto at = [&](const Vector& x) {
    return problem.at({bodyWith(x.head(2), start)}, volumeSlope.dot(x.head(2)), volumeSlope, x[2]);
  };
  const Vector x = Eigen::Vector3d(0.01, 0.02, -0.1);
  const Evaluation e = at(x);
  constexpr double kStep = 1e-5;
  for (int j = 0; j < 3; ++j) {
    const Evaluation high = at(x + kStep * Vector::Unit(3, j));
    const Evaluation low = at(x - kStep * Vector::Unit(3, j));
    EXPECT_NEAR(e.objectiveGradient[j], (high.objective - low.objective) / (2 * kStep), 1e-8);
    const Vector slope = (high.inequalities - low.inequalities) / (2 * kStep);
    EXPECT_LT((e.inequalityJacobian.col(j) - slope).norm(), 1e-7);
  }
  // All hold at the start, the one that the body tips over in barely.
  EXPECT_NEAR(at(Vector::Zero(3)).inequalities.maxCoeff(), 0.0, 1e-12);
}

TEST(LevelProblem, IsForGoalsOfOneConditionWhoseLevelIsAllThatCounts) {
  const Moments body = bodyAt({0, 0, 0.5});
  EXPECT_TRUE(conditionsOfMeasure(*makeStandGoal(square(1.0), {}), body));
  // The least material that stands up to an angle is another matter.
  EXPECT_FALSE(conditionsOfMeasure(*makeStandGoal(square(1.0), {}, 10.0, 1.0), body));
  EXPECT_FALSE(conditionsOfMeasure(*makeMassGoal(1.0, 0.5, {}), body));
}

} // namespace
} // namespace massprops::testing
