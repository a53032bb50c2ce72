// Metacentric heights and floating poses of bodies whose hydrostatics are known.
#include "core/physics/floating_pose.h"

#include "core/physics/hydrostatics.h"
#include "core/physics/moments.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace massprops::testing {
namespace {

const double kPi = std::acos(-1.0);

FloatingPose poseOf(const TriangleMesh& mesh, const Vec3& centre, double displaced) {
  return floatingPose(floatingBody(mesh.vertices, mesh.faces, centre, displaced));
}

double heelOf(const FloatingPose& pose) {
  return std::acos(std::min(1.0, pose.up.z())) * 180 / kPi;
}

TEST(FloatingPose, OfAFlatBoxIsUprightWithTheClosedForm) {
  // Density s: draught sH, BM = B²/(12 sH), BG = H(1 − s)/2.
  const Vec3 size(3, 2, 1);
  for (const double s : {0.2, 0.5, 0.8}) {
    const FloatingPose pose = poseOf(box(size, 3), Vec3::Zero(), s * 6);
    EXPECT_TRUE(pose.floats);
    EXPECT_FALSE(pose.submerged);
    EXPECT_NEAR(heelOf(pose), 0, 1e-6);
    EXPECT_NEAR(pose.draught, s, 1e-12);
    EXPECT_NEAR(pose.leastMetacentricHeight, 4 / (12 * s) - (1 - s) / 2, 1e-10);
    EXPECT_NEAR(pose.greatestMetacentricHeight, 9 / (12 * s) - (1 - s) / 2, 1e-10);
  }
}

TEST(FloatingPose, OfASquareLogHalfUnderWaterIsOnItsEdge) {
  // The classical example: of relative density ½ it is unstable flat and lies at 45°.
  const FloatingPose pose = poseOf(box({4, 1, 1}, 6), Vec3::Zero(), 2);
  EXPECT_NEAR(heelOf(pose), 45, 1e-4);
  EXPECT_NEAR(pose.draught, std::sqrt(0.5), 1e-6);
  EXPECT_GT(pose.leastMetacentricHeight, 0);
}

TEST(FloatingPose, IsAnEquilibriumThatASmallHeelDoesNotLeave) {
  for (const double share : {0.15, 0.5, 0.85}) {
    const TriangleMesh body = blob(6);
    const double V = share * moments(body.vertices, body.faces)[0];
    const Vec3 c(0.05, -0.02, 0.1);
    const FloatingPose pose = poseOf(body, c, V);
    const auto arm = [&](const Vec3& up) {
      const double level = levelFor(body.vertices, body.faces, up, V);
      return Vec3(c - displacement(body.vertices, body.faces, up, level).centre);
    };
    EXPECT_LT(arm(pose.up).cross(pose.up).norm(), 1e-8);
    EXPECT_GT(pose.leastMetacentricHeight, 0);
    Random random(5);
    for (int i = 0; i < 20; ++i) {
      const Vec3 near = (pose.up + 0.01 * random.vector()).normalized();
      EXPECT_GE(arm(near).dot(near), arm(pose.up).dot(pose.up) - 1e-12);
    }
  }
}

TEST(FloatingPose, UnderWaterHangsTheCentreOfMassBelowTheCentreOfBuoyancy) {
  const TriangleMesh ball = sphere(8);
  const double V = moments(ball.vertices, ball.faces)[0];
  const FloatingPose neutral = poseOf(ball, {0.03, 0, -0.04}, V);
  EXPECT_TRUE(neutral.floats);
  EXPECT_TRUE(neutral.submerged);
  EXPECT_NEAR(heelOf(neutral), std::atan2(3, 4) * 180 / kPi, 1e-6);
  EXPECT_NEAR(neutral.leastMetacentricHeight, 0.05, 1e-9);
  EXPECT_FALSE(poseOf(ball, {0, 0, -0.1}, 1.01 * V).floats);
  EXPECT_FALSE(poseOf(ball, {0, 0, -0.1}, 0.99 * V).submerged);
}

} // namespace
} // namespace massprops::testing
