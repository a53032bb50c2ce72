// Resting poses of dice, cylinders and tumblers.
#include "core/physics/stable_poses.h"

#include "core/base/angles.h"
#include "core/model/solid.h"
#include "core/physics/moments.h"
#include "samples.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace massprops::testing {
namespace {

constexpr double kBarrier = 1e-3;

std::size_t countOf(const TriangleMesh& mesh, const Vec3& centre) {
  return stablePoses(rollingHull(mesh.vertices), centre, kBarrier).rests.size();
}

TEST(StablePoses, OfAFairDieAreItsSixSides) {
  EXPECT_EQ(countOf(box({1, 1, 1}, 3), Vec3::Zero()), 6U);
  EXPECT_EQ(countOf(transformed(box({1, 1, 1}, 3), someRotation()), Vec3::Zero()), 6U);
}

TEST(StablePoses, OfALoadedCubeFollowFromTheFootOfItsCentre) {
  // A side is stable where the foot of the centre of mass lies within it: always, inside a cube.
  EXPECT_EQ(countOf(box({1, 1, 1}, 2), {0.3, 0.2, -0.4}), 6U);
  // On a sheared box the feet leave some sides: the centre's foot on the sides x = ±½ + z.
  const TriangleMesh leaning = transformed(box({1, 1, 1}, 2), shear(1.0));
  // Top and bottom: foot at x = 0 against [0, 1] and [−1, 0], on the border; shift it inside for
  // one.
  EXPECT_EQ(countOf(leaning, {0.1, 0, 0}), 5U);
}

TEST(StablePoses, OfATetrahedronAreFourEvenWhenItIsLoaded) {
  const TriangleMesh regular = tetrahedron({1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1});
  EXPECT_EQ(countOf(regular, Vec3::Zero()), 4U);
  // Near a corner the feet on the three sides there stay inside, and on the opposite one, too.
  EXPECT_EQ(countOf(regular, {0.5, 0.5, 0.5}), 4U);
}

TEST(StablePoses, OfACylinderAreItsEndsAndItsSide) {
  // The side is one pose of neutral equilibrium, its facets lower than the barrier.
  const int n = 200; // sagitta r(1 − cos(π/n)) = 1e-4
  const TriangleMesh cylinder = revolved({{0, 1}, {1, 1}, {1, -1}, {0, -1}}, n);
  EXPECT_EQ(countOf(cylinder, Vec3::Zero()), 3U);
  // Loaded off its axis the cylinder still has these three; the side's facets count with a barrier
  // below their height.
  EXPECT_EQ(countOf(cylinder, {0.2, 0, 0}), 3U);
  EXPECT_GT(stablePoses(rollingHull(cylinder.vertices), Vec3::Zero(), 1e-6).rests.size(), 100U);
}

TEST(StablePoses, OfATumblerIsOneWhenTheCentreIsBelowThatOfItsRoundFoot) {
  const TriangleMesh tumbler = capsule(1.0, 1.0, 160); // lower centre at z = −½
  EXPECT_EQ(countOf(tumbler, {0, 0, -0.8}), 1U);
  const StablePoses onItsSide = stablePoses(rollingHull(tumbler.vertices), Vec3::Zero(), kBarrier);
  EXPECT_NEAR(onItsSide.down.z(), 0.0, 0.1);
}

TEST(StablePoses, LeanByTheAngleThatBringsTheCentreBelowThatOfTheFoot) {
  // A ball of radius 1 with its mass at c rests with c straight below the middle.
  const TriangleMesh ball = sphere(40); // edges 0.03, so normals within 0.02
  const StablePoses poses = stablePoses(rollingHull(ball.vertices), {0.1, 0, -0.3}, kBarrier);
  EXPECT_EQ(poses.rests.size(), 1U);
  EXPECT_LT((poses.down - Vec3(0.1, 0, -0.3).normalized()).norm(), 0.05);
}

/// Wells at `centre`, of poses more than 2° off upright.
std::vector<HalfSpaces> wellsAt(const RollingHull& hull, const Vec3& centre) {
  return restingWells(hull, centre, kBarrier, 0.035);
}

TEST(StablePoses, RollDownhillFromUprightAndNotToTheLowestPool) {
  // A cube on a foot that is cut off at a corner, its centre of mass beyond the foot's border: it
  // falls onto the side that lies there, over however many triangles of the foot.
  const TriangleMesh body = sampleMesh("box_on_corner");
  const Moments solid = moments(body.vertices, body.faces);
  const Vec3 centre = solid.segment<3>(1) / solid[0];
  const RollingHull hull = rollingHull(body.vertices);
  const StablePoses poses = stablePoses(hull, centre, 5e-4 * makeSolid(body).diagonal());
  EXPECT_EQ(poses.rests.size(), 6U);
  const double tilt = std::acos(-poses.down.z()) * kDegrees;
  EXPECT_NEAR(tilt, 49.2, 0.5); // as a simulation falls
}

TEST(RestingWells, OfACubesSideAreAsWideAsTheSide) {
  // The pass over an edge at the distance d from the foot is sqrt(1/4 + d²) high: d > 0.032.
  const RollingHull hull = rollingHull(box({1, 1, 1}, 1).vertices);
  const std::vector<HalfSpaces> wells = wellsAt(hull, Vec3::Zero());
  // All but those of the side that it lies on upright and of the one that ends it, for all are
  // alike.
  EXPECT_GE(std::count_if(wells.begin(), wells.end(),
                          [](const HalfSpaces& well) {
                            return well.contain(Vec3(0, 0, 0)) &&
                                   well.contain(Vec3(0.2, 0.1, -0.2));
                          }),
            4);
}

TEST(RestingWells, OfARodAreTheRingOfItsSide) {
  // Lying it rolls about its own axis freely, yet not upright, where it may stand.
  const RollingHull hull =
      rollingHull(revolved({{0, 1}, {0.2, 1}, {0.2, -1}, {0, -1}}, 60).vertices);
  const auto wells = wellsAt(hull, Vec3::Zero());
  ASSERT_EQ(wells.size(), 3U); // its side, its head, and lower than upright
  for (const HalfSpaces& well : wells) EXPECT_TRUE(well.contain(Vec3(0, 0, 0)));
  // On its side the foot must lie between the ends.
  EXPECT_TRUE(std::any_of(wells.begin(), wells.end(),
                          [](const HalfSpaces& well) { return well.contain(Vec3(0, 0, -0.7)); }));
}

TEST(RestingWells, OfABodyThatOnlyLiesDownAreWhereUprightIsHigher) {
  const RollingHull hull = rollingHull(capsule(0.3, 0.3, 80).vertices); // lower centre at −0.15
  const auto wells = wellsAt(hull, Vec3::Zero());
  ASSERT_EQ(wells.size(), 1U);
  EXPECT_TRUE(wells[0].contain(Vec3(0, 0, 0)));
  EXPECT_TRUE(wells[0].contain(Vec3(0, 0, -0.14))); // lying 0.3 high, upright 0.3 + 0.01
  EXPECT_FALSE(wells[0].contain(Vec3(0, 0, -0.16)));
}

TEST(RestingWells, HoldOnlyCentresThatDoNotComeBackUpright) {
  Random random(29);
  int held = 0;
  for (int trial = 0; trial < 6; ++trial) {
    const RollingHull hull = rollingHull(blob(8 + trial).vertices);
    const Vec3 centre = 0.2 * random.vector();
    for (const HalfSpaces& well : wellsAt(hull, centre)) {
      for (int i = 0; i < 100; ++i) {
        const Vec3 c = centre + 0.2 * random.vector();
        if (!well.contain(c)) continue;
        ++held;
        const StablePoses poses = stablePoses(hull, c, kBarrier);
        EXPECT_FALSE(poses.rests.size() == 1 && -poses.down.z() > std::cos(0.035));
      }
    }
  }
  EXPECT_GT(held, 100);
}

TEST(StablePoses, SeeTheHullOnly) {
  const TriangleMesh frame = torus(1, 0.3, 96, 48);
  // Flat on either side; the hull has no hole to fall into, and the rim is no place to stand.
  EXPECT_EQ(countOf(frame, Vec3::Zero()), 2U);
}

TEST(StablePoses, RefuseAFlatModel) {
  Points flat(4, 3);
  flat << 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0;
  EXPECT_THROW(rollingHull(flat), InvalidInput);
}

} // namespace
} // namespace massprops::testing
