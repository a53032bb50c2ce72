#include "core/best/best_cavity.h"

#include "cells.h"
#include "core/base/angles.h"
#include "core/goals/mass.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/signed_volume.h"
#include "core/pipeline.h"
#include "core/query/self_intersection.h"
#include "judge/checks.h"
#include "large_test.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <variant>

namespace massprops::testing {
namespace {

// A file that garbles what is in one place.
TEST(BestCavity, StaysSolidWhereItCrossesItselfOnlyOnceItIsStored) {
  const TriangleMesh ball = sphere(24);
  constexpr double kWall = 0.1;
  const Vec3 place(0.0, 0.0, 1.0 - kWall);
  int moved = 0;
  Options options;
  options.goal = GoalKind::Mass;
  options.cavityShape = CavityShape::BestPossible;
  options.innerLowerBound = kWall;
  // At the same distance from the ball.
  options.representable = [&](const Points& points) {
    constexpr double kRadius = 0.05;
    const Mat3 turn = Eigen::AngleAxisd(2.0, Vec3::UnitZ()).toRotationMatrix();
    Points stored = points;
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      const Vec3 p = points.row(i).transpose();
      if ((p - place).norm() > kRadius) continue;
      stored.row(i) = (turn * p).transpose();
      ++moved;
    }
    return stored;
  };
  const Result result = optimizeMassProperties(ball, options);
  EXPECT_GT(moved, 0);
  ASSERT_GT(result.inner.faces.rows(), 0) << std::get<std::string>(result.report.at("stop_reason"));
  EXPECT_TRUE(selfIntersectingFaces(result.inner.vertices, result.inner.faces).empty());
  EXPECT_GE(leastDistance(ball, result.inner), kWall);
  EXPECT_LT(std::get<double>(result.report.at("gap_to_limit")), 0.03);
}

/// A large standing sheet, and a cube at its foot.
TriangleMesh sheetWithCube(double side, double thickness, double cube) {
  return joined(shifted(box({side, thickness, side}), {0.0, 0.0, 0.5 * side}),
                shifted(box({cube, cube, cube}), {0.0, 0.5, 0.5 * cube}));
}

Report bestReport(const TriangleMesh& model, GoalKind goal, double wall) {
  Options options;
  options.goal = goal;
  options.cavityShape = CavityShape::BestPossible;
  options.innerLowerBound = wall;
  return optimizeMassProperties(model, options).report;
}

std::string messageOf(const Report& report) {
  return std::get<std::string>(report.at("message"));
}

TEST(BestCavity, IsSaidToServeNoBetterWhereASmallRoomDoesNot) {
  LARGE_TEST();
  // A room in the cube alone, and nothing that is hollow so low makes it stand better.
  constexpr double kWall = 0.05;
  const TriangleMesh model = sheetWithCube(6.0, 2.4 * kWall, 3.3 * kWall);
  EXPECT_GT(std::get<int>(bestReport(model, GoalKind::Mass, kWall).at("cavity_triangles")), 0);
  const std::string told = messageOf(bestReport(model, GoalKind::Stand, kWall));
  EXPECT_NE(told.find("no cavity with this wall was found to serve it better"), std::string::npos)
      << told;
}

TEST(BestCavity, IsNotSaidToBeAllThatFitsWhereAnOffsetSurfaceDoes) {
  // What is a wall behind both sides of the sheet is half a wall wide.
  constexpr double kWall = 0.05;
  const TriangleMesh sheet = box({1.0, 2.5 * kWall, 1.0});
  const std::string told = messageOf(bestReport(sheet, GoalKind::Mass, kWall));
  EXPECT_NE(
      told.find("nothing can be hollowed at this wall, channels narrower than the wall apart"),
      std::string::npos)
      << told;
  Options options;
  options.goal = GoalKind::Mass;
  options.cavityShape = CavityShape::Offset;
  options.innerLowerBound = kWall;
  EXPECT_GT(optimizeMassProperties(sheet, options).inner.faces.rows(), 0);
}

TEST(BestCavity, HasALargestWallInASmallRoomToo) {
  LARGE_TEST();
  // Neither the cube nor the sheet has room for the first one.
  constexpr double kCube = 0.165;
  const TriangleMesh model = sheetWithCube(8.0, 0.12, kCube);
  const Report none = bestReport(model, GoalKind::Mass, 0.06);
  ASSERT_NE(messageOf(none).find("nothing can be hollowed"), std::string::npos);
  const double wall = std::get<double>(none.at("largest_wall"));
  EXPECT_LE(wall, kCube / 3.0);
  EXPECT_GT(wall, 0.8 * kCube / 3.0);
  EXPECT_GT(std::get<int>(bestReport(model, GoalKind::Mass, wall).at("cavity_triangles")), 0);
}

// Whatever the quadric, what is found passes inspection.
TEST(BestCavity, KeepsItsPromisesForAnyQuadric) {
  LARGE_TEST();
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  const TriangleMesh outer = figure(5);
  const TriangleTree tree(outer.vertices, outer.faces);
  const double wall = 0.01 * (tree.upper() - tree.lower()).norm();
  const FeasibleSet set{tree, wall, wall};
  const FeasibleRegion region = feasibleRegion(set, edgeFor(set));
  const Moments solid = moments(outer.vertices, outer.faces);
  const std::unique_ptr<Goal> goal = makeMassGoal(solid[0], std::nullopt, Weights{});
  CavityTask task{tree, *goal, {}};
  task.model.surface = std::make_shared<const MovingSurface>();
  task.model.fillings = {{}};
  task.model.solidMoments = solid;
  task.inputMoments = solid;
  task.wall = wall;
  task.bound.emplace();
  int found = 0;
  for (int i = 0; i < 12; ++i) {
    Moments quadric;
    for (double& term : quadric) term = normal(random);
    quadric.tail<6>() *= 2.0;
    task.bound->worth = LayeredQuadric::ofOneLayer(quadric);
    const CavityResult cavity = bestPossibleCavity(task, set, region);
    if (cavity.status != CavityStatus::Found) continue;
    ++found;
    const EdgeCounts edges = countEdges(cavity.inner.rows(), cavity.cavity.faces);
    EXPECT_EQ(edges.boundary + edges.nonManifold + edges.incoherent, 0U);
    EXPECT_TRUE(selfIntersectingFaces(cavity.inner, cavity.cavity.faces).empty());
    EXPECT_GE(leastDistance(outer, {cavity.inner, cavity.cavity.faces}), wall);
    // As far as triangles resolve it, it is where the quadric is positive.
    const AdmissibleCells cells = admissibleCells(region, Admissible::Reached, 1e6);
    double positive = 0.0;
    for (Eigen::Index c = 0; c < cells.rows(); ++c) {
      const Moments cell = cells.row(c).transpose();
      if (quadric.dot(cell) > 0.0) positive += cell[0];
    }
    EXPECT_NEAR(signedVolume(cavity.inner, cavity.cavity.faces), positive, 0.03 * positive);
  }
  EXPECT_GE(found, 10);
}

/// A ball that is to weigh what it does with a cavity of this volume.
struct WantedBall {
  TriangleMesh outer = sphere(24);
  TriangleTree tree{outer.vertices, outer.faces};
  double all = signedVolume(outer.vertices, outer.faces);
  double wall;
  std::unique_ptr<Goal> goal;

