// A signed length at the nodes of a grid, against the closed form.
#include "core/query/grid_sampling.h"

#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

namespace massprops::testing {
namespace {

constexpr double kRadius = 0.7;

double depthInBall(const Vec3& x) {
  return kRadius - x.norm();
}

TEST(GridSampling, IsTheLengthInEdgesWhereItIsNearZero) {
  const Grid grid = gridAround(sphere(8).vertices, someRotation(), 0.06, 1e6);
  // Beyond the horizon it need not be exact.
  const std::vector<float> values = sampled(grid, [] {
    return [](const Vec3& x, double horizon) {
      const double depth = depthInBall(x);
      return std::abs(depth) < horizon ? depth : 1.05 * depth;
    };
  });
  ASSERT_EQ(values.size(), static_cast<std::size_t>(grid.nodes()));
  for (int k = 0; k < grid.counts.z(); ++k) {
    for (int j = 0; j < grid.counts.y(); ++j) {
      for (int i = 0; i < grid.counts.x(); ++i) {
        const auto exact = static_cast<float>(depthInBall(grid.positionOf(i, j, k)) / grid.edge);
        EXPECT_NEAR(values[static_cast<std::size_t>(grid.nodeAt(i, j, k))],
                    std::clamp(exact, -kSampledBand, kSampledBand), 1e-5);
      }
    }
  }
}

TEST(GridSampling, LooksAtFewNodesFarFromZero) {
  const Grid grid = gridAround(sphere(8).vertices, Mat3::Identity(), 0.02, 1e7);
  std::atomic<int> looked = 0;
  sampled(grid, [&] {
    return [&](const Vec3& x, double) {
      ++looked;
      return depthInBall(x);
    };
  });
  EXPECT_LT(looked, grid.nodes() / 2);
}

TEST(GridSampling, HasAGridThatReachesBeyondThePoints) {
  const TriangleMesh ball = sphere(8);
  const Grid grid = gridAround(ball.vertices, someRotation(), 0.1, 1e6);
  const Points turned = ball.vertices * grid.rotation.transpose();
  const Vec3 last = grid.origin + grid.edge * (grid.counts - 1).matrix().cast<double>();
  EXPECT_TRUE((turned.colwise().minCoeff().transpose() - grid.origin).minCoeff() > 2.9 * grid.edge);
  EXPECT_TRUE((last - turned.colwise().maxCoeff().transpose()).minCoeff() > 1.9 * grid.edge);
}

TEST(GridSampling, IsCoarserWhereThereWouldBeVeryManyNodes) {
  const Grid grid = gridAround(sphere(8).vertices, Mat3::Identity(), 1e-3, 1e6);
  EXPECT_LT(grid.nodes(), 1.5e6);
  EXPECT_GT(grid.nodes(), 0.5e6);
}

} // namespace
} // namespace massprops::testing
