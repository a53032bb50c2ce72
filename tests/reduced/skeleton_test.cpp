// The skeleton of a known body, and that it is the same bytes again.
#include "core/reduced/skeleton.h"

#include "core/model/frame.h"
#include "reduced/working_scale.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

namespace massprops::testing {
namespace {

TEST(MeanCurvatureSkeleton, OfACapsuleIsItsAxis) {
  const TriangleMesh mesh = working(capsule(0.5, 4, 24));
  const Points skeleton = meanCurvatureSkeleton(mesh.vertices, mesh.faces).points;
  ASSERT_EQ(skeleton.rows(), mesh.vertices.rows());
  EXPECT_TRUE(skeleton.allFinite());
  const double radius = 0.5 / 4.97; // of the diagonal
  EXPECT_LT(skeleton.leftCols(2).rowwise().norm().maxCoeff(), 0.25 * radius);
  // A point of the side belongs to the point of the axis at about its own height.
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    if (std::abs(mesh.vertices(v, 2)) < 0.3) {
      EXPECT_NEAR(skeleton(v, 2), mesh.vertices(v, 2), radius);
    }
  }
}

TEST(MeanCurvatureSkeleton, IsTheSameBitForBitTheSecondTime) {
  const TriangleMesh mesh = working(figure(2));
  const Points first = meanCurvatureSkeleton(mesh.vertices, mesh.faces).points;
  std::vector<std::unique_ptr<char[]>> blocks;
  for (int i = 0; i < 20000; ++i)
    if (i % 3 != 0)
      blocks.push_back(std::make_unique<char[]>(static_cast<std::size_t>(24 + i % 97)));
  EXPECT_EQ(meanCurvatureSkeleton(mesh.vertices, mesh.faces).points, first);
}

} // namespace
} // namespace massprops::testing
