// Nearly good models: they work, the result is that of the good model, and the report says what
// was mended.
#include "core/pipeline.h"
#include "judge/checks.h"
#include "large_test.h"
#include "shapes.h"

#include <gtest/gtest.h>
#include <sched.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace massprops::testing {
namespace {

double number(const Result& result, const std::string& key) {
  return std::get<double>(result.report.at(key));
}

std::string repairs(const Result& result) {
  return std::get<std::string>(result.report.at("repairs"));
}

double diagonal(const TriangleMesh& mesh) {
  return (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).norm();
}

/// Stands as a hollow body only.
TriangleMesh leaningPillar() {
  return transformed(roundedBox({1, 1, 2}, 0.15, 6, 2), shear(0.45));
}

const Result& resultOfPillar() {
  static const Result result = optimizeMassProperties(leaningPillar(), {});
  return result;
}

/// The cavity is as promised for the bodies `outer`.
void expectGoodCavity(const Result& result, const TriangleMesh& outer) {
  ASSERT_GT(result.inner.faces.rows(), 0);
  EXPECT_TRUE(isClosedAndOriented(result.inner));
  EXPECT_EQ(intersectingPairs(result.inner), 0U);
  EXPECT_EQ(intersectingPairs(result.inner, outer), 0U);
  EXPECT_TRUE(isInside(result.inner, outer));
  EXPECT_GE(leastDistance(result.inner, outer), 0.01 * diagonal(outer));
}

void expectTheSameCavity(const Result& result, const Result& original) {
  EXPECT_EQ(result.inner.faces, original.inner.faces);
  EXPECT_EQ(result.inner.vertices, original.inner.vertices);
}

TEST(MendedInput, TellsNoRepairOfACleanModel) {
  EXPECT_EQ(repairs(resultOfPillar()), "none");
}

TEST(MendedInput, MayBeUnwelded) {
  const Result result = optimizeMassProperties(unwelded(leaningPillar()), {});
  expectGoodCavity(result, leaningPillar());
  EXPECT_NE(repairs(result).find("duplicate vertices merged"), std::string::npos);
  // The vertices come in another order, the body is the same: so is what it can reach, about.
  EXPECT_NEAR(number(result, "tip_angle_after"), number(resultOfPillar(), "tip_angle_after"), 0.5);
}

TEST(MendedInput, MayHaveUnusedVertices) {
  TriangleMesh model = leaningPillar();
  const Eigen::Index n = model.vertices.rows();
  model.vertices.conservativeResize(n + 1, 3);
  model.vertices.row(n) << 50, 60, 70;
  const Result result = optimizeMassProperties(model, {});
  EXPECT_EQ(repairs(result), "1 unused vertex left out");
  expectTheSameCavity(result, resultOfPillar());
}

TEST(MendedInput, MayHaveDuplicateFaces) {
  TriangleMesh model = leaningPillar();
  const Eigen::Index m = model.faces.rows();
  model.faces.conservativeResize(m + 1, 3);
  model.faces.row(m) = model.faces.row(3);
  const Result result = optimizeMassProperties(model, {});
  EXPECT_EQ(repairs(result), "1 duplicate face removed");
  expectTheSameCavity(result, resultOfPillar());
}

TEST(MendedInput, MayHaveFacesWithoutArea) {
  // A cap: the middle of an edge as a third corner on it.
  TriangleMesh model = box({1, 1, 2}, 4);
  const Eigen::RowVector3i face = model.faces.row(0);
  const Eigen::Index n = model.vertices.rows();
  model.vertices.conservativeResize(n + 1, 3);
  model.vertices.row(n) = 0.5 * (model.vertices.row(face[0]) + model.vertices.row(face[1]));
  const Eigen::Index m = model.faces.rows();
  const auto middle = static_cast<int>(n);
  model.faces.conservativeResize(m + 2, 3);
  model.faces.row(0) << face[0], middle, face[2];
  model.faces.row(m) << middle, face[1], face[2];
  model.faces.row(m + 1) << face[0], face[1], middle;
  const Result result = optimizeMassProperties(model, {});
  EXPECT_EQ(repairs(result), "1 face without area removed");
  expectGoodCavity(result, box({1, 1, 2}, 4));
}

TEST(MendedInput, MayFaceInwards) {
  const Result result = optimizeMassProperties(reversed(leaningPillar()), {});
  EXPECT_EQ(repairs(result), "1 component flipped");
  expectGoodCavity(result, leaningPillar());
  // The input and the cavity together would bound something else.
  EXPECT_EQ(std::get<int>(result.report.at("flipped_components")), 1);
  ASSERT_TRUE(result.outer.has_value());
  EXPECT_EQ(result.outer->vertices, leaningPillar().vertices);
  EXPECT_TRUE(isClosedAndOriented(*result.outer));
  const double material = quadratureMoments(*result.outer)[0] + quadratureMoments(result.inner)[0];
  // The working frame rounds coordinates.
  EXPECT_NEAR(number(result, "volume_after"), material, 1e-8 * material);
  EXPECT_FALSE(resultOfPillar().outer.has_value());
}

TEST(MendedInput, MayBeVerySmallOrVeryLarge) {
  LARGE_TEST();
  for (const double size : {1e-6, 1e6}) {
    const TriangleMesh model = scaled(leaningPillar(), size);
    const Result result = optimizeMassProperties(model, {});
    expectGoodCavity(result, model);
    EXPECT_NEAR(number(result, "tip_angle_after"), number(resultOfPillar(), "tip_angle_after"),
                1e-4);
    EXPECT_NEAR(number(result, "min_wall"), size * number(resultOfPillar(), "min_wall"),
                1e-6 * size);
  }
}

TEST(MendedInput, MayBeFarFromTheOrigin) {
  // A million times its size away a double still has 1e-10 left.
  const TriangleMesh model = shifted(leaningPillar(), {1e6, -2e6, 3e6});
  const Result result = optimizeMassProperties(model, {});
  ASSERT_GT(result.inner.faces.rows(), 0);
  const TriangleMesh near = shifted(result.inner, {-1e6, 2e6, -3e6});
  EXPECT_EQ(intersectingPairs(result.inner), 0U);
  EXPECT_GE(leastDistance(near, leaningPillar()), 0.01 * diagonal(model));
  // The last digits of the coordinates change the skeleton a little.
  EXPECT_NEAR(number(result, "tip_angle_after"), number(resultOfPillar(), "tip_angle_after"), 1.5);
}

TEST(MendedInput, MayBeSeveralBodiesThatAreOptimisedAsOne) {
  LARGE_TEST();
  // Each of two pillars that lean towards each other falls over alone; together they stand.
  const TriangleMesh one = leaningPillar();
  const TriangleMesh other =
      shifted(transformed(one, rotation(Vec3::UnitZ(), 3.14159265358979)), {3.0, 0, 0});
  const TriangleMesh both = joined(one, other);
  const Result result = optimizeMassProperties(both, {});
  expectGoodCavity(result, both);
  EXPECT_EQ(repairs(result), "none");
  EXPECT_GE(std::get<int>(result.report.at("cavity_components")), 2);
  EXPECT_TRUE(std::get<bool>(result.report.at("stands_before")));
  EXPECT_TRUE(std::get<bool>(result.report.at("stands_after")));
  const double volume = quadratureMoments(both)[0] + quadratureMoments(result.inner)[0];
  EXPECT_NEAR(number(result, "volume_after"), volume, 1e-8 * volume);
}

TEST(MendedInput, MayHaveACavityWhichTheNewOneReplaces) {
  LARGE_TEST();
  const TriangleMesh body = leaningPillar();
  const TriangleMesh hole = shifted(scaled(sphere(4), 0.2), {0.1, 0, 0.3});
  for (const bool turned : {false, true}) {
    const Result result = optimizeMassProperties(joined(body, turned ? hole : reversed(hole)), {});
    ASSERT_TRUE(result.outer.has_value());
    EXPECT_EQ(result.outer->faces, body.faces);
    expectGoodCavity(result, *result.outer);
    expectTheSameCavity(result, resultOfPillar());
    const std::string replaced = "1 existing cavity replaced by the new one";
    EXPECT_EQ(repairs(result), turned ? "1 component flipped, " + replaced : replaced);
    // Before: with the old cavity. After: with the new one alone.
    const double solid = quadratureMoments(body)[0];
    EXPECT_NEAR(number(result, "volume_before"), solid - quadratureMoments(hole)[0], 1e-8);
    EXPECT_NEAR(number(result, "volume_after"), number(resultOfPillar(), "volume_after"), 1e-8);
  }
}

TEST(MendedInput, MayHaveAllOfThisTogether) {
  const TriangleMesh body = scaled(leaningPillar(), 1e3);
  const TriangleMesh hole = transformed(sphere(3), 200 * Mat3::Identity(), {100, 0, 300});
  const TriangleMesh beside = transformed(blob(4), 300 * Mat3::Identity(), {2000, 0, 0});
  TriangleMesh model = unwelded(joined(joined(reversed(body), hole), beside));
  model = shifted(model, {1e4, 2e4, -3e4});
  const Result result = optimizeMassProperties(model, {});
  ASSERT_TRUE(result.outer.has_value());
  EXPECT_EQ(intersectingPairs(result.inner), 0U);
  EXPECT_EQ(intersectingPairs(result.inner, *result.outer), 0U);
  for (const char* part : {"merged", "2 components flipped", "1 existing cavity replaced"})
    EXPECT_NE(repairs(result).find(part), std::string::npos) << repairs(result);
}

TEST(LargestWall, WorksWhereTheWallAskedForDoesNot) {
  LARGE_TEST();
  Options options;
  options.goal = GoalKind::Mass; // which any cavity serves
  const TriangleMesh plate = box({1, 1, 0.1}, 10);
  options.innerLowerBound = 0.06;
  const Result none = optimizeMassProperties(plate, options);
  EXPECT_EQ(none.inner.faces.rows(), 0);
  const double largest = number(none, "largest_wall");
  EXPECT_GT(largest, 0.01);
  EXPECT_LT(largest, 0.05); // half of the plate
  options.innerLowerBound = 0.99 * largest;
  const Result thin = optimizeMassProperties(plate, options);
  EXPECT_GT(thin.inner.faces.rows(), 0);
  EXPECT_GE(leastDistance(thin.inner, plate), 0.99 * largest);
  EXPECT_THROW(thin.report.at("largest_wall"), std::out_of_range);
}

TEST(Determinism, HoldsOnOneCoreAndOnAll) {
  LARGE_TEST();
  cpu_set_t all;
  ASSERT_EQ(sched_getaffinity(0, sizeof all, &all), 0);
  const TriangleMesh model = figure(2);
  const Result onAll = optimizeMassProperties(model, {});
  int first = 0;
  while (CPU_ISSET(first, &all) == 0) ++first;
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(first, &one);
  ASSERT_EQ(sched_setaffinity(0, sizeof one, &one), 0);
  const Result onOne = optimizeMassProperties(model, {});
  ASSERT_EQ(sched_setaffinity(0, sizeof all, &all), 0);
  expectTheSameCavity(onOne, onAll);
  expectTheSameCavity(optimizeMassProperties(model, {}), onAll);
}

} // namespace
} // namespace massprops::testing
