// The solver on problems with known solutions.
#include "core/base/minimize.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace massprops::testing {
namespace {

Vector vector(std::initializer_list<double> values) {
  Vector result(static_cast<Eigen::Index>(values.size()));
  Eigen::Index i = 0;
  for (const double v : values) result[i++] = v;
  return result;
}

/// Rosenbrock's valley, least 0 at (1, 1).
Evaluation rosenbrock(const Vector& x) {
  Evaluation e;
  const double a = 1 - x[0];
  const double b = x[1] - x[0] * x[0];
  e.objective = a * a + 100 * b * b;
  e.objectiveGradient = vector({-2 * a - 400 * x[0] * b, 200 * b});
  return e;
}

/// x² + y² subject to x + y = 1 and x ≤ 0.2: least at (0.2, 0.8).
Evaluation constrained(const Vector& x) {
  Evaluation e;
  e.objective = x.squaredNorm();
  e.objectiveGradient = 2 * x;
  e.equalities = vector({x[0] + x[1] - 1});
  e.equalityJacobian = Matrix::Ones(1, 2);
  e.inequalities = vector({x[0] - 0.2});
  e.inequalityJacobian.resize(1, 2);
  e.inequalityJacobian << 1, 0;
  return e;
}

MinimizeOptions patient() {
  MinimizeOptions options;
  options.maxEvaluations = 500;
  options.objectiveTolerance = 1e-12;
  return options;
}

TEST(Minimize, FollowsRosenbrocksValley) {
  const MinimizeResult result = minimize(rosenbrock, vector({-1.2, 1.0}), patient());
  EXPECT_LT((result.x - vector({1, 1})).norm(), 1e-3);
  EXPECT_LT(result.objective, 1e-6);
  EXPECT_EQ(result.violation, 0.0);
}

TEST(Minimize, MeetsEqualitiesAndInequalities) {
  const MinimizeResult result = minimize(constrained, vector({3.0, -2.0}), patient());
  EXPECT_LT((result.x - vector({0.2, 0.8})).norm(), 1e-5);
  EXPECT_LT(result.violation, 1e-6);
}

TEST(Minimize, DoesNotDependOnTheScaleOfTheObjective) {
  // Up to rounding: the objective is scaled to a gradient of fixed length at the start.
  const auto larger = [](const Vector& x) {
    Evaluation e = constrained(x);
    e.objective *= 1e4;
    e.objectiveGradient *= 1e4;
    return e;
  };
  const MinimizeResult a = minimize(constrained, vector({3.0, -2.0}), patient());
  const MinimizeResult b = minimize(larger, vector({3.0, -2.0}), patient());
  EXPECT_LT((a.x - b.x).norm(), 1e-6);
}

TEST(Minimize, IsNeverWorseThanItsStart) {
  // A gradient of the wrong sign leads uphill only.
  const auto liar = [](const Vector& x) {
    Evaluation e;
    e.objective = x.squaredNorm();
    e.objectiveGradient = -2 * x;
    return e;
  };
  const Vector start = vector({0.5, -0.25, 1.0});
  const MinimizeResult result = minimize(liar, start);
  EXPECT_LE(result.objective, start.squaredNorm());
}

TEST(Minimize, ReturnsTheObjectiveAndViolationOfItsPoint) {
  const MinimizeResult result = minimize(constrained, vector({3.0, -2.0}));
  const Evaluation e = constrained(result.x);
  EXPECT_EQ(result.objective, e.objective);
  EXPECT_EQ(result.violation, std::max({std::abs(e.equalities[0]), e.inequalities[0], 0.0}));
}

TEST(Minimize, ReportsTheViolationOfAnInfeasibleProblemInsteadOfThrowing) {
  // x = 0 and x ≥ 1 at once: the best that can be done is to miss one of them.
  const auto impossible = [](const Vector& x) {
    Evaluation e;
    e.objective = x[0] * x[0];
    e.objectiveGradient = 2 * x;
    e.equalities = x;
    e.equalityJacobian = Matrix::Identity(1, 1);
    e.inequalities = Vector::Constant(1, 1.0 - x[0]);
    e.inequalityJacobian = -Matrix::Identity(1, 1);
    return e;
  };
  const MinimizeResult result = minimize(impossible, vector({0.3}));
  EXPECT_GE(result.violation, 0.49);
  EXPECT_FALSE(result.stopReason.empty());
}

TEST(Minimize, NeverReturnsAPointWithoutAValue) {
  // A violated constraint at the start and no number where it would hold: the greatest of 0 and a
  // violation that is no number came out as 0, better than any.
  const auto cliff = [](const Vector& x) {
    Evaluation e;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const bool beyond = !(x[0] < 0.5);
    e.objective = beyond ? nan : -x[0];
    e.objectiveGradient = vector({-1.0, 0.0});
    e.inequalities = vector({beyond ? nan : 1.0 - x[0]});
    e.inequalityJacobian.resize(1, 2);
    e.inequalityJacobian << -1, 0;
    return e;
  };
  for (const double start : {0.0, 2.0}) {
    const MinimizeResult result = minimize(cliff, vector({start, 0.0}), patient());
    EXPECT_TRUE(result.x.allFinite());
    if (start < 0.5) {
      EXPECT_TRUE(std::isfinite(result.objective));
      EXPECT_LT(result.x[0], 0.5);
    }
  }
}

TEST(Minimize, SaysSoWhenNoEvaluationIsFinite) {
  const auto nowhere = [](const Vector& x) {
    Evaluation e;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    e.objective = nan;
    e.objectiveGradient = Vector::Constant(x.size(), nan);
    e.inequalities = vector({nan});
    e.inequalityJacobian = Matrix::Constant(1, x.size(), nan);
    return e;
  };
  const MinimizeResult result = minimize(nowhere, vector({0.3, 0.1}));
  EXPECT_EQ(result.x, vector({0.3, 0.1}));
  EXPECT_EQ(result.violation, std::numeric_limits<double>::infinity());
  EXPECT_EQ(result.objective, std::numeric_limits<double>::infinity());
  EXPECT_EQ(result.stopReason, "no evaluation was finite");
}

TEST(Minimize, KeepsToItsEvaluationLimit) {
  MinimizeOptions few;
  few.maxEvaluations = 5;
  int calls = 0;
  const auto counting = [&](const Vector& x) {
    ++calls;
    return rosenbrock(x);
  };
  const MinimizeResult result = minimize(counting, vector({-1.2, 1.0}), few);
  EXPECT_LE(calls, 7); // the first one for the scales, and one that a line search may finish
  EXPECT_EQ(result.evaluations, calls);
}

TEST(Minimize, StaysWithinItsBox) {
  const auto slope = [](const Vector& x) {
    Evaluation e;
    e.objective = x.sum();
    e.objectiveGradient = Vector::Ones(x.size());
    return e;
  };
  MinimizeOptions options;
  options.range = 3.0;
  const MinimizeResult result = minimize(slope, vector({0, 0}), options);
  EXPECT_LT((result.x - vector({-3, -3})).norm(), 1e-9);
}

TEST(Minimize, IsTheSameBitForBitTheSecondTime) {
  const MinimizeResult a = minimize(rosenbrock, vector({-1.2, 1.0}));
  const MinimizeResult b = minimize(rosenbrock, vector({-1.2, 1.0}));
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.evaluations, b.evaluations);
}

