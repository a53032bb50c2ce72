// Functions that keep a slope along edges.
#include "core/mesh/lipschitz.h"

#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace massprops::testing {
namespace {

TEST(Lipschitz, FunctionsAreTheTightestOnesThatKeepTheSlope) {
  const TriangleMesh mesh = blob(6);
  const VertexAdjacency neighbours = vertexAdjacency(mesh.vertices.rows(), mesh.faces);
  const Vector values = Random(51).vector(mesh.vertices.rows());
  const Vector below = lipschitzBelow(mesh.vertices, neighbours, values);
  const Vector above = lipschitzAbove(mesh.vertices, neighbours, values);
  EXPECT_LE((below - values).maxCoeff(), 0.0);
  EXPECT_GE((above - values).minCoeff(), 0.0);
  for (std::size_t v = 0; v < neighbours.size(); ++v) {
    const auto i = static_cast<Eigen::Index>(v);
    // Tight: no vertex can be raised without breaking its own value or the slope to a neighbour.
    double highest = values[i];
    for (const int w : neighbours[v]) {
      const double length = (mesh.vertices.row(i) - mesh.vertices.row(w)).norm();
      EXPECT_LE(std::abs(below[i] - below[w]), length + 1e-14);
      EXPECT_LE(std::abs(above[i] - above[w]), length + 1e-14);
      highest = std::min(highest, below[w] + length);
    }
    EXPECT_NEAR(below[i], highest, 1e-14);
  }
}

} // namespace
} // namespace massprops::testing
