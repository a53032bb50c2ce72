#include "core/best/best_cavity.h"

#include "core/pipeline.h"
#include "core/query/self_intersection.h"
#include "judge/checks.h"
#include "large_test.h"
#include "shapes.h"

#include <gtest/gtest.h>

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

} // namespace
} // namespace massprops::testing
