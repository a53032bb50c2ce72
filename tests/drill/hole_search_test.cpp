// Where holes go, on bodies whose best place is plain.
#include "core/drill/hole_search.h"

#include "core/drill/cutting.h"
#include "core/mesh/signed_volume.h"

#include "large_test.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <vector>

namespace massprops::testing {
namespace {

bool nowhere(const Vec3& /*point*/) {
  return false;
}

/// An outer surface and a cavity, with what searches them.
struct Vessel {
  TriangleMesh outer, cavity;
  TriangleTree outerTree{outer.vertices, outer.faces};
  TriangleTree cavityTree{cavity.vertices, cavity.faces};

  std::vector<DrillSite>
  holes(double diameter, const HoleWishes& wishes,
        const std::function<bool(const Vec3&)>& isKeptClear = nowhere) const {
    return holesFor({outerTree, cavityTree, nullptr, diameter, isKeptClear}, wishes);
  }
  double left(const std::vector<DrillSite>& sites, const Vec3& up) const {
    std::vector<Outlet> outlets;
    for (const DrillSite& site : sites) outlets.push_back(outletAt(site, cavityTree, up));
    double volume = 0.0;
    for (const Pool& pool : standingPools(cavity, up, outlets)) volume += pool.volume;
    return volume;
  }
};

TEST(HolesFor, ABallDrainAtItsLowestPointAndLetAirInAtItsHighest) {
  const Vessel ball{sphere(24), scaled(sphere(24), 0.9)};
  const Vec3 up = someRotation() * Vec3::UnitZ();
  const std::vector<DrillSite> holes = ball.holes(0.1, {up, 2, 1e-3});
  ASSERT_EQ(holes.size(), 2U);
  EXPECT_GT(holes[0].hole.direction.dot(-up), 0.99);
  EXPECT_GT(holes[1].hole.direction.dot(up), 0.99);
  // A cap as high as the rim's radius makes it: π h² R, h = r²/2R.
  const double h = 0.05 * 0.05 / 1.8;
  EXPECT_LT(ball.left(holes, up), 3.0 * 3.1416 * h * h * 0.9);
  EXPECT_TRUE(drilled(ball.outer, ball.cavity, {holes[0].hole, holes[1].hole}, 0.005,
                      [](const Points& p) { return p; }));
}

TEST(HolesFor, ABoxThatStandsKeepOffItsContactAreaAndItsEdges) {
  const Vessel tank{box({40, 30, 20}, 6), box({36, 26, 16}, 6)};
  const auto onTheGround = [](const Vec3& p) { return p.z() < -10 + 1e-6; };
  const std::vector<DrillSite> holes = tank.holes(3.5, {Vec3::UnitZ(), 1, 100}, onTheGround);
  ASSERT_FALSE(holes.empty());
  for (const DrillSite& site : holes) {
    for (Eigen::Index i = 0; i < site.outerRim.rows(); ++i) {
      EXPECT_FALSE(onTheGround(site.outerRim.row(i).transpose()));
    }
  }
  // The lowest place in a side wall: what stays is a layer below a rim near the floor.
  EXPECT_LT(tank.left(holes, Vec3::UnitZ()), 36 * 26 * 2.0);
  // Where it may open on the ground, all runs off there, through the thinnest wall.
  const std::vector<DrillSite> below = tank.holes(3.5, {Vec3::UnitZ(), 1, 100});
  ASSERT_EQ(below.size(), 1U);
  EXPECT_LT(tank.left(below, Vec3::UnitZ()), 1e-9);
  EXPECT_NEAR(below[0].hole.direction.z(), -1.0, 1e-9);
}

TEST(HolesFor, EveryLegThatWouldStayFullHasOneOfItsOwn) {
  const auto cells =
      std::vector<std::array<int, 3>>{{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {2, 0, 1}, {2, 0, 0}};
  const TriangleMesh outer = scaled(polycube(cells, 6), 20);
  TriangleMesh cavity = outer;
  // A wall of 2 everywhere: every coordinate of a polycube's surface moves inwards.
  const Points normals = [&] {
    Points sum = Points::Zero(outer.vertices.rows(), 3);
    for (Eigen::Index f = 0; f < outer.faces.rows(); ++f) {
      const Vec3 a = outer.vertices.row(outer.faces(f, 0)).transpose();
      const Vec3 b = outer.vertices.row(outer.faces(f, 1)).transpose();
      const Vec3 c = outer.vertices.row(outer.faces(f, 2)).transpose();
      const Vec3 n = (b - a).cross(c - a).normalized();
      for (const int v : outer.faces.row(f)) {
        for (int k = 0; k < 3; ++k) {
          if (std::abs(n[k]) > 0.5) sum(v, k) = n[k];
        }
      }
    }
    return sum;
  }();
  cavity.vertices -= 2.0 * normals;
  const Vessel trousers{outer, cavity};
  const std::vector<DrillSite> holes = trousers.holes(3.5, {Vec3::UnitZ(), 1, 100});
  EXPECT_EQ(holes.size(), 2U);
  EXPECT_LT(trousers.left(holes, Vec3::UnitZ()), 100.0);
}

TEST(HolesFor, RandomLumpsDrainInRandomPoses) {
  LARGE_TEST();
  Random random(11);
  int drilledLumps = 0;
  for (int trial = 0; trial < 6; ++trial) {
    SCOPED_TRACE(trial);
    const Vec3 a = random.vector();
    const Vec3 b = random.vector();
    const TriangleMesh lump = starShaped(
        [&](const Vec3& u) {
          return 30.0 + 6.0 * std::sin(5.0 * u.dot(a)) + 6.0 * std::cos(6.0 * u.dot(b));
        },
        14);
    // Behind a wall of 2 to 4 and, of genus 1, a ring.
    const bool isRing = trial % 3 == 2;
    const TriangleMesh outer = isRing ? torus(25, 10, 40, 20) : lump;
    const TriangleMesh inner = isRing ? torus(25, 7, 40, 20) : scaled(lump, 0.88);
    const Vessel vessel{outer, inner};
    const Vec3 up = random.vector().normalized();
    const double tolerated = 100.0;
    const std::vector<DrillSite> sites = vessel.holes(3.5, {up, 2, tolerated});
    ASSERT_GE(sites.size(), 2U);
    std::vector<Hole> holes;
    for (const DrillSite& site : sites) {
      holes.push_back(site.hole);
      // Rims are rings of points on the two surfaces, as far from the axis as the cone is wide.
      for (const bool isOuter : {false, true}) {
        const Points& rim = isOuter ? site.outerRim : site.innerRim;
        const TriangleTree& tree = isOuter ? vessel.outerTree : vessel.cavityTree;
        for (Eigen::Index i = 0; i < rim.rows(); ++i) {
          const Vec3 p = rim.row(i).transpose();
          EXPECT_LT(tree.nearest(p).squaredDistance, 1e-12);
          const double along = (p - site.hole.centre).dot(site.hole.direction);
          const double off = (p - site.hole.centre - along * site.hole.direction).norm();
          EXPECT_NEAR(off, site.hole.radiusAt(along), 1e-6);
          EXPECT_GE(off, 0.5 * 3.5);
        }
      }
    }
    const auto body = drilled(outer, inner, holes, 0.15, [](const Points& p) { return p; });
    ASSERT_TRUE(body);
    ++drilledLumps;
    const double removed = signedVolume(outer.vertices, outer.faces) -
                           signedVolume(inner.vertices, inner.faces) -
                           signedVolume(body->body.vertices, body->body.faces);
    double expected = 0.0;
    for (const DrillSite& site : sites) expected += site.removed;
    EXPECT_NEAR(removed, expected, 0.1 * expected); // 24 rays and a mean radius stand for each hole
    double plugs = 0.0;
    for (const TriangleMesh& plug : body->plugs) plugs += signedVolume(plug.vertices, plug.faces);
    EXPECT_LT(plugs, removed);
    EXPECT_GT(plugs, 0.75 * removed);
    EXPECT_LT(vessel.left(sites, up), vessel.left({sites[1]}, up));
  }
  EXPECT_EQ(drilledLumps, 6);
}

TEST(HolesFor, NothingWhereTheDrillIsWiderThanTheCavity) {
  const Vessel narrow{box({10, 10, 30}, 5), box({2, 2, 20}, 5)};
  EXPECT_TRUE(narrow.holes(3.5, {Vec3::UnitZ(), 2, 100}).empty());
}

} // namespace
} // namespace massprops::testing
