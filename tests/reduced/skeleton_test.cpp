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

/// How many connected pieces the segments make of the nodes.
int pieceCount(const Skeleton& skeleton) {
  std::vector<int> piece(static_cast<std::size_t>(skeleton.nodes.rows()));
  for (std::size_t i = 0; i < piece.size(); ++i) piece[i] = static_cast<int>(i);
  int count = static_cast<int>(piece.size());
  for (Eigen::Index s = 0; s < skeleton.segments.rows(); ++s) {
    const int a = piece[static_cast<std::size_t>(skeleton.segments(s, 0))];
    const int b = piece[static_cast<std::size_t>(skeleton.segments(s, 1))];
    if (a == b) continue;
    --count;
    for (int& p : piece)
      if (p == b) p = a;
  }
  return count;
}

TEST(MeanCurvatureSkeleton, HasACycleForEachHandleOfTheBody) {
  const auto cyclesOf = [](const Skeleton& s) {
    return s.segments.rows() - s.nodes.rows() + pieceCount(s);
  };
  const TriangleMesh limbs = working(figure(2));
  const Skeleton tree = meanCurvatureSkeleton(limbs.vertices, limbs.faces);
  EXPECT_EQ(pieceCount(tree), 1);
  EXPECT_EQ(cyclesOf(tree), 0);

  const TriangleMesh both =
      working(joined(torus(1.0, 0.3, 48, 20),
                     transformed(capsule(0.2, 2.0, 16), Mat3::Identity(), {0.0, 0.0, 3.0})));
  const Skeleton ring = meanCurvatureSkeleton(both.vertices, both.faces);
  EXPECT_EQ(pieceCount(ring), 2);
  EXPECT_EQ(cyclesOf(ring), 1);
}

TEST(MeanCurvatureSkeleton, HasTheVerticesPointsAmongItsNodes) {
  const TriangleMesh mesh = working(figure(2));
  const Skeleton skeleton = meanCurvatureSkeleton(mesh.vertices, mesh.faces);
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    const auto distances = (skeleton.nodes.rowwise() - skeleton.points.row(v)).rowwise().norm();
    EXPECT_EQ(distances.minCoeff(), 0.0) << v;
  }
}

TEST(MeanCurvatureSkeleton, IsTheSameBitForBitTheSecondTime) {
  const TriangleMesh mesh = working(figure(2));
  const Skeleton first = meanCurvatureSkeleton(mesh.vertices, mesh.faces);
  std::vector<std::unique_ptr<char[]>> blocks;
  for (int i = 0; i < 20000; ++i)
    if (i % 3 != 0)
      blocks.push_back(std::make_unique<char[]>(static_cast<std::size_t>(24 + i % 97)));
  const Skeleton second = meanCurvatureSkeleton(mesh.vertices, mesh.faces);
  EXPECT_EQ(second.points, first.points);
  EXPECT_EQ(second.nodes, first.nodes);
  EXPECT_EQ(second.segments, first.segments);
}

} // namespace
} // namespace massprops::testing
