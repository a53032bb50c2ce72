// Which poses bodies float in, by symmetry, in closed form, and by chance.
#include "core/physics/floating_equilibria.h"

#include "core/physics/moments.h"
#include "samples.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace massprops::testing {
namespace {

const double kDegree = std::acos(-1.0) / 180;
constexpr double kBarrier = 1e-5;

FloatingBody bodyOf(const TriangleMesh& mesh, double density, const Vec3& centre = Vec3::Zero()) {
  return floatingBody(mesh.vertices, mesh.faces, centre,
                      density * moments(mesh.vertices, mesh.faces)[0]);
}

FloatingEquilibria equilibriaOf(const FloatingBody& body) {
  const FloatingBody copy = withSurface(body, coarseSurface(body.vertices, body.faces));
  return floatingEquilibria(body, copy, kBarrier);
}

std::vector<double> tiltsOf(const FloatingEquilibria& all) {
  std::vector<double> tilts;
  for (const FloatingRest& rest : all.rests) tilts.push_back(rest.leastTilt / kDegree);
  return tilts;
}

void expectTilts(const FloatingEquilibria& all, const std::vector<double>& wanted) {
  const std::vector<double> tilts = tiltsOf(all);
  ASSERT_EQ(tilts.size(), wanted.size());
  for (std::size_t i = 0; i < tilts.size(); ++i) EXPECT_NEAR(tilts[i], wanted[i], 1e-4);
}

TEST(FloatingEquilibria, OfALightBoxAreOnItsEndsAndWithLessEnergyOnItsSides) {
  for (const int n : {1, 12}) { // as it is, and by a coarse copy
    const FloatingEquilibria all = equilibriaOf(bodyOf(box({1, 1, 1.3}, n), 0.1));
    expectTilts(all, {0, 90, 90, 90, 90, 180});
    EXPECT_EQ(all.upright, 0U);
    const double upright = all.rests[0].pose.energy; // (c − B)·up = (1 − s)/2 of the height
    EXPECT_NEAR(upright, 0.45 * 1.3, 1e-12);
    EXPECT_NEAR(all.rests[5].pose.energy, 0.45 * 1.3, 1e-12);
    for (std::size_t i = 1; i < 5; ++i) EXPECT_NEAR(all.rests[i].pose.energy, 0.45, 1e-12);
    EXPECT_NEAR(1 - 0.45 / upright, 0.231, 5e-4);
  }
}

TEST(FloatingEquilibria, OfASquareLogHalfUnderWaterAreItsEdges) {
  const FloatingEquilibria all = equilibriaOf(bodyOf(box({4, 1, 1}, 4), 0.5));
  expectTilts(all, {45, 45, 135, 135});
}

TEST(FloatingEquilibria, TurnWithTheBody) {
  const TriangleMesh log = box({4, 1, 1}, 4);
  const FloatingEquilibria all = equilibriaOf(bodyOf(transformed(log, someRotation()), 0.5));
  ASSERT_EQ(all.rests.size(), 4U);
  for (const FloatingRest& rest : all.rests) {
    const Vec3 up = someRotation().transpose() * rest.pose.up;
    EXPECT_LT((up.cwiseAbs() - Vec3(0, std::sqrt(0.5), std::sqrt(0.5))).norm(), 1e-5);
  }
}

TEST(FloatingEquilibria, OfACylinderOnItsSideAreOneFamily) {
  // It rolls without an answer; a coarse one has facets, whose edges rise less than the barrier.
  for (const int segments : {24, 120}) {
    const TriangleMesh upright = revolved({{0, 1}, {0.5, 1}, {0.5, -1}, {0, -1}}, segments);
    const FloatingEquilibria fallen = equilibriaOf(bodyOf(upright, 0.5));
    ASSERT_EQ(fallen.rests.size(), 1U);
    EXPECT_NEAR(fallen.rests[0].leastTilt, 90 * kDegree, 1e-6);
    EXPECT_NEAR(fallen.rests[0].greatestTilt, 90 * kDegree, 1e-6);

    const Mat3 lay = rotation(Vec3::UnitY(), 90 * kDegree) * rotation(Vec3::UnitZ(), 0.3);
    const FloatingEquilibria rolls = equilibriaOf(bodyOf(transformed(upright, lay), 0.5));
    ASSERT_EQ(rolls.rests.size(), 1U);
    EXPECT_LT(rolls.rests[0].leastTilt, 10 * kDegree);
    EXPECT_GT(rolls.rests[0].greatestTilt, 170 * kDegree);
  }
}

TEST(FloatingEquilibria, OfADiscAreItsTwoSides) {
  const TriangleMesh disc = revolved({{0, 0.15}, {1, 0.15}, {1, -0.15}, {0, -0.15}}, 64);
  expectTilts(equilibriaOf(bodyOf(disc, 0.5)), {0, 180});
}

TEST(FloatingEquilibria, OfABallAreAllOrientationsAtOnceOrOneWhenItIsLoaded) {
  const TriangleMesh ball = sphere(12);
  const FloatingEquilibria all = equilibriaOf(bodyOf(ball, 0.4));
  ASSERT_EQ(all.rests.size(), 1U);
  EXPECT_GT(all.rests[0].greatestTilt - all.rests[0].leastTilt, 150 * kDegree);
  const Vec3 load(0.03, 0, -0.04);
  const FloatingEquilibria loaded = equilibriaOf(bodyOf(ball, 0.4, load));
  ASSERT_EQ(loaded.rests.size(), 1U);
  // Its facets move the centre of buoyancy by the square of its edges, 0.1² = 0.01, of which the
  // symmetry leaves next to nothing.
  EXPECT_LT((loaded.rests[0].pose.up + load.normalized()).norm(), 0.01);
}

TEST(FloatingEquilibria, UnderWaterAreOneAndOfASinkingBodyNone) {
  const TriangleMesh ball = sphere(8);
  const FloatingEquilibria neutral = equilibriaOf(bodyOf(ball, 1.0, {0.03, 0, -0.04}));
  ASSERT_EQ(neutral.rests.size(), 1U);
  EXPECT_TRUE(neutral.rests[0].pose.submerged);
  EXPECT_NEAR(neutral.rests[0].leastTilt, std::atan2(3, 4), 1e-9);
  EXPECT_TRUE(equilibriaOf(bodyOf(ball, 1.01, {0, 0, -0.1})).rests.empty());
}

TEST(FloatingEquilibria, AreWhatABodyDroppedAnyhowComesTo) {
  for (const double density : {0.15, 0.5, 0.85}) {
    const FloatingBody body = bodyOf(blob(6), density, {0.05, -0.02, 0.1});
    const FloatingEquilibria all = equilibriaOf(body);
    std::vector<int> hits(all.rests.size(), 0);
    Random random(7);
    for (int i = 0; i < 200; ++i) {
      const FloatingPose pose = floatingPose(body, random.vector().normalized());
      int found = 0;
      for (std::size_t k = 0; k < all.rests.size(); ++k) {
        if ((all.rests[k].pose.up - pose.up).norm() > 1e-4) continue;
        ++found;
        ++hits[k];
      }
      EXPECT_EQ(found, 1) << density << ": " << pose.up.transpose();
    }
    for (const int h : hits) EXPECT_GT(h, 0) << density;
  }
}

TEST(FloatingEquilibria, OfSamplesAreWhatTheyComeToWhenDroppedAnyhow) {
  // Their plane of symmetry makes the upright pose unstable: to which side it falls is chance, and
  // another one for the coarse copy.
  struct Case {
    const char* name;
    double density;
    std::size_t rests;
  };
  for (const auto& [name, density, rests] :
       {Case{"bath_duck", 0.85, 2}, Case{"toy_dinosaur", 0.85, 3}, Case{"hanging_fish", 0.85, 2}}) {
    TriangleMesh mesh = sampleMesh(name);
    const auto& x = mesh.vertices;
    mesh = scaled(mesh, 1 / (x.colwise().maxCoeff() - x.colwise().minCoeff()).norm());
    const Moments m = moments(mesh.vertices, mesh.faces);
    const FloatingBody body = bodyOf(mesh, density, m.segment<3>(1) / m[0]);
    const FloatingEquilibria all = equilibriaOf(body);
    EXPECT_EQ(all.rests.size(), rests) << name;
    Random random(3);
    for (int i = 0; i < 12; ++i) {
      const Vec3 up = floatingPose(body, random.vector().normalized()).up;
      const auto isThere = [&](const FloatingRest& r) { return (r.pose.up - up).norm() < 0.01; };
      EXPECT_EQ(std::count_if(all.rests.begin(), all.rests.end(), isThere), 1) << name;
    }
  }
}

TEST(FloatingEquilibria, AreWetWhereAnOpeningIsUnderWater) {
  FloatingBody body = bodyOf(box({1, 1, 1.3}), 0.1);
  body.rims = Points(1, 3);
  body.rims << 0.5, 0, 0.65; // in the middle of an edge of the top
  int wet = 0;
  for (const FloatingRest& rest : equilibriaOf(body).rests) {
    EXPECT_EQ(rest.isDry, rest.pose.up.x() > -0.5 && rest.pose.up.z() > -0.5);
    wet += rest.isDry ? 0 : 1;
  }
  EXPECT_EQ(wet, 2); // upside down, and on the side with the opening
}

} // namespace
} // namespace massprops::testing
