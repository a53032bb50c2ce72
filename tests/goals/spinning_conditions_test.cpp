// The linear conditions of Spin and Yo-yo say what their constraints say.
#include "core/goals/spin.h"
#include "core/goals/yo_yo.h"

#include "goals/goal_checks.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace massprops::testing {
namespace {

double bestLevel(const Goal& goal, const Moments& body) {
  double best = -std::numeric_limits<double>::infinity();
  for (const LinearConditions& conditions : goal.conditions()) {
    best = std::max(best, levelReached(conditions, body));
  }
  return best;
}

TEST(SpinningConditions, HoldWhereTheConstraintsDo) {
  // Boxes on the axis: flat, tall, and with the middle moment about it.
  for (const auto& [size, holds] :
       {std::pair(Vec3(2.0, 1.8, 0.3), true), std::pair(Vec3(0.5, 0.6, 3.0), true),
        std::pair(Vec3(3.0, 0.2, 1.0), false)}) {
    const Moments body =
        momentsOf(transformed(box(size, 2), Mat3::Identity(), Vec3(0.3, -0.2, size.z() / 2)));
    const auto spin = makeSpinGoal(body, {}, Vec2(0.3, -0.2));
    EXPECT_EQ(bestLevel(*spin, body) >= -1e-12, largestViolation(*spin, body) < 1e-12);
    const auto yoYo = makeYoYoGoal(body, {}, Vec3(0.3, -0.2, size.z() / 2));
    EXPECT_EQ(bestLevel(*yoYo, body) >= -1e-12, holds);
    EXPECT_EQ(largestViolation(*yoYo, body) < 1e-12, holds);
  }
}

TEST(SpinningConditions, FailByAsMuchAsTheCentreIsOff) {
  const Moments body = momentsOf(transformed(box({2, 2, 0.5}, 2), Mat3::Identity(), {0, 0, 0.25}));
  const auto spin = makeSpinGoal(body, {}, Vec2(0.03, 0.0));
  EXPECT_NEAR(bestLevel(*spin, body), -0.03, 1e-12);
}

} // namespace
} // namespace massprops::testing
