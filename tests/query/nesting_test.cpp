// Which components lie inside of which.
#include "core/query/nesting.h"

#include "shapes.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace massprops::testing {
namespace {

std::vector<int> depthsOf(const TriangleMesh& mesh) {
  return nestingDepths(mesh.vertices, connectedComponents(mesh.vertices.rows(), mesh.faces));
}

TEST(NestingDepths, CountTheComponentsAround) {
  // The innermost first, one beside all, and one in a hole of the box around a ring.
  const TriangleMesh ring = torus(2, 0.5, 24, 12);
  TriangleMesh mesh = scaled(sphere(2), 0.1);
  mesh = joined(mesh, reversed(scaled(sphere(2), 0.4)));
  mesh = joined(mesh, scaled(sphere(3), 0.8));
  mesh = joined(mesh, ring);
  mesh = joined(mesh, transformed(sphere(2), Mat3::Identity(), {9, 0, 0}));
  EXPECT_EQ(depthsOf(mesh), (std::vector<int>{2, 1, 0, 0, 0}));
}

TEST(NestingDepths, OfManyPartsReadNoOtherPartsVertices) {
  // A ball with a bubble among hundreds of such pairs, whose vertices are no numbers here.
  const TriangleMesh pair = joined(sphere(1), reversed(scaled(sphere(1), 0.3)));
  const Eigen::Index n = pair.vertices.rows();
  constexpr int kPairs = 300;
  Points vertices = Points::Constant(kPairs * n, 3, std::numeric_limits<double>::quiet_NaN());
  for (int i = 0; i < kPairs; i += 50) {
    vertices.middleRows(i * n, n) = pair.vertices;
    const Faces faces = pair.faces.array() + static_cast<int>(i * n);
    const Components parts = connectedComponents(vertices.rows(), faces);
    EXPECT_EQ(nestingDepths(vertices, parts), (std::vector<int>{0, 1})) << i;
    vertices.middleRows(i * n, n).setConstant(std::numeric_limits<double>::quiet_NaN());
  }
}

} // namespace
} // namespace massprops::testing
