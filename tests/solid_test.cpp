// What counts as a solid, and what is said about what does not.
#include "core/solid.h"

#include "core/moments.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace massprops::testing {
namespace {

TriangleMesh withoutLastFace(TriangleMesh mesh) {
  mesh.faces.conservativeResize(mesh.faces.rows() - 1, 3);
  return mesh;
}

/// Every triangle with corners of its own, as STL files store them.
TriangleMesh unwelded(const TriangleMesh& mesh) {
  TriangleMesh result;
  result.vertices.resize(mesh.faces.size(), 3);
  result.faces.resize(mesh.faces.rows(), 3);
  for (Eigen::Index i = 0; i < mesh.faces.size(); ++i) {
    result.vertices.row(i) = mesh.vertices.row(mesh.faces.data()[i]);
    result.faces.data()[i] = static_cast<int>(i);
  }
  return result;
}

/// Two tetrahedra that share `shared` vertices.
TriangleMesh touchingTetrahedra(int shared) {
  const TriangleMesh a = tetrahedron({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  const TriangleMesh b = shared == 1 ? tetrahedron({0, 0, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1})
                                     : tetrahedron({0, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 0, -1});
  TriangleMesh both = joined(a, b);
  for (Eigen::Index i = 0; i < both.faces.size(); ++i) {
    int& v = both.faces.data()[i];
    if (v >= 4 && v < 4 + shared) v -= 4;
  }
  return both;
}

/// The refusal names what is wrong and what to do, with all of `words`.
void expectRefusal(const TriangleMesh& mesh, const std::vector<std::string>& words) {
  try {
    makeSolid(mesh);
    FAIL() << "accepted; expected a refusal with: " << words.front();
  } catch (const InvalidInput& e) {
    const std::string message = e.what();
    for (const std::string& word : words) {
      EXPECT_NE(message.find(word), std::string::npos) << "“" << word << "” not in: " << message;
    }
    EXPECT_EQ(message.back(), '.') << message;
  }
}

TEST(MakeSolid, AcceptsClosedSurfacesOfAnyGenus) {
  for (const TriangleMesh& mesh : {box({1, 2, 3}, 3), blob(6), torus(2, 0.5, 12, 8), figure(2)}) {
    const Solid solid = makeSolid(mesh);
    EXPECT_EQ(solid.vertices().rows(), mesh.vertices.rows());
    EXPECT_EQ(solid.faces(), mesh.faces);
    EXPECT_FALSE(solid.wasInverted());
  }
}

TEST(MakeSolid, MeasuresTheDiagonal) {
  EXPECT_NEAR(makeSolid(box({2, 3, 6}, 1)).diagonal(), 7.0, 1e-14);
}

TEST(MakeSolid, TurnsASurfaceThatFacesInwards) {
  const TriangleMesh mesh = transformed(blob(5), Mat3::Identity(), {100, 200, 300});
  const Solid solid = makeSolid(reversed(mesh));
  EXPECT_TRUE(solid.wasInverted());
  const Points centred = solid.vertices().rowwise() - solid.vertices().row(0);
  EXPECT_GT(moments(centred, solid.faces())[0], 0.0);
}

TEST(MakeSolid, LeavesOutVerticesThatNoFaceUses) {
  TriangleMesh mesh = box({1, 1, 1}, 2);
  const Eigen::Index n = mesh.vertices.rows();
  mesh.vertices.conservativeResize(n + 2, 3);
  mesh.vertices.bottomRows(2) << 9, 9, 9, -9, 9, 9;
  const Solid solid = makeSolid(mesh);
  EXPECT_EQ(solid.vertices().rows(), n);
  EXPECT_NEAR(solid.diagonal(), std::sqrt(3.0), 1e-14);
}

TEST(MakeSolid, RefusesAnEmptyLayer) {
  expectRefusal(TriangleMesh{}, {"empty"});
}

TEST(MakeSolid, RefusesPointsWithoutFaces) {
  TriangleMesh points;
  points.vertices = blob(3).vertices;
  expectRefusal(points, {"no faces", "Screened Poisson"});
}

TEST(MakeSolid, RefusesCoordinatesThatAreNoNumbers) {
  TriangleMesh mesh = blob(3);
  mesh.vertices(5, 1) = std::numeric_limits<double>::quiet_NaN();
  expectRefusal(mesh, {"not finite"});
}

TEST(MakeSolid, RefusesIndicesOutOfRange) {
  TriangleMesh mesh = blob(3);
  mesh.faces(0, 0) = static_cast<int>(mesh.vertices.rows());
  expectRefusal(mesh, {"do not exist"});
}

TEST(MakeSolid, RefusesFacesWithACornerTwice) {
  TriangleMesh mesh = blob(3);
  mesh.faces(4, 2) = mesh.faces(4, 1);
  expectRefusal(mesh, {"1 face", "twice", "Remove Zero Area Faces"});
}

TEST(MakeSolid, RefusesAHoleAndCountsItsEdges) {
  expectRefusal(withoutLastFace(blob(3)), {"open", "3 boundary edges", "Close Holes"});
}

TEST(MakeSolid, NamesMergingFirstWhereTheSurfaceIsUnwelded) {
  expectRefusal(unwelded(box({1, 1, 1}, 1)), {"36 boundary edges", "Merge Close Vertices"});
}

TEST(MakeSolid, RefusesEdgesOfMoreThanTwoFaces) {
  expectRefusal(touchingTetrahedra(2), {"1 non-manifold edge ", "Repair non Manifold Edges"});
}

TEST(MakeSolid, RefusesVerticesWhereTwoPartsTouch) {
  expectRefusal(touchingTetrahedra(1), {"1 non-manifold vertex", "Repair non Manifold Vertices"});
}

TEST(MakeSolid, RefusesFacesThatAreOrientedAgainstEachOther) {
  TriangleMesh mesh = blob(3);
  std::swap(mesh.faces(7, 1), mesh.faces(7, 2));
  expectRefusal(mesh, {"3 edges", "Re-Orient all faces"});
}

TEST(MakeSolid, RefusesSeveralComponentsAndCountsThem) {
  const TriangleMesh two = joined(blob(3), transformed(blob(2), Mat3::Identity(), {5, 0, 0}));
  expectRefusal(two, {"2 separate components"});
  expectRefusal(joined(two, transformed(blob(2), Mat3::Identity(), {0, 9, 0})),
                {"3 separate components"});
}

TEST(MakeSolid, RefusesASurfaceWithoutVolume) {
  expectRefusal(transformed(blob(3), Vec3(1, 1, 0).asDiagonal()), {"no volume"});
}

} // namespace
} // namespace massprops::testing
