// Tipping angles of bodies that are being filled, against closed forms and plain sampling.
#include "core/goals/filling_levels.h"

#include "core/goals/stand.h"
#include "core/goals/stand_empty_and_filled.h"
#include "core/model/contact.h"
#include "core/physics/hydrostatics.h"
#include "goals/goal_checks.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace massprops::testing {
namespace {

TriangleMesh boxAt(const Vec3& size, const Vec3& centre) {
  return transformed(box(size, 2), Mat3::Identity(), centre);
}

TEST(FillingLevels, OfABoxInTheMiddleAreWorstAtALevelBetween) {
  // A column with its centre at 1 and a tall cavity above the middle: the first of the contents
  // lowers the centre of mass, the last raises it.
  const Moments empty = bodyAt({0, 0, 1.0}, 1.0);
  const TriangleMesh cavity = boxAt({0.5, 0.5, 3.0}, {0, 0, 1.6}); // from 0.1 to 3.1
  const double density = 2.0;
  const FillingLevels levels(cavity.vertices, cavity.faces);
  EXPECT_EQ(levels.cavities(), 1);
  // tan = 0.5/c_z with c_z = (1 + 2·0.25 (z² − 0.1²)/2)/(1 + 2·0.25 (z − 0.1)), greatest at 3.1.
  double highest = 1.0;
  for (int i = 0; i <= 1000; ++i) {
    const double z = 0.1 + 3.0 * i / 1000;
    highest = std::max(highest, (1 + 0.25 * (z * z - 0.01)) / (1 + 0.5 * (z - 0.1)));
  }
  const double least = levels.leastTangent(tippingDirections(square(1.0)), empty, density);
  EXPECT_LE(least, 0.5 / highest + 1e-9);
  EXPECT_GE(least, 0.97 * 0.5 / highest);
}

TEST(FillingLevels, FindTheLevelThatFallsThoughBothEndsStand) {
  // A leaning tube: what is poured in first lies to the right, beyond the foot's edge.
  Mat3 lean = Mat3::Identity();
  lean(0, 2) = -1.4;
  const TriangleMesh cavity = transformed(box({0.3, 0.3, 1.2}, 2), lean, {0.1, 0, 0.8});
  const Moments empty = bodyAt({0.05, 0, 0.5}, 0.05);
  const auto directions = tippingDirections(square(0.5));
  const FillingLevels levels(cavity.vertices, cavity.faces);
  const Moments inside = momentsOf(cavity);
  EXPECT_GT(levelReached(standingConditions(directions), empty), 0.0);
  EXPECT_GT(levelReached(standingConditions(directions), empty + inside), 0.0);
  double sampled = 1.0;
  for (int i = 0; i <= 200; ++i) {
    const Displacement d =
        displacement(cavity.vertices, cavity.faces, Vec3::UnitZ(), 0.2 + 1.2 * i / 200);
    Moments body = empty;
    body[0] += d.volume;
    body.segment<3>(1) += d.volume * d.centre;
    sampled = std::min(sampled, levelReached(standingConditions(directions), body));
  }
  EXPECT_LT(sampled, 0.0);
  const double least = levels.leastTangent(directions, empty, 1.0);
  EXPECT_LE(least, sampled + 1e-9);
  EXPECT_NEAR(least, sampled, 0.05);
}

TEST(FillingLevels, OfTwoCavitiesAreWorstWithOneFullAndOneEmpty) {
  const TriangleMesh both =
      joined(boxAt({0.2, 0.2, 0.2}, {0.35, 0, 0.5}), boxAt({0.2, 0.2, 0.2}, {-0.35, 0, 0.5}));
  const FillingLevels levels(both.vertices, both.faces);
  EXPECT_EQ(levels.cavities(), 2);
  const Moments empty = bodyAt({0, 0, 0.5}, 0.01);
  const auto directions = tippingDirections(square(0.5));
  // One full: c_x = 0.008·0.35/0.018; the area ends at 0.25.
  const double expected = (0.25 - 0.008 * 0.35 / 0.018) / 0.5;
  const double least = levels.leastTangent(directions, empty, 1.0);
  EXPECT_LE(least, expected + 1e-9);
  EXPECT_NEAR(least, expected, 0.02);
}

TEST(FillingLevels, AreTheStatesThatOnlyTheVerdictKnows) {
  const TriangleMesh both =
      joined(boxAt({0.2, 0.2, 0.2}, {0.35, 0, 0.5}), boxAt({0.2, 0.2, 0.2}, {-0.35, 0, 0.5}));
  const Moments empty = bodyAt({0, 0, 0.5}, 0.01);
  const Moments outer = empty + momentsOf(both);
  const ContactArea area = square(0.5);
  const auto hollow = makeStandEmptyAndFilledVerdict(area, outer, 1.0, 1.0, &both);
  const double least =
      FillingLevels(both.vertices, both.faces).leastTangent(tippingDirections(area), empty, 1.0);
  ASSERT_TRUE(hollow->worstMeasure(empty));
  EXPECT_NEAR(std::tan(*hollow->worstMeasure(empty) * std::acos(-1.0) / 180.0), least, 1e-12);
  // Both ends stand better.
  EXPECT_LT(*hollow->worstMeasure(empty), tippingAngleOf(area, empty) - 1.0);
  EXPECT_LT(*hollow->worstMeasure(empty), tippingAngleOf(area, outer) - 1.0);
  const auto solid = makeStandEmptyAndFilledVerdict(area, outer, 1.0, 1.0, nullptr);
  EXPECT_NEAR(solid->worstMeasure(outer).value_or(0.0), tippingAngleOf(area, outer), 1e-9);
  EXPECT_FALSE(makeStandVerdict(area, 1.0)->worstMeasure(empty));
}

} // namespace
} // namespace massprops::testing
