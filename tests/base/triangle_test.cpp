// Normals of vertices.
#include "core/base/triangle.h"

#include "shapes.h"

#include <gtest/gtest.h>

namespace massprops::testing {
namespace {

TEST(VertexNormals, PointAwayFromTheCentreOfASphereAndAreZeroWithoutAFace) {
  TriangleMesh ball = sphere(8);
  const Eigen::Index n = ball.vertices.rows();
  ball.vertices.conservativeResize(n + 1, 3);
  ball.vertices.row(n) << 7, 8, 9;
  const Points normals = vertexNormals(ball.vertices, ball.faces);
  EXPECT_TRUE(normals.row(n).isZero(0.0));
  for (Eigen::Index v = 0; v < n; ++v) {
    EXPECT_NEAR(normals.row(v).dot(ball.vertices.row(v)), 1.0, 1e-3);
    EXPECT_NEAR(normals.row(v).norm(), 1.0, 1e-14);
  }
}

} // namespace
} // namespace massprops::testing
