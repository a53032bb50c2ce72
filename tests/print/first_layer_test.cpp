#include "core/print/first_layer.h"

#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace massprops::testing {
namespace {

constexpr double kPi = 3.14159265358979323846;

TEST(FirstLayer, OfABoxIsItsRectangle) {
  const TriangleMesh body = box({6, 2, 5}, 3);
  const FirstLayer layer = firstLayer(body.vertices, body.faces, -2.4);
  EXPECT_NEAR(layer.area, 12.0, 1e-12);
  // Over the long edge at a slant, for its corner reaches farthest.
  double least = 4.0;
  for (double angle = 0.0; angle < 0.5 * kPi; angle += 1e-3) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    least = std::min(least, (4.0 * c * c + 36.0 * s * s) / (c + 3.0 * s));
  }
  EXPECT_GE(layer.sectionModulus, least - 1e-6);
  EXPECT_LE(layer.sectionModulus, 1.01 * least); // directions are 5° apart
}

TEST(FirstLayer, OfASquareIsWeakestOverACorner) {
  const TriangleMesh body = shifted(box({2, 2, 2}), {7, -3, 1});
  EXPECT_NEAR(firstLayer(body.vertices, body.faces, 1.0).sectionModulus, std::sqrt(2.0) / 12 * 8,
              1e-12);
}

TEST(FirstLayer, LeavesOutTheCavity) {
  const TriangleMesh ring = joined(box({4, 4, 4}), reversed(box({2, 2, 2})));
  EXPECT_NEAR(firstLayer(ring.vertices, ring.faces, 0.3).area, 16.0 - 4.0, 1e-12);
  EXPECT_NEAR(firstLayer(ring.vertices, ring.faces, 1.5).area, 16.0, 1e-12);
}

TEST(FirstLayer, OfACylinderIsADisc) {
  constexpr double kRadius = 3.0;
  constexpr int kSides = 720;
  const TriangleMesh body = revolved({{0, 2}, {kRadius, 2}, {kRadius, 0}, {0, 0}}, kSides);
  const FirstLayer layer = firstLayer(body.vertices, body.faces, 0.7);
  // A polygon with so many sides falls short by (2π/n)²/6.
  EXPECT_NEAR(layer.area, kPi * 9, 1e-3);
  EXPECT_NEAR(layer.sectionModulus, kPi * 27 / 4, 1e-2);
}

TEST(FirstLayer, IsEmptyWhereNothingIs) {
  const TriangleMesh body = box({2, 2, 2});
  EXPECT_EQ(firstLayer(body.vertices, body.faces, 1.5).area, 0.0);
  EXPECT_FALSE(holds(firstLayer(body.vertices, body.faces, 1.5), 10.0));
}

TEST(FirstLayer, HoldsAsLongAsTheBodyIsLowEnough) {
  const TriangleMesh body = box({10, 10, 10});
  const FirstLayer layer = firstLayer(body.vertices, body.faces, -4.9);
  // 0.02 MPa · 1000 √2/12 mm³ = 0.0981 N · 24 mm
  EXPECT_TRUE(holds(layer, 24.0));
  EXPECT_FALSE(holds(layer, 24.1));
}

} // namespace
} // namespace massprops::testing
