// Inside and outside, against the winding number.
#include "core/query/point_in_mesh.h"

#include "judge/checks.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <vector>

namespace massprops::testing {
namespace {

std::vector<bool> insideOf(const Points& points, const TriangleMesh& mesh) {
  const TriangleTree tree(mesh.vertices, mesh.faces);
  const PointInMesh surface(tree);
  std::vector<bool> inside;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    inside.push_back(surface.contains(points.row(i).transpose()));
  }
  return inside;
}

TEST(PointInMesh, SeparatesTheInsideOfARing) {
  const TriangleMesh ring = torus(2, 0.5, 24, 12);
  Points points(4, 3);
  points << 2, 0, 0, 0, 0, 0, -2, 0.1, 0.2, 9, 0, 0;
  EXPECT_EQ(insideOf(points, ring), (std::vector<bool>{true, false, true, false}));
}

TEST(PointInMesh, AgreesWithTheWindingNumberBehindEdgesAndCorners) {
  // On this grid every way along an axis meets edges or corners.
  const TriangleMesh steps = polycube({{0, 0, 0}, {1, 0, 0}, {1, 0, 1}}, 2);
  const Vec3 low = steps.vertices.colwise().minCoeff();
  const Vec3 high = steps.vertices.colwise().maxCoeff();
  Points points(11 * 11 * 11, 3);
  for (int i = 0; i < points.rows(); ++i) {
    const Vec3 share = Vec3(i % 11, i / 11 % 11, i / 121) / 8.0 - Vec3::Constant(1.0 / 8.0);
    points.row(i) = (low + share.cwiseProduct(high - low)).transpose();
  }
  const std::vector<bool> inside = insideOf(points, steps);
  const TriangleTree tree(steps.vertices, steps.faces);
  int count = 0;
  for (int i = 0; i < points.rows(); ++i) {
    const Vec3 p = points.row(i).transpose();
    const bool isOnSurface = tree.nearest(p).squaredDistance == 0.0;
    const bool expected = !isOnSurface && windingNumber(steps, p) > 0.5;
    EXPECT_EQ(inside[static_cast<std::size_t>(i)], expected) << p.transpose();
    EXPECT_TRUE(isOnSurface || PointInMesh(tree).contains(p, tree.nearest(p)) == expected);
    count += expected ? 1 : 0;
  }
  EXPECT_GT(count, 100);
}

TEST(PointInMesh, ComesToAnEndInASheetOfAlmostNoThickness) {
  TriangleMesh sheet = sphere(3);
  sheet.vertices.col(1) *= 1e-30;
  Points points(2, 3);
  points << 0.1, 0, 0.2, 0.1, 1e-25, 0.2;
  EXPECT_EQ(insideOf(points, sheet), (std::vector<bool>{true, false}));
}

} // namespace
} // namespace massprops::testing
