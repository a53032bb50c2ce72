// The cavity's triangles where parts stay solid.
#include "core/reduced/cavity.h"

#include "core/mesh/components.h"
#include "judge/checks.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace massprops::testing {
namespace {

CavitySurface cavityOf(const TriangleMesh& mesh, const std::vector<char>& solid) {
  return cavitySurface(mesh.vertices, mesh.faces, vertexCorners(mesh.vertices.rows(), mesh.faces),
                       solid);
}

TEST(CavitySurface, IsTheWholeSurfaceWhereNothingIsSolid) {
  const TriangleMesh mesh = blob(5);
  const std::vector<char> none(static_cast<std::size_t>(mesh.vertices.rows()), 0);
  const CavitySurface cavity = cavityOf(mesh, none);
  EXPECT_EQ(cavity.faces, mesh.faces);
  EXPECT_EQ(cavity.solid, none);
}

TEST(CavitySurface, IsEmptyWhereEverythingIsSolid) {
  const TriangleMesh mesh = blob(5);
  const std::vector<char> all(static_cast<std::size_t>(mesh.vertices.rows()), 1);
  EXPECT_EQ(cavityOf(mesh, all).faces.rows(), 0);
}

/// What is left of the vertices that the faces use, as a mesh.
TriangleMesh used(const Points& vertices, const Faces& faces) {
  std::vector<int> index(static_cast<std::size_t>(vertices.rows()), -1);
  std::vector<int> kept;
  TriangleMesh mesh;
  mesh.faces = faces;
  for (Eigen::Index i = 0; i < mesh.faces.size(); ++i) {
    int& v = mesh.faces.data()[i];
    int& at = index[static_cast<std::size_t>(v)];
    if (at < 0) {
      at = static_cast<int>(kept.size());
      kept.push_back(v);
    }
    v = at;
  }
  mesh.vertices.resize(static_cast<Eigen::Index>(kept.size()), 3);
  for (std::size_t i = 0; i < kept.size(); ++i)
    mesh.vertices.row(static_cast<Eigen::Index>(i)) = vertices.row(kept[i]);
  return mesh;
}

TEST(CavitySurface, IsClosedByCapsWhereTheSolidPartsBegin) {
  // Solid at random, at one end, and in a belt that cuts the cavity in two.
  const TriangleMesh mesh = ellipsoid({1, 1, 3}, 10);
  for (int kind = 0; kind < 3; ++kind) {
    std::vector<char> solid(static_cast<std::size_t>(mesh.vertices.rows()), 0);
    Random random(61);
    for (std::size_t v = 0; v < solid.size(); ++v) {
      const double z = mesh.vertices(static_cast<Eigen::Index>(v), 2);
      const bool marked = kind == 0 ? random() > 0.9 : kind == 1 ? z > 1.5 : std::abs(z) < 0.5;
      solid[v] = marked ? 1 : 0;
    }
    const CavitySurface cavity = cavityOf(mesh, solid);
    ASSERT_GT(cavity.faces.rows(), 0) << kind;
    const TriangleMesh surface = used(mesh.vertices, cavity.faces);
    EXPECT_TRUE(isClosedAndOriented(surface)) << kind;
    EXPECT_GT(quadratureMoments(surface)[0], 0.0) << kind;
    for (std::size_t v = 0; v < solid.size(); ++v) {
      EXPECT_GE(cavity.solid[v], solid[v]); // solid stays solid
    }
    for (Eigen::Index i = 0; i < cavity.faces.size(); ++i) {
      EXPECT_EQ(cavity.solid[static_cast<std::size_t>(cavity.faces.data()[i])], 0);
    }
    if (kind == 2) {
      EXPECT_EQ(eulerCharacteristic(surface), 4); // two spheres
    }
  }
}

} // namespace
} // namespace massprops::testing
