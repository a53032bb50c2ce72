// Tipping angles by cubes against a closed form.
#include "judge/standing_gain.h"

#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace massprops::testing {
namespace {

constexpr double kDegrees = 180.0 / 3.14159265358979323846;

TEST(StandingGain, OfABoxIsThatOfAHorizontalCut) {
  // Cubes of side 4/32 whose middles are 0.4 deep fill a square of side 1.25 up to z = 3.625. What
  // is above z = s is taken away, at best with s = z̄:
  // z̄ (16 − a (t − z̄)) = 32 − a (t² − z̄²) / 2.
  const double a = 1.25 * 1.25;
  const double t = 3.625;
  const double p = (16.0 - a * t) / a;
  const double centre = std::sqrt(p * p + (64.0 - a * t * t) / a) - p;
  const StandingGain angles = standingGain(box({2.0, 2.0, 4.0}, 1), 0.4, 0.2);
  EXPECT_NEAR(angles.solid, kDegrees * std::atan(1.0 / 2.0), 1e-9);
  // No direction is nearer to the vertical than 1.8°.
  EXPECT_NEAR(angles.best, kDegrees * std::atan(1.0 / centre), 0.1);
}

TEST(StandingGain, IsNoneInRoomsNarrowerThanAWall) {
  // 2.5 walls thick: what is deeper than a wall is half a wall wide.
  const TriangleMesh sheet = box({0.5, 0.25, 0.8}, 1);
  const StandingGain none = standingGain(sheet, 0.1, 0.02);
  EXPECT_EQ(none.best, none.solid);
  // 3.5 walls thick.
  const StandingGain some = standingGain(box({0.5, 0.35, 0.8}, 1), 0.1, 0.02);
  EXPECT_GT(some.best, some.solid + 0.1);
}

TEST(StandingGain, IsUnknownOnAPoint) {
  const TriangleMesh onItsTip = tetrahedron({0, 0, 0}, {1, 0, 1}, {0, 1, 1}, {-1, -1, 1});
  EXPECT_TRUE(std::isnan(standingGain(onItsTip, 0.01, 0.01).solid));
}

} // namespace
} // namespace massprops::testing
