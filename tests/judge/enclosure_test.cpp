// Volume and depth by cubes against closed forms.
#include "judge/enclosure.h"

#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace massprops::testing {
namespace {

constexpr double kPi = 3.14159265358979323846;

TEST(Enclosure, HasTheVolumeOfABox) {
  const Enclosure whole = enclosedBy(box({4.0, 2.0, 1.0}, 2));
  EXPECT_NEAR(whole.volume, 8.0, 1e-9);
  EXPECT_NEAR(whole.share, 1.0, 1e-12);
}

TEST(Enclosure, DoesNotNeedAClosedSurfaceNorItsOrientation) {
  const TriangleMesh ball = sphere(16);
  const double volume = 4.0 / 3.0 * kPi;
  // 100,000 places, spread evenly.
  EXPECT_NEAR(enclosedBy(ball).volume, volume, 0.01 * volume);
  EXPECT_NEAR(enclosedBy(reversed(ball)).volume, volume, 0.01 * volume);
  TriangleMesh torn = unwelded(ball);
  torn.faces.row(0) = torn.faces.row(torn.faces.rows() - 1);
  torn.faces.conservativeResize(torn.faces.rows() - 1, 3);
  EXPECT_NEAR(enclosedBy(torn).volume, volume, 0.01 * volume);
}

TEST(Enclosure, OfASheetIsNothing) {
  const TriangleMesh flat = transformed(box({1.0, 1.0, 1.0}, 4), Mat3(Vec3(1, 1, 0).asDiagonal()));
  EXPECT_EQ(enclosedBy(flat).volume, 0.0);
}

TEST(Depth, IsHalfTheLeastSideOfABox) {
  const Depth depth = depthOf(box({4.0, 2.0, 1.0}, 1), 0.1);
  EXPECT_LE(depth.atLeast, 0.5 + 1e-12);
  EXPECT_GE(depth.atMost, 0.5 - 1e-12);
  EXPECT_LE(depth.atMost, 1.021 * depth.atLeast);
}

TEST(Depth, OfAShellIsHalfItsThickness) {
  const TriangleMesh outer = box({2.0, 2.0, 2.0}, 1);
  const TriangleMesh shell = joined(outer, reversed(box({1.6, 1.6, 1.6}, 1)));
  const Depth depth = depthOf(shell, 0.05);
  // On the diagonal of a corner a point t inside of the three planes is √3 (0.2 − t) from the inner
  // corner: t = 0.2 √3 / (1 + √3).
  const double t = 0.2 * std::sqrt(3.0) / (1.0 + std::sqrt(3.0));
  EXPECT_LE(depth.atLeast, t + 1e-12);
  EXPECT_GE(depth.atMost, t - 1e-12);
  EXPECT_LE(depth.atMost, 1.021 * depth.atLeast);
}

TEST(Depth, IsNotLookedForBelowTheLeast) {
  const Depth depth = depthOf(box({4.0, 2.0, 1.0}, 1), 0.6);
  EXPECT_LE(depth.atMost, 0.6);
}

TEST(Cells, FillWhatIsDeepEnough) {
  constexpr double kSide = 0.05;
  double volume = 0.0;
  for (const Cell& cell : cellsDeeperThan(box({4.0, 2.0, 1.0}, 1), 0.2, kSide)) {
    volume += cell.volume;
    EXPECT_LE(std::abs(cell.middle.z()), 0.3 + 1e-12);
  }
  // Of a layer of cubes some stand out by half of their side, or are missing.
  const double area = 2.0 * (3.6 * 1.6 + 3.6 * 0.6 + 1.6 * 0.6);
  EXPECT_NEAR(volume, 3.6 * 1.6 * 0.6, 0.5 * kSide * area);
}

} // namespace
} // namespace massprops::testing
