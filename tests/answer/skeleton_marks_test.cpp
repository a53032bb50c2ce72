// The skeleton as it is drawn.
#include "core/answer/skeleton_marks.h"

#include "judge/checks.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace massprops::testing {
namespace {

/// Volume of a regular hexagonal prism.
double penVolume(double length, double radius) {
  return 1.5 * std::sqrt(3.0) * radius * radius * length;
}

TEST(SkeletonMarks, AreTheCurvesAndALineFromEachVertexToItsPoint) {
  const TriangleMesh body = box({3.0, 2.0, 6.0}); // diagonal 7, 8 vertices
  Skeleton skeleton;
  skeleton.nodes.resize(3, 3);
  skeleton.nodes << 0.0, 0.0, -2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0;
  skeleton.segments.resize(2, 2);
  skeleton.segments << 0, 1, 1, 2;
  skeleton.points.resize(8, 3);
  for (int v = 0; v < 8; ++v) {
    skeleton.points.row(v) << 0.0, 0.0, (body.vertices(v, 2) > 0.0 ? 2.0 : -2.0);
  }
  const ColouredMesh marks = skeletonMarks(body, skeleton);
  EXPECT_TRUE(isClosedAndOriented(marks.mesh));
  // Each corner is at (±1.5, ±1, ±3).
  const double line = std::sqrt(1.5 * 1.5 + 1.0 + 1.0);
  EXPECT_NEAR(quadratureMoments(marks.mesh)[0],
              penVolume(4.0, 0.003 * 7.0) + 8.0 * penVolume(line, 0.0007 * 7.0), 1e-9);
  // Prisms of twelve corners, the curves first.
  ASSERT_EQ(marks.mesh.vertices.rows(), 12 * (2 + 8));
  ASSERT_EQ(marks.colours.size(), 12U * (2 + 8));
  EXPECT_EQ(marks.colours[23].red, kSkeletonColour.red);
  EXPECT_EQ(marks.colours[24].red, kCorrespondenceColour.red);
  for (int v = 0; v < 8; ++v) {
    const auto distances =
        (marks.mesh.vertices.bottomRows(12 * 8).rowwise() - body.vertices.row(v)).rowwise().norm();
    EXPECT_LT(distances.minCoeff(), 0.0007 * 7.0 + 1e-12) << v;
  }
}

TEST(SkeletonMarks, OfManyVerticesAreFewLinesEvenlySpread) {
  const TriangleMesh body = sphere(20); // 4002 vertices
  Skeleton skeleton;
  skeleton.points = Points::Zero(body.vertices.rows(), 3);
  const ColouredMesh marks = skeletonMarks(body, skeleton);
  EXPECT_EQ(marks.mesh.vertices.rows(), 12 * 300);
  // 300 caps of this radius have the area of the sphere; points chosen one by one, each as far
  // as can be from the others, are within twice the radius that the best ones need, about 1.2 caps.
  const double cap = std::sqrt(4.0 / 300.0);
  for (Eigen::Index v = 0; v < body.vertices.rows(); ++v) {
    const auto distances = (marks.mesh.vertices.rowwise() - body.vertices.row(v)).rowwise().norm();
    EXPECT_LT(distances.minCoeff(), 2.4 * cap) << v;
  }
}

} // namespace
} // namespace massprops::testing