  WantedBall(double cavity, double least)
      : wall(least), goal(makeMassGoal(all, all - cavity, Weights{})) {}

  std::optional<CavityResult> cavity() const {
    CavityTask task{tree, *goal, {}};
    task.model.surface = std::make_shared<const MovingSurface>();
    task.model.fillings = {{}};
    task.model.solidMoments = moments(outer.vertices, outer.faces);
    task.inputMoments = task.model.solidMoments;
    task.wall = wall;
    const FeasibleSet set{tree, wall, wall};
    return uniformlyWalledCavity(task, set, cellsBehind(tree, wall), edgeFor(set));
  }
};

TEST(UniformlyWalledCavity, HasTheDifferenceOfRadiiOfABallForAWall) {
  for (const double radius : {0.3, 0.6, 0.9}) {
    const double volume = 4.0 / 3.0 * kPi * std::pow(radius, 3);
    const WantedBall ball(volume, 0.02);
    const std::optional<CavityResult> cavity = ball.cavity();
    ASSERT_TRUE(cavity) << radius;
    EXPECT_EQ(cavity->status, CavityStatus::Found);
    EXPECT_TRUE(cavity->inspection.isClean());
    // The constraint is one of shares of the solid's mass, kept to a millionth.
    EXPECT_NEAR(signedVolume(cavity->inner, cavity->cavity.faces), volume, 1e-6 * ball.all);
    EXPECT_TRUE(selfIntersectingFaces(cavity->inner, cavity->cavity.faces).empty());
    const Vector radii = cavity->inner.rowwise().norm();
    EXPECT_NEAR(radii.mean(), radius, 0.01);
    // A ball's facets lie up to 0.3 % deeper than its corners, its cavity's as well.
    EXPECT_LT(radii.maxCoeff() - radii.minCoeff(), 0.02);
  }
}

TEST(UniformlyWalledCavity, IsNotThereWhereTheLeastWallLeavesLessRoom) {
  const double all = signedVolume(sphere(24).vertices, sphere(24).faces);
  EXPECT_TRUE(WantedBall(0.9 * all, 0.02).cavity());
  EXPECT_FALSE(WantedBall(0.96 * all, 0.02).cavity()); // (1 - 0.02)³ = 0.94
}

TEST(UniformlyWalledCavity, IsNotThereForOtherGoals) {
  const WantedBall ball(1.0, 0.02);
  const std::unique_ptr<Goal> lightest = makeMassGoal(ball.all, std::nullopt, Weights{});
  CavityTask task{ball.tree, *lightest, {}};
  task.model.fillings = {{}};
  task.model.solidMoments = moments(ball.outer.vertices, ball.outer.faces);
  task.wall = ball.wall;
  const FeasibleSet set{ball.tree, ball.wall, ball.wall};
  EXPECT_FALSE(uniformlyWalledCavity(task, set, cellsBehind(ball.tree, ball.wall), 0.05));
}

} // namespace
} // namespace massprops::testing
