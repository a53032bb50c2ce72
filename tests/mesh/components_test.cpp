// The connected parts of a surface, counted and taken apart.
#include "core/mesh/components.h"

#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <vector>

namespace massprops::testing {
namespace {

/// Bodies of different sizes in a row; face i comes before face j of a later round, so that the
/// numbers of all components alternate.
TriangleMesh dealt(int count) {
  std::vector<TriangleMesh> bodies;
  for (int i = 0; i < count; ++i) {
    bodies.push_back(transformed(sphere(1 + i % 3), Mat3::Identity(), {3.0 * i, 0, 0}));
  }
  TriangleMesh all;
  Eigen::Index vertices = 0;
  Eigen::Index faces = 0;
  for (const TriangleMesh& body : bodies) {
    vertices += body.vertices.rows();
    faces += body.faces.rows();
  }
  all.vertices.resize(vertices, 3);
  all.faces.resize(faces, 3);
  vertices = 0;
  std::vector<int> first;
  for (const TriangleMesh& body : bodies) {
    all.vertices.middleRows(vertices, body.vertices.rows()) = body.vertices;
    first.push_back(static_cast<int>(vertices));
    vertices += body.vertices.rows();
  }
  Eigen::Index row = 0;
  for (Eigen::Index f = 0; row < faces; ++f) {
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      if (f >= bodies[i].faces.rows()) continue;
      all.faces.row(row++) = bodies[i].faces.row(f).array() + first[i];
    }
  }
  return all;
}

TEST(Components, AreNumberedByTheirFirstFaces) {
  TriangleMesh mesh = dealt(5);
  const Eigen::Index n = mesh.vertices.rows();
  const std::vector<int> numbers = componentNumbers(n + 1, mesh.faces);
  ASSERT_EQ(numbers.size(), static_cast<std::size_t>(n) + 1);
  EXPECT_EQ(numbers.back(), -1) << "no face uses it";
  for (Eigen::Index v = 0; v < n; ++v) {
    EXPECT_EQ(numbers[static_cast<std::size_t>(v)],
              static_cast<int>(std::lround(mesh.vertices(v, 0) / 3.0)));
  }
  mesh.faces.row(0).swap(mesh.faces.row(3));
  EXPECT_EQ(componentNumbers(n, mesh.faces)[0], 3);
}

TEST(Components, AsMeshesAreTheSubmeshesOfTheirFaces) {
  const TriangleMesh mesh = dealt(7);
  const Components parts = connectedComponents(mesh.vertices.rows(), mesh.faces);
  const std::vector<Submesh> meshes = componentMeshes(mesh.vertices, mesh.faces);
  ASSERT_EQ(meshes.size(), parts.size());
  for (std::size_t c = 0; c < parts.size(); ++c) {
    const Submesh expected = submesh(mesh.vertices, parts[c]);
    EXPECT_EQ(meshes[c].vertexOf, expected.vertexOf);
    EXPECT_EQ(meshes[c].mesh.vertices, expected.mesh.vertices);
    EXPECT_EQ(meshes[c].mesh.faces, expected.mesh.faces);
  }
}

} // namespace
} // namespace massprops::testing
