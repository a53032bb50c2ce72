// How boxes, logs and loaded balls answer when they are heeled, in closed form.
#include "core/physics/righting_lever.h"

#include "core/physics/floating_equilibria.h"
#include "core/physics/moments.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace massprops::testing {
namespace {

const double kDegree = std::acos(-1.0) / 180;

/// A body, its coarse copy, and the pose it comes to when it is set into the water upright.
struct Afloat {
  FloatingBody body, copy;
  FloatingPose pose;
  Stability stability;
};

Afloat afloat(const TriangleMesh& mesh, double density, const Vec3& centre = Vec3::Zero(),
              const Points& rims = Points(0, 3)) {
  const FloatingBody body = floatingBody(mesh.vertices, mesh.faces, centre,
                                         density * moments(mesh.vertices, mesh.faces)[0], rims);
  const FloatingBody copy = withSurface(body, coarseSurface(body.vertices, body.faces));
  const FloatingEquilibria all = floatingEquilibria(body, copy, 1e-5);
  return {body, copy, all.rests[all.upright].pose, stability(body, copy, all)};
}

/// GZ of the box 1 × 1 × 1.3 of density 0.1 over a side: the bottom is wet all over up to
/// tan θ = 0.26, then a wedge with the legs a and a·tan θ along bottom and side, a² tan θ = 0.26.
double leverOverSide(double heel) {
  const double t = std::tan(heel);
  if (t <= 0.26) {
    const double BM = 1.0 / 12 / 0.13;
    return std::sin(heel) * (BM - 0.585 + BM / 2 * t * t);
  }
  const double a = std::sqrt(0.26 / t);
  return (0.5 - a / 3) * std::cos(heel) - (0.65 - a * t / 3) * std::sin(heel);
}

/// Energy of that box over a corner, its lowest, at the origin: heights are s(x + y) + rz. Below
/// the level d lies a tetrahedron less two that stick out of the sides x = 1, y = 1, each with the
/// mean depth of a quarter of its own.
double energyOverCorner(double heel) {
  const double s = std::sin(heel) / std::sqrt(2.0);
  const double r = std::cos(heel);
  const auto volume = [&](double d) {
    return (std::pow(d, 3) - 2 * std::pow(d - s, 3)) / (6 * s * s * r);
  };
  double low = s; // all of the bottom but the opposite corner's part is wet below 2s
  double high = 2 * s;
  for (int i = 0; i < 60; ++i) {
    const double d = 0.5 * (low + high);
    (volume(d) < 0.13 ? low : high) = d;
  }
  const double depths = (std::pow(low, 4) - 2 * std::pow(low - s, 4)) / (24 * s * s * r);
  return s + 0.65 * r - low + depths / 0.13;
}

TEST(Stability, OfALightBoxEndsOverItsCorners) {
  // The highest energy over a corner, by thirds; nearer and lower than over a side, at 25.47°.
  double low = 20 * kDegree;
  double high = 26 * kDegree;
  for (int i = 0; i < 60; ++i) {
    const double a = (2 * low + high) / 3;
    const double b = (low + 2 * high) / 3;
    if (energyOverCorner(a) < energyOverCorner(b)) {
      low = a;
    } else {
      high = b;
    }
  }
  EXPECT_NEAR(low / kDegree, 23.13, 0.01);
  EXPECT_GT(leverOverSide(25.46 * kDegree), 0);
  EXPECT_LT(leverOverSide(25.47 * kDegree), 0);
  for (const int n : {1, 12}) {
    const Afloat box13 = afloat(box({1, 1, 1.3}, n), 0.1);
    const Stability& s = box13.stability;
    EXPECT_NEAR(s.vanishing / kDegree, low / kDegree, 1e-4); // a flat maximum: √1e-15 rad
    EXPECT_NEAR(s.barrier, energyOverCorner(low) - 0.585, 1e-10);
    EXPECT_LT((s.direction.cwiseAbs() - Vec3(std::sqrt(0.5), std::sqrt(0.5), 0)).norm(), 1e-4);
    EXPECT_NEAR(s.safe / kDegree, low / kDegree, 0.1); // by the copy, a direction every 5°
    EXPECT_LE(s.safe, s.vanishing);
  }
}

TEST(RightingLevers, OfALightBoxOverItsSideAreThoseOfAWedge) {
  const Afloat box13 = afloat(box({1, 1, 1.3}, 3), 0.1);
  const auto levers = rightingLevers(box13.body, box13.copy, box13.pose, Vec3::UnitX(), 2 * kDegree,
                                     25.4667 * kDegree);
  ASSERT_EQ(levers.size(), 13U);
  for (const RightingLever& l : levers) EXPECT_NEAR(l.lever, leverOverSide(l.heel), 1e-8);
  EXPECT_NEAR(levers.back().heel, 25.4667 * kDegree, 1e-12);
}

TEST(Stability, OfASquareLogOnItsEdgeEndsOnItsSides) {
  // Half under water it is stable at 45° and unstable flat.
  const Afloat log = afloat(box({4, 1, 1}, 4), 0.5);
  EXPECT_NEAR(log.stability.vanishing, 45 * kDegree, 1e-5);
  EXPECT_NEAR(std::abs(log.stability.direction.x()), 0.0, 1e-5);
  EXPECT_NEAR(log.stability.safe, 45 * kDegree, 0.2 * kDegree);
}

TEST(Stability, OfALoadedBallNeverEnds) {
  const double load = 0.05;
  for (const double density : {0.4, 1.0}) {
    const Afloat ball = afloat(sphere(20), density, {0, 0, -load});
    EXPECT_EQ(ball.stability.vanishing, std::acos(-1.0));
    EXPECT_EQ(ball.stability.safe, std::acos(-1.0));
    const auto levers = rightingLevers(ball.body, ball.copy, ball.pose, ball.stability.direction,
                                       15 * kDegree, ball.stability.vanishing);
    ASSERT_EQ(levers.size(), 12U);
    // The ball's facets, 0.06 long, shift the centre of buoyancy by less than their sagitta.
    for (const RightingLever& l : levers) EXPECT_NEAR(l.lever, load * std::sin(l.heel), 5e-4);
  }
}

TEST(Stability, OfALyingCylinderIsThatOfItsFacets) {
  const TriangleMesh upright = revolved({{0, 1}, {0.5, 1}, {0.5, -1}, {0, -1}}, 120);
  const Mat3 lay = rotation(Vec3::UnitY(), 90 * kDegree);
  EXPECT_NEAR(afloat(transformed(upright, lay), 0.5).stability.vanishing, 1.5 * kDegree,
              0.01 * kDegree);
}

/// Where the body goes from an orientation, by small steps down.
Vec3 released(const FloatingBody& body, Vec3 up) {
  for (int step = 0; step < 4000; ++step) {
    const Inclination at = inclined(body, up);
    const Vec3 slope = at.arm - at.energy * up;
    if (slope.norm() < 1e-5) break;
    up = (up - std::min(0.5, 0.02 / slope.norm()) * slope).normalized();
  }
  return up;
}

TEST(Stability, IsHowFarABodyComesBackFrom) {
  // Without any symmetry.
  const TriangleMesh box13 = transformed(box({1, 1.05, 1.3}, 2), shear(0.05));
  for (const double lowered : {0.05, 0.15}) {
    const Afloat sheared = afloat(box13, 0.1, {0.02, 0.01, -lowered});
    const Stability& s = sheared.stability;
    ASSERT_GT(s.safe, 5 * kDegree);
    ASSERT_LT(s.vanishing, 90 * kDegree);
    const auto comesBack = [&](const Vec3& t, double heel) {
      const Vec3 up = std::cos(heel) * sheared.pose.up + std::sin(heel) * t;
      return (released(sheared.body, up) - sheared.pose.up).norm() < 0.02;
    };
    EXPECT_TRUE(comesBack(s.direction, s.vanishing - 0.5 * kDegree)) << lowered;
    EXPECT_FALSE(comesBack(s.direction, s.vanishing + 0.5 * kDegree)) << lowered;
    const Horizontal axes = horizontal(sheared.pose.up);
    for (int a = 0; a < 360; a += 15) {
      const Vec3 t = axes * Vec2(std::cos(a * kDegree), std::sin(a * kDegree));
      EXPECT_TRUE(comesBack(t, s.safe - 0.1 * kDegree)) << lowered << ' ' << a;
    }
  }
}

TEST(Stability, OfALumpWithOnePoseNeverEnds) {
  // One minimum and one maximum of the energy, no saddle: only exactly at the maximum it stays.
  const Afloat lump = afloat(blob(5), 0.4, {0.05, -0.02, 0.1});
  EXPECT_EQ(lump.stability.vanishing, std::acos(-1.0));
  EXPECT_LT(lump.stability.safe, 170 * kDegree);
  Random random(9);
  for (int i = 0; i < 20; ++i) {
    const Vec3 end = released(lump.body, random.vector().normalized());
    EXPECT_LT((end - lump.pose.up).norm(), 0.02);
  }
}

TEST(Stability, EndsWhereAnOpeningGetsUnderWater) {
  // A flat raft, 2 × 2 × 1, half under water, with an opening in the middle of its deck's edge:
  // heeled towards it by atan(½) it is at the water.
  Points rim(1, 3);
  rim << 1, 0, 0.5;
  const Afloat raft = afloat(box({2, 2, 1}, 4), 0.5, {0, 0, -0.3}, rim);
  EXPECT_TRUE(raft.stability.floods);
  EXPECT_NEAR(raft.stability.vanishing, std::atan(0.5), 0.01 * kDegree);
  EXPECT_EQ(raft.stability.flooding, raft.stability.vanishing);
  EXPECT_LT((raft.stability.direction + Vec3::UnitX()).norm(), 1e-9);
}

} // namespace
} // namespace massprops::testing
