#include "core/best/best_cavity.h"

#include "core/pipeline.h"
#include "core/query/self_intersection.h"
#include "judge/checks.h"
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

} // namespace
} // namespace massprops::testing
