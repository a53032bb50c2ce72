// Functions known at the nodes of a grid that is turned.
#include "core/query/grid_function.h"

#include "shapes.h"

#include <gtest/gtest.h>

namespace massprops::testing {
namespace {

/// f at the nodes, in edges.
template <typename Function>
GridFunction sampled(const Grid& grid, const Function& f) {
  GridFunction result{grid, {}};
  for (int k = 0; k < grid.counts.z(); ++k) {
    for (int j = 0; j < grid.counts.y(); ++j) {
      for (int i = 0; i < grid.counts.x(); ++i)
        result.values.push_back(static_cast<float>(f(grid.positionOf(i, j, k)) / grid.edge));
    }
  }
  return result;
}

Grid turnedGrid() {
  Grid grid;
  grid.rotation = someRotation();
  grid.edge = 0.1;
  grid.origin = Vec3(-1.0, -0.8, -0.9);
  grid.counts = {21, 17, 19};
  return grid;
}

TEST(GridFunction, IsALinearFunctionWhereItWasSampledFromOne) {
  const Grid grid = turnedGrid();
  const Vec3 slope = Vec3(0.3, -0.5, 0.8).normalized();
  const GridFunction function = sampled(grid, [&](const Vec3& x) { return slope.dot(x) - 0.1; });
  for (const Vec3& x : {Vec3(0.11, 0.23, -0.37), Vec3(-0.4, 0.1, 0.2), Vec3(0, 0, 0)}) {
    const Sample sample = function.at(x);
    EXPECT_NEAR(sample.value, slope.dot(x) - 0.1, 1e-6);
    EXPECT_LT((sample.slope - slope).norm(), 1e-5);
  }
}

TEST(GridFunction, IsNearlyTheDistanceFromABall) {
  const Grid grid = turnedGrid();
  const GridFunction function = sampled(grid, [](const Vec3& x) { return x.norm() - 0.6; });
  for (const Vec3& u : {Vec3(1, 0, 0), Vec3(0, -1, 0), Vec3(1, 1, 1), Vec3(-2, 1, 0.5)}) {
    const Vec3 x = 0.63 * u.normalized();
    const Sample sample = function.at(x);
    constexpr double kOfInterpolation = 0.125 * 0.1 * 0.1 / 0.6 * 2.0; // second derivatives 1/r
    EXPECT_NEAR(sample.value, 0.03, kOfInterpolation);
    EXPECT_GT(sample.slope.dot(u.normalized()), 0.99);
  }
}

TEST(GridFunction, StaysBeyondTheGridWhatItIsAtItsEnd) {
  const Grid grid = turnedGrid();
  const GridFunction function = sampled(grid, [](const Vec3& x) { return x.x(); });
  const Vec3 corner = grid.positionOf(0, 0, 0);
  const Vec3 beyond = grid.rotation.transpose() * (grid.origin - Vec3(3, 3, 3));
  EXPECT_NEAR(function.at(beyond).value, function.at(corner).value, 1e-6);
}

} // namespace
} // namespace massprops::testing
