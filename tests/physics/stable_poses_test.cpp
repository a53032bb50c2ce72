// Resting poses of dice, cylinders and tumblers.
#include "core/physics/stable_poses.h"

#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace massprops::testing {
namespace {

constexpr double kBarrier = 1e-3;

int countOf(const TriangleMesh& mesh, const Vec3& centre) {
  return stablePoses(rollingHull(mesh.vertices), centre, kBarrier).count;
}

TEST(StablePoses, OfAFairDieAreItsSixSides) {
  EXPECT_EQ(countOf(box({1, 1, 1}, 3), Vec3::Zero()), 6);
  EXPECT_EQ(countOf(transformed(box({1, 1, 1}, 3), someRotation()), Vec3::Zero()), 6);
}

TEST(StablePoses, OfALoadedCubeFollowFromTheFootOfItsCentre) {
  // A side is stable where the foot of the centre of mass lies within it: always, inside a cube.
  EXPECT_EQ(countOf(box({1, 1, 1}, 2), {0.3, 0.2, -0.4}), 6);
  // On a sheared box the feet leave some sides: the centre's foot on the sides x = ±½ + z.
  const TriangleMesh leaning = transformed(box({1, 1, 1}, 2), shear(1.0));
  // Top and bottom: foot at x = 0 against [0, 1] and [−1, 0], on the border; shift it inside for
  // one.
  EXPECT_EQ(countOf(leaning, {0.1, 0, 0}), 5);
}

TEST(StablePoses, OfATetrahedronAreFourEvenWhenItIsLoaded) {
  const TriangleMesh regular = tetrahedron({1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1});
  EXPECT_EQ(countOf(regular, Vec3::Zero()), 4);
  // Near a corner the feet on the three sides there stay inside, and on the opposite one, too.
  EXPECT_EQ(countOf(regular, {0.5, 0.5, 0.5}), 4);
}

TEST(StablePoses, OfACylinderAreItsEndsAndItsSide) {
  // The side is one pose of neutral equilibrium, its facets lower than the barrier.
  const int n = 200; // sagitta r(1 − cos(π/n)) = 1e-4
  const TriangleMesh cylinder = revolved({{0, 1}, {1, 1}, {1, -1}, {0, -1}}, n);
  EXPECT_EQ(countOf(cylinder, Vec3::Zero()), 3);
  // Loaded off its axis the cylinder still has these three; the side's facets count with a barrier
  // below their height.
  EXPECT_EQ(countOf(cylinder, {0.2, 0, 0}), 3);
  EXPECT_GT(stablePoses(rollingHull(cylinder.vertices), Vec3::Zero(), 1e-6).count, 100);
}

TEST(StablePoses, OfATumblerIsOneWhenTheCentreIsBelowThatOfItsRoundFoot) {
  const TriangleMesh tumbler = capsule(1.0, 1.0, 160); // lower centre at z = −½
  EXPECT_EQ(countOf(tumbler, {0, 0, -0.8}), 1);
  const StablePoses onItsSide = stablePoses(rollingHull(tumbler.vertices), Vec3::Zero(), kBarrier);
  EXPECT_NEAR(onItsSide.down.z(), 0.0, 0.1);
}

TEST(StablePoses, LeanByTheAngleThatBringsTheCentreBelowThatOfTheFoot) {
  // A ball of radius 1 with its mass at c rests with c straight below the middle.
  const TriangleMesh ball = sphere(40); // edges 0.03, so normals within 0.02
  const StablePoses poses = stablePoses(rollingHull(ball.vertices), {0.1, 0, -0.3}, kBarrier);
  EXPECT_EQ(poses.count, 1);
  EXPECT_LT((poses.down - Vec3(0.1, 0, -0.3).normalized()).norm(), 0.05);
}

TEST(StablePoses, SeeTheHullOnly) {
  const TriangleMesh frame = torus(1, 0.3, 96, 48);
  // Flat on either side; the hull has no hole to fall into, and the rim is no place to stand.
  EXPECT_EQ(countOf(frame, Vec3::Zero()), 2);
}

TEST(StablePoses, RefuseAFlatModel) {
  Points flat(4, 3);
  flat << 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0;
  EXPECT_THROW(rollingHull(flat), InvalidInput);
}

} // namespace
} // namespace massprops::testing
