// Cavities whose ceilings are to carry themselves, judged in cubes as a printer lays them.
#include "core/pipeline.h"
#include "judge/layers.h"
#include "large_test.h"
#include "samples.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <string>
#include <variant>

namespace massprops::testing {
namespace {

constexpr double kSide = 0.75; // mm

Overhang overhangOf(const Result& result) {
  TriangleMesh cavity = result.inner;
  cavity.faces.col(1).swap(cavity.faces.col(2)); // its normals point into it
  return testing::overhangOf(cavity, kSide);
}

double number(const Result& result, const std::string& key) {
  return std::get<double>(result.report.at(key));
}

void expectCarried(const TriangleMesh& model, Options options, double largestGap) {
  options.overhangAngle = 0.0;
  const Result flat = optimizeMassProperties(model, options);
  options.overhangAngle = 45.0;
  const Result carried = optimizeMassProperties(model, options);
  // Half a bridge of 5 mm, and what the cubes round.
  constexpr double kReach = 2.5 + 2.0 * kSide;
  const Overhang overhang = overhangOf(carried);
  EXPECT_LE(overhang.reach, kReach);
  EXPECT_LT(overhang.reach, overhangOf(flat).reach - kSide);
  EXPECT_EQ(overhang.islands, 0);
  EXPECT_TRUE(std::get<bool>(carried.report.at("solved")));
  EXPECT_LE(number(carried, "ceiling_span"), 5.0);
  EXPECT_EQ(std::get<int>(carried.report.at("ceiling_tips")), 0);
  EXPECT_LT(number(carried, "gap_to_limit"), largestGap);
}

TEST(Printable, BoxWeighsHardlyMoreThanOneWithAFlatCeiling) {
  LARGE_TEST();
  Options options;
  options.goal = GoalKind::Mass;
  options.innerLowerBound = 1.2;
  expectCarried(box({60, 60, 60}, 12), options, 0.16);
}

TEST(Printable, DinosaurStands) {
  LARGE_TEST();
  expectCarried(sampleMesh("toy_dinosaur"), {}, 0.35);
}

TEST(Printable, DogStandsOnItsLegs) {
  LARGE_TEST();
  expectCarried(sampleMesh("toy_dog"), {}, 0.4);
}

TEST(Printable, WeighsWhatIsAskedForWithAHeavyFilling) {
  LARGE_TEST();
  Options options;
  options.goal = GoalKind::Mass;
  options.fillDensity = 5.0;
  options.innerLowerBound = 1.2;
  options.overhangAngle = 45.0;
  const TriangleMesh model = box({60, 60, 60}, 12);
  options.targetMass = 500.0;
  const Result result = optimizeMassProperties(model, options);
  EXPECT_TRUE(std::get<bool>(result.report.at("solved")));
  EXPECT_NEAR(number(result, "mass_after"), 500.0, 5e-4);
}

TEST(Printable, CeilingIsThatOfTheBuildAxis) {
  LARGE_TEST();
  // A long room, printed upright, has a small ceiling: less has to be filled than lying.
  Options options;
  options.goal = GoalKind::Mass;
  options.innerLowerBound = 1.2;
  options.overhangAngle = 45.0;
  const TriangleMesh model = box({90, 24, 24}, 10);
  const Result lying = optimizeMassProperties(model, options);
  options.buildAxis = BuildAxis::PlusX;
  const Result upright = optimizeMassProperties(model, options);
  EXPECT_LT(number(upright, "mass_after"), number(lying, "mass_after"));
}

TEST(Printable, NothingChangesWhereTheCeilingIsSteep) {
  Options options;
  options.goal = GoalKind::Mass;
  options.cavityShape = CavityShape::BestPossible;
  options.innerLowerBound = 1.0;
  // A cone of 60° whose tip is rounded off by less than a bridge.
  const TriangleMesh cone = revolved({{0, 45}, {1, 44}, {25, 2}, {25, 0}, {0, 0}}, 64);
  const Result asItComes = optimizeMassProperties(cone, options);
  options.overhangAngle = 45.0;
  const Result carried = optimizeMassProperties(cone, options);
  EXPECT_NEAR(number(carried, "mass_after") / number(asItComes, "mass_after"), 1.0, 0.01);
}

TEST(Printable, LargestWallIsThatWithoutTheAngle) {
  Options options;
  options.goal = GoalKind::Mass;
  options.innerLowerBound = 12.0;
  options.overhangAngle = 45.0;
  const TriangleMesh model = box({20, 20, 20}, 6);
  const Result nothing = optimizeMassProperties(model, options);
  EXPECT_NE(std::get<std::string>(nothing.report.at("message"))
                .find("lower overhang_angle; without it, lower inner_lower_bound to "),
            std::string::npos);
  options.innerLowerBound = 0.99 * number(nothing, "largest_wall");
  options.overhangAngle = 0.0;
  EXPECT_GT(optimizeMassProperties(model, options).inner.faces.rows(), 0);
}

} // namespace
} // namespace massprops::testing
