// Which vertices are joined, on a sphere with known valences.
#include "core/mesh/vertex_adjacency.h"

#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace massprops::testing {
namespace {

TEST(VertexAdjacency, IsSymmetricAscendingAndSixOnARegularMesh) {
  const VertexAdjacency neighbours = [] {
    const TriangleMesh mesh = sphere(4);
    return vertexAdjacency(mesh.vertices.rows(), mesh.faces);
  }();
  int five = 0;
  for (std::size_t v = 0; v < neighbours.size(); ++v) {
    EXPECT_TRUE(std::is_sorted(neighbours[v].begin(), neighbours[v].end()));
    five += neighbours[v].size() == 5 ? 1 : 0;
    for (const int w : neighbours[v]) {
      const auto& back = neighbours[static_cast<std::size_t>(w)];
      EXPECT_TRUE(std::binary_search(back.begin(), back.end(), static_cast<int>(v)));
    }
  }
  EXPECT_EQ(five, 12); // the corners of the icosahedron
}

} // namespace
} // namespace massprops::testing
