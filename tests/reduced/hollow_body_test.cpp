// What the best possible body is, once a better one was delivered.
#include "core/reduced/hollow_body.h"

#include "core/goals/hang.h"
#include "shapes.h"

#include <gtest/gtest.h>

namespace massprops::testing {
namespace {

struct Scene {
  TriangleMesh outer = sphere(12);
  TriangleTree tree{outer.vertices, outer.faces};
  std::unique_ptr<Goal> goal = makeHangGoal(Vec3::Zero(), {});
  CavityTask task{tree, *goal, {}};
  OptimalBound bound;
  Body delivered;

  Scene() {
    bound.massMoments[0] = 1.0;
    bound.measure = 0.5;
    bound.objective = -0.5;
    delivered.mass[0] = 2.0;
    delivered.measure = 0.6;
    delivered.momentObjective = -0.6;
  }
};

TEST(RaiseTo, TakesTheDeliveredBodyWhereItIsBetter) {
  Scene scene;
  scene.delivered.objective = 7.0; // with the smoothness of offsets, which the bound does not have
  raiseTo(scene.task, scene.delivered, scene.bound);
  EXPECT_EQ(scene.bound.massMoments[0], 2.0);
  EXPECT_EQ(*scene.bound.measure, 0.6);
  EXPECT_EQ(scene.bound.objective, -0.6);
  EXPECT_EQ(gapToBound(scene.bound, Body{}, scene.delivered), 0.0);
}

TEST(RaiseTo, LeavesABetterBound) {
  Scene scene;
  scene.delivered.measure = 0.4;
  raiseTo(scene.task, scene.delivered, scene.bound);
  EXPECT_EQ(scene.bound.massMoments[0], 1.0);
  EXPECT_EQ(*scene.bound.measure, 0.5);
  // Nor does one that violates constraints more take its place.
  scene.delivered.measure = 0.9;
  scene.delivered.violation = 1e-3;
  raiseTo(scene.task, scene.delivered, scene.bound);
  EXPECT_EQ(scene.bound.massMoments[0], 1.0);
}

} // namespace
} // namespace massprops::testing
