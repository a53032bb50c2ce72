// What is said about floating bodies whose poses are known.
#include "core/goals/float.h"

#include "goals/goal_checks.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

namespace massprops::testing {
namespace {

const Weights kPublished;

std::string text(const Report& report, const std::string& key) {
  return std::get<std::string>(report.at(key));
}

int count(const Report& report, const std::string& key) {
  return std::get<int>(report.at(key));
}

/// On the ground.
TriangleMesh lightBox(int n = 1) {
  return transformed(box({1, 1, 1.3}, n), Mat3::Identity(), {0, 0, 0.65});
}

TEST(FloatVerdict, SaysIntoWhatElseALightBoxCanSettle) {
  const TriangleMesh b = lightBox();
  const auto verdict = makeFloatVerdict(b.vertices, b.faces, 0.1, 1.0, 10.0);
  const Moments m = 0.1 * momentsOf(b);
  EXPECT_TRUE(verdict->isReached(m));
  EXPECT_EQ(verdict->remark(m), "Heeled by less than 23.1\u00b0 it comes back; it also floats "
                                "90\u00b0 over (4 poses) and 180\u00b0 over.");
  const Report report = described(*verdict, m);
  EXPECT_EQ(count(report, "floating_poses_after"), 6);
  EXPECT_EQ(text(report, "floating_tilts_after"), "0, 90, 90, 90, 90, 180");
  EXPECT_EQ(text(report, "floating_energies_after"), "5.85, 4.5, 4.5, 4.5, 4.5, 5.85");
  EXPECT_NEAR(number(report, "vanishing_stability_after"), 23.13, 0.01);
  EXPECT_NEAR(number(report, "safe_heel_after"), 23.13, 0.1);
  EXPECT_NEAR(number(report, "dynamical_stability_after"), 0.0355651, 1e-6);
  // Over a corner, every 5°, and 0 at the end.
  const std::string levers = text(report, "righting_levers_after");
  EXPECT_EQ(levers.rfind("5: ", 0), 0U) << levers;
  EXPECT_NE(levers.find(", 20: "), std::string::npos) << levers;
  EXPECT_NE(levers.find(", 23.1: "), std::string::npos) << levers;
  const double most = number(report, "righting_lever_max_after");
  EXPECT_NEAR(number(report, "righting_lever_max_heel_after"), 15.0, 5.1);
  // As long as the wedge has no effect yet the lever is wall-sided, sin θ(GM + ½BM tan²θ).
  EXPECT_GT(most, 10 * std::sin(15 * std::acos(-1.0) / 180) * 0.056);
}

TEST(FloatVerdict, SaysNothingElseWhereThereIsOnePose) {
  const TriangleMesh ball = transformed(sphere(8), Mat3::Identity(), {0, 0, 1});
  const auto verdict = makeFloatVerdict(ball.vertices, ball.faces, 0.5, 1.0, 1.0);
  const Moments m = bodyAt({0, 0, 0.8}, 0.5 * momentsOf(ball)[0]);
  EXPECT_TRUE(verdict->isReached(m));
  EXPECT_EQ(verdict->remark(m),
            "It floats in no other pose, so that it comes back from every heel.");
  const Report report = described(*verdict, m);
  EXPECT_EQ(count(report, "floating_poses_after"), 1);
  EXPECT_NEAR(number(report, "vanishing_stability_after"), 180, 1e-9);
  EXPECT_NEAR(number(report, "righting_lever_max_after"), 0.2, 0.01);
  EXPECT_NEAR(number(report, "righting_lever_max_heel_after"), 90, 5.1);
}

TEST(FloatVerdict, IsNotUprightWhatTurnsWithoutAnAnswer) {
  const TriangleMesh upright = revolved({{0, 1}, {0.5, 1}, {0.5, -1}, {0, -1}}, 96);
  const TriangleMesh lying =
      transformed(upright, rotation(Vec3::UnitY(), std::acos(0.0)), {0, 0, 0.5});
  const auto verdict = makeFloatVerdict(lying.vertices, lying.faces, 0.5, 1.0, 1.0);
  const Moments m = 0.5 * momentsOf(lying);
  EXPECT_FALSE(verdict->isReached(m));
  EXPECT_EQ(verdict->whatIsMissed(m), "it turns without an answer, 0 to 180\u00b0 over");
  const Report report = described(*verdict, m);
  EXPECT_EQ(text(report, "floating_tilts_after"), "0 to 180");
  EXPECT_EQ(number(report, "vanishing_stability_after"), 0.0);
  // Loaded below its axis it is.
  EXPECT_TRUE(verdict->isReached(translated(m, {0, 0, -0.05})));
}

TEST(FloatVerdict, OfWhatSinksHasNoPoses) {
  const TriangleMesh b = lightBox();
  const auto verdict = makeFloatVerdict(b.vertices, b.faces, 0.5, 1.0, 10.0);
  const Report report = described(*verdict, 1.2 * momentsOf(b));
  EXPECT_EQ(count(report, "floating_poses_after"), 0);
  EXPECT_THROW(report.at("vanishing_stability_after"), std::out_of_range);
}

TEST(FloatVerdict, SaysHowMuchTheWatersDensityMayDifferUnderWater) {
  const TriangleMesh ball = transformed(sphere(8), Mat3::Identity(), {0, 0, 1});
  const double V = momentsOf(ball)[0];
  const Vec3 low(0, 0, 0.9);
  const auto inWaterOf = [&](double density) {
    return makeFloatVerdict(ball.vertices, ball.faces, 1.0, density, 1.0);
  };
  for (const double weight : {1.0, 0.99995, 1.00008}) {
    const Moments m = bodyAt(low, weight * V);
    ASSERT_TRUE(inWaterOf(1.0)->isReached(m));
    const double tolerance = number(described(*inWaterOf(1.0), m), "water_density_tolerance_after");
    EXPECT_NEAR(tolerance, 1e-4 - std::abs(weight - 1), 2e-8);
    // Within it the body stays neutral both ways, beyond it one way not.
    EXPECT_TRUE(inWaterOf(1 + 0.999 * tolerance)->isReached(m));
    EXPECT_TRUE(inWaterOf(1 - 0.999 * tolerance)->isReached(m));
    EXPECT_FALSE(inWaterOf(1 + 1.001 * tolerance)->isReached(m) &&
                 inWaterOf(1 - 1.001 * tolerance)->isReached(m));
  }
  const Report sinks = described(*inWaterOf(1.0), bodyAt(low, 1.001 * V));
  EXPECT_EQ(number(sinks, "water_density_tolerance_after"), 0.0);
  const std::string remark = inWaterOf(1.0)->remark(bodyAt(low, V));
  EXPECT_NE(remark.find("within 0.00999"), std::string::npos) << remark;
}

TEST(FloatVerdict, SaysWhereAnOpeningGetsUnderWater) {
  const TriangleMesh b = lightBox();
  Points rims(1, 3);
  rims << 0.5, 0.0, 0.35; // in the middle of a side, 0.22 above the water
  const auto verdict = makeFloatVerdict(b.vertices, b.faces, 0.1, 1.0, 10.0, rims);
  const Moments m = 0.1 * momentsOf(b);
  EXPECT_TRUE(verdict->isReached(m));
  const Report report = described(*verdict, m);
  // One of the six poses has it under water: lying on that side.
  EXPECT_EQ(text(report, "floating_tilts_after"), "0, 90, 90, 90, 180");
  EXPECT_GT(number(report, "flooding_heel_after"), 10);
}

TEST(FloatGoal, AsksForNoMoreThanAPositiveMetacentricHeight) {
  const TriangleMesh b = lightBox();
  const auto goal = makeFloatGoal(b.vertices, b.faces, 0.1, 1.0, kPublished);
  const double metacentre = 0.065 + 1.0 / 12 / 0.13;
  for (const double GM : {0.01, 1e-6, -1e-6, -0.01}) {
    const Moments m = bodyAt({0, 0, metacentre - GM}, 0.13);
    EXPECT_NEAR(goal->inequalities(m).values[0], -GM, 1e-12);
  }
}

} // namespace
} // namespace massprops::testing
