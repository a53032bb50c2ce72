// What of a ceiling does not carry itself, on shapes with known ceilings.
#include "core/overhang/ceiling.h"

#include "core/base/angles.h"
#include "shapes.h"

#include <gtest/gtest.h>

namespace massprops::testing {
namespace {

constexpr double kAngle = 45.0 / kDegrees;

Ceiling ceilingOf(const TriangleMesh& cavity) {
  return massprops::ceilingOf(cavity, Mat3::Identity(), kAngle, 0.05);
}

TEST(Ceiling, OfABoxSpansItsShorterSide) {
  const Ceiling ceiling = ceilingOf(box({3.0, 1.0, 2.0}, 4));
  EXPECT_NEAR(ceiling.widestSpan, 1.0, 0.03);
  EXPECT_TRUE(ceiling.tips.empty());
}

TEST(Ceiling, OfATurnedBoxIsThatOfTheSideThatIsUpInThePrinter) {
  Mat3 toPrint; // x is up
  toPrint << 0, 1, 0, 0, 0, 1, 1, 0, 0;
  const Ceiling ceiling = massprops::ceilingOf(box({3.0, 1.0, 2.0}, 4), toPrint, kAngle, 0.05);
  EXPECT_NEAR(ceiling.widestSpan, 1.0, 0.03);
}

TEST(Ceiling, OfAConeIsFlatWhereItIsFlatter) {
  for (const double slope : {40.0, 50.0}) {
    const double height = std::tan(slope / kDegrees);
    const Ceiling ceiling = ceilingOf(revolved({{0, height}, {1, 0}, {1, -1}, {0, -1}}, 96));
    EXPECT_NEAR(ceiling.widestSpan, slope < 45.0 ? 2.0 : 0.0, 0.05);
  }
}

TEST(Ceiling, HangsDownInATip) {
  // Steep everywhere: up from the rim to a ring, and down again to its middle.
  const double down = 0.3;
  const TriangleMesh cavity = revolved({{0, 1.2 - down}, {0.2, 1.2}, {1, 0}, {1, -1}, {0, -1}}, 96);
  const Ceiling ceiling = ceilingOf(cavity);
  ASSERT_EQ(ceiling.tips.size(), 1U);
  EXPECT_LT((ceiling.tips[0] - Vec3(0, 0, 1.2 - down)).norm(), 1e-9);
  // One that is not as deep does not count.
  EXPECT_TRUE(massprops::ceilingOf(cavity, Mat3::Identity(), kAngle, down + 0.01).tips.empty());
}

TEST(Ceiling, HasNoTipWhereAColumnGoesDownToTheFloor) {
  const TriangleMesh ring = torus(1.0, 0.4, 64, 32);
  EXPECT_TRUE(ceilingOf(ring).tips.empty());
}

} // namespace
} // namespace massprops::testing