TEST(Minimize, GoesToTheLeastViolationOfMoreEqualitiesThanVariables) {
  // x = 0 and x = 1 at once.
  const auto contradiction = [](const Vector& x) {
    Evaluation e;
    e.objective = x[0];
    e.objectiveGradient = Vector::Ones(1);
    e.equalities = vector({x[0], x[0] - 1.0});
    e.equalityJacobian = Matrix::Ones(2, 1);
    return e;
  };
  const MinimizeResult result = minimize(contradiction, vector({5.0}), patient());
  EXPECT_NEAR(result.x[0], 0.5, 1e-3);
  EXPECT_NEAR(result.violation, 0.5, 1e-3);
}

/// x² + y² = 1 and x ≥ 2, twice, at once.
Evaluation outOfReach(const Vector& x) {
  Evaluation e;
  e.objective = x[1];
  e.objectiveGradient = vector({0, 1});
  e.equalities = vector({x.squaredNorm() - 1});
  e.equalityJacobian = 2 * x.transpose();
  e.inequalities = Vector::Constant(2, 2 - x[0]);
  e.inequalityJacobian.resize(2, 2);
  e.inequalityJacobian << -1, 0, -1, 0;
  return e;
}

TEST(Minimize, ComesNearestByTheLargestViolation) {
  MinimizeOptions options = patient();
  const double squares = minimize(outOfReach, vector({0.5, 0.7}), options).violation;
  options.comesNearest = true;
  const MinimizeResult nearest = minimize(outOfReach, vector({0.5, 0.7}), options);
  // Least where y = 0 and x² − 1 = 2 − x.
  const double x = 0.5 * (std::sqrt(13.0) - 1.0);
  EXPECT_LT((nearest.x - vector({x, 0})).norm(), 1e-3);
  EXPECT_NEAR(nearest.violation, 2.0 - x, 1e-6);
  EXPECT_GT(squares, 1.03 * nearest.violation);
}

TEST(Minimize, ComesNearestToEqualitiesOrInequalitiesAlone) {
  // x = 0 and x = 3, or x ≤ 0 and x ≥ 3 twice.
  const auto equalities = [](const Vector& x) {
    Evaluation e;
    e.objectiveGradient = Vector::Zero(2);
    e.equalities = vector({x[0], x[0] - 3, x[0] - 3});
    e.equalityJacobian = Matrix::Zero(3, 2);
    e.equalityJacobian.col(0).setOnes();
    return e;
  };
  const auto inequalities = [](const Vector& x) {
    Evaluation e;
    e.objectiveGradient = Vector::Zero(2);
    e.inequalities = vector({x[0], 3 - x[0], 3 - x[0]});
    e.inequalityJacobian = Matrix::Zero(3, 2);
    e.inequalityJacobian.col(0) = vector({1, -1, -1});
    return e;
  };
  MinimizeOptions options = patient();
  options.comesNearest = true;
  EXPECT_NEAR(minimize(equalities, vector({0.5, 0.7}), options).violation, 1.5, 1e-6);
  EXPECT_NEAR(minimize(inequalities, vector({0.5, 0.7}), options).violation, 1.5, 1e-6);
}

TEST(Minimize, DoesNotGiveUpTheObjectiveWhereConstraintsHold) {
  MinimizeOptions options = patient();
  const MinimizeResult plain = minimize(constrained, vector({3.0, -2.0}), options);
  options.comesNearest = true;
  EXPECT_EQ(minimize(constrained, vector({3.0, -2.0}), options).x, plain.x);
}

} // namespace
} // namespace massprops::testing
