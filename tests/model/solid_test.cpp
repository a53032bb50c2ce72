// What counts as a solid, and what is said about what does not.
#include "core/model/solid.h"

#include "core/physics/moments.h"
#include "judge/checks.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace massprops::testing {
namespace {

TriangleMesh withoutLastFace(TriangleMesh mesh) {
  mesh.faces.conservativeResize(mesh.faces.rows() - 1, 3);
  return mesh;
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

/// Like `mesh`, with the middle of its first edge as a further vertex: of the faces there the first
/// gets a second, flat one with corners in a line (a cap), so that the surface stays closed.
TriangleMesh withACap(TriangleMesh mesh) {
  const int a = mesh.faces(0, 0);
  const int b = mesh.faces(0, 1);
  const int c = mesh.faces(0, 2);
  const auto m = static_cast<int>(mesh.vertices.rows());
  mesh.vertices.conservativeResize(m + 1, 3);
  mesh.vertices.row(m) = 0.5 * (mesh.vertices.row(a) + mesh.vertices.row(b));
  const Eigen::Index n = mesh.faces.rows();
  mesh.faces.conservativeResize(n + 2, 3);
  mesh.faces.row(0) << a, m, c;
  mesh.faces.row(n) << m, b, c;
  mesh.faces.row(n + 1) << a, b, m;
  return mesh;
}

/// Like `mesh`, with its first edge cut open and closed by two faces whose third corner lies on
/// their first (needles).
TriangleMesh withNeedles(TriangleMesh mesh) {
  const int a = mesh.faces(0, 0);
  const int b = mesh.faces(0, 1);
  const int c = mesh.faces(0, 2);
  const auto twin = static_cast<int>(mesh.vertices.rows());
  mesh.vertices.conservativeResize(twin + 1, 3);
  mesh.vertices.row(twin) = mesh.vertices.row(a);
  // The first face uses the twin; between it and its neighbours at a lie the needles.
  mesh.faces(0, 0) = twin;
  const Eigen::Index n = mesh.faces.rows();
  mesh.faces.conservativeResize(n + 2, 3);
  mesh.faces.row(n) << a, b, twin;
  mesh.faces.row(n + 1) << a, twin, c;
  return mesh;
}

TriangleMesh withFaces(TriangleMesh mesh, const std::vector<Eigen::RowVector3i>& more) {
  for (const Eigen::RowVector3i& face : more) {
    mesh.faces.conservativeResize(mesh.faces.rows() + 1, 3);
    mesh.faces.bottomRows(1) = face;
  }
  return mesh;
}

/// A cavity or a body in it: `scale` times as large, seen from the other side when `inwards`.
TriangleMesh nested(const TriangleMesh& mesh, double scale, bool inwards) {
  return inwards ? reversed(scaled(mesh, scale)) : scaled(mesh, scale);
}

double volumeOf(const Points& vertices, const Faces& faces) {
  return moments(vertices.rowwise() - vertices.row(0), faces)[0];
}

/// A solid like that of `clean`, and what was done to get it.
void expectMended(const TriangleMesh& input, const TriangleMesh& clean,
                  const std::string& reported) {
  const Solid solid = makeSolid(input);
  EXPECT_EQ(solid.repairs().describe(), reported);
  EXPECT_TRUE(isClosedAndOriented({solid.vertices(), solid.faces()}));
  EXPECT_EQ(intersectingPairs({solid.vertices(), solid.faces()}), 0U);
  const double volume = volumeOf(clean.vertices, clean.faces);
  EXPECT_NEAR(volumeOf(solid.vertices(), solid.faces()), volume, 1e-12 * volume);
}

/// The refusal names what is wrong and what to do, with all of `words`.
void expectRefusal(const TriangleMesh& mesh, const std::vector<std::string>& words) {
  try {
    requireNoCrossings(makeSolid(mesh));
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
    EXPECT_EQ(solid.repairs().describe(), "none");
    EXPECT_EQ(solid.cavities().faces.rows(), 0);
  }
}

TEST(MakeSolid, MeasuresTheDiagonal) {
  EXPECT_NEAR(makeSolid(box({2, 3, 6}, 1)).diagonal(), 7.0, 1e-14);
}

// ---------------------------------------------------------------- what is mended

TEST(MakeSolid, TurnsASurfaceThatFacesInwards) {
  const TriangleMesh mesh = transformed(blob(5), Mat3::Identity(), {100, 200, 300});
  expectMended(reversed(mesh), mesh, "1 component flipped");
}

TEST(MakeSolid, TurnsOnlyTheComponentsThatFaceInwards) {
  const TriangleMesh other = transformed(blob(3), Mat3::Identity(), {5, 0, 0});
  expectMended(joined(blob(4), reversed(other)), joined(blob(4), other), "1 component flipped");
}

TEST(MakeSolid, LeavesOutVerticesThatNoFaceUses) {
  TriangleMesh mesh = box({1, 1, 1}, 2);
  const Eigen::Index n = mesh.vertices.rows();
  mesh.vertices.conservativeResize(n + 2, 3);
  mesh.vertices.bottomRows(2) << 9, 9, 9, -9, 9, 9;
  expectMended(mesh, box({1, 1, 1}, 2), "2 unused vertices left out");
  EXPECT_EQ(makeSolid(mesh).vertices().rows(), n);
  EXPECT_NEAR(makeSolid(mesh).diagonal(), std::sqrt(3.0), 1e-14);
}

TEST(MakeSolid, WeldsTheTrianglesOfAnStl) {
  const TriangleMesh mesh = box({1, 1, 1}, 2); // 26 vertices, 48 faces
  expectMended(unwelded(mesh), mesh, "118 duplicate vertices merged");
  EXPECT_EQ(makeSolid(unwelded(mesh)).vertices().rows(), 26);
}

TEST(MakeSolid, WeldsSeveralBodies) {
  const TriangleMesh mesh =
      joined(blob(3), transformed(blob(3), Mat3::Identity(), {5, 0, 0})); // 92 vertices each
  const Solid solid = makeSolid(unwelded(mesh));
  EXPECT_EQ(solid.vertices().rows(), 2 * 92);
  EXPECT_EQ(solid.faces().rows(), mesh.faces.rows());
}

TEST(MakeSolid, RemovesFacesWithACornerTwice) {
  const TriangleMesh mesh = blob(3);
  expectMended(withFaces(mesh, {{3, 4, 4}, {5, 5, 5}}), mesh, "2 faces without area removed");
}

TEST(MakeSolid, RemovesCapsAndNeedles) {
  expectMended(withACap(box({1, 1, 1}, 2)), box({1, 1, 1}, 2), "1 face without area removed");
  expectMended(withNeedles(box({1, 1, 1}, 2)), box({1, 1, 1}, 2), "2 faces without area removed");
}

TEST(MakeSolid, RemovesFacesThatAreThereTwice) {
  const TriangleMesh mesh = blob(3);
  const Eigen::RowVector3i turned(mesh.faces(7, 1), mesh.faces(7, 2), mesh.faces(7, 0));
  expectMended(withFaces(mesh, {mesh.faces.row(2), turned}), mesh, "2 duplicate faces removed");
}

TEST(MakeSolid, AcceptsSeveralBodies) {
  const TriangleMesh two = joined(blob(3), transformed(blob(2), Mat3::Identity(), {5, 0, 0}));
  const TriangleMesh three =
      joined(two, transformed(torus(2, 0.5, 12, 8), Mat3::Identity(), {0, 9, 0}));
  for (const TriangleMesh& mesh : {two, three}) expectMended(mesh, mesh, "none");
}

TEST(MakeSolid, SetsExistingCavitiesAside) {
  const TriangleMesh body = blob(4);
  for (const bool inwards : {true, false}) {
    const Solid solid = makeSolid(joined(body, nested(body, 0.5, inwards)));
    EXPECT_EQ(solid.faces(), body.faces);
    EXPECT_EQ(solid.repairs().replacedCavities, 1);
    EXPECT_EQ(solid.repairs().flippedComponents, inwards ? 0 : 1);
    EXPECT_NEAR(volumeOf(solid.cavities().vertices, solid.cavities().faces),
                -volumeOf(body.vertices, body.faces) / 8, 1e-12);
  }
}

TEST(MakeSolid, OrdersTheFacesInSpaceAsInTheTurnedFrame) {
  const TriangleMesh body = blob(4);
  const TriangleMesh two = joined(body, transformed(blob(2), Mat3::Identity(), {5, 0, 0}));
  Mat3 turn;
  turn << 1, 0, 0, 0, -1, 0, 0, 0, -1;
  for (const TriangleMesh& mesh : {body, two}) {
    const std::vector<int> order = makeSolid(mesh).spatialFaceOrder();
    std::vector<int> sorted = order;
    std::sort(sorted.begin(), sorted.end());
    ASSERT_EQ(static_cast<Eigen::Index>(sorted.size()), mesh.faces.rows());
    for (std::size_t f = 0; f < sorted.size(); ++f) EXPECT_EQ(sorted[f], static_cast<int>(f));
    const TriangleMesh turned = transformed(mesh, turn.transpose(), {1, 2, 3});
    EXPECT_EQ(makeSolid(turned, false, turn).spatialFaceOrder(), order);
    EXPECT_NE(makeSolid(turned).spatialFaceOrder(), order);
  }
  // A cavity does not show.
  EXPECT_EQ(makeSolid(joined(body, nested(body, 0.5, true))).spatialFaceOrder(),
            makeSolid(body).spatialFaceOrder());
}

TEST(MakeSolid, WorksInAnySizeAndPlace) {
  for (const double size : {1e-6, 1e6}) {
    const TriangleMesh mesh = scaled(blob(4), size);
    expectMended(mesh, mesh, "none");
    EXPECT_NEAR(makeSolid(mesh).diagonal(), size * makeSolid(blob(4)).diagonal(), 1e-12 * size);
  }
  const TriangleMesh far = transformed(blob(4), Mat3::Identity(), {1e6, -2e6, 3e6});
  expectMended(far, far, "none");
}

// ---------------------------------------------------------------- what is refused

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

TEST(MakeSolid, RefusesOneTriangle) {
  TriangleMesh mesh;
  mesh.vertices.resize(3, 3);
  mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0;
  mesh.faces.resize(1, 3);
  mesh.faces << 0, 1, 2;
  expectRefusal(mesh, {"open", "3 boundary edges", "Close Holes"});
}

TEST(MakeSolid, RefusesTrianglesThatLieBackToBack) {
  TriangleMesh mesh;
  mesh.vertices.resize(3, 3);
  mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0;
  mesh.faces.resize(2, 3);
  mesh.faces << 0, 1, 2, 0, 2, 1;
  expectRefusal(mesh, {"without area"});
}

TEST(MakeSolid, RefusesInfiniteCoordinates) {
  TriangleMesh mesh = blob(3);
  mesh.vertices(5, 1) = -std::numeric_limits<double>::infinity();
  expectRefusal(mesh, {"not finite"});
}

TEST(MakeSolid, RefusesNegativeIndices) {
  TriangleMesh mesh = blob(3);
  mesh.faces(4, 1) = -1;
  expectRefusal(mesh, {"do not exist"});
}

TEST(MakeSolid, RefusesAHoleAndCountsItsEdges) {
  expectRefusal(withoutLastFace(blob(3)), {"open", "3 boundary edges", "Close Holes"});
}

TEST(MakeSolid, NamesMergingFirstWhereTheSurfaceIsAlmostWelded) {
  TriangleMesh mesh = unwelded(box({1, 1, 1}, 1));
  mesh.vertices = jittered(mesh, 1e-9, 3).vertices;
  expectRefusal(mesh, {"36 boundary edges", "Merge Close Vertices"});
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

TEST(MakeSolid, RefusesASurfaceThatCrossesItself) {
  expectRefusal(joined(blob(3), transformed(blob(3), Mat3::Identity(), {0.9, 0.1, 0})),
                {"crosses itself", "Select Self Intersecting Faces", "Mesh Boolean: Union"});
}

TEST(MakeSolid, LeavesTheCrossingsOfASingleClosedSurfaceForLater) {
  const auto refuses = [](const auto& step) {
    try {
      step();
    } catch (const InvalidInput& e) {
      return std::string(e.what()).find("crosses itself") != std::string::npos;
    }
    return false;
  };
  TriangleMesh crossing = box({1, 1, 1}, 4);
  for (Eigen::Index v = 0; v < crossing.vertices.rows(); ++v) {
    if (crossing.vertices.row(v) == Eigen::RowVector3d(0, 0, 0.5))
      crossing.vertices.row(v) << 0.8, 0.1, 0;
  }
  const Solid unchecked = makeSolid(crossing);
  EXPECT_TRUE(refuses([&] { requireNoCrossings(unchecked); }));
  EXPECT_NO_THROW(requireNoCrossings(makeSolid(box({1, 1, 1}, 4))));
  // Several bodies cannot wait: which one is inside of which has to be known.
  const TriangleMesh two = joined(blob(3), transformed(blob(3), Mat3::Identity(), {0.9, 0.1, 0}));
  EXPECT_TRUE(refuses([&] { makeSolid(two); }));
}

TEST(MakeSolid, RefusesBodiesThatLieExactlyOnEachOther) {
  expectRefusal(joined(blob(3), blob(3)), {"crosses itself"});
}

TEST(MakeSolid, RefusesALoosePartInsideOfACavity) {
  const TriangleMesh body = blob(4);
  expectRefusal(joined(joined(body, nested(body, 0.8, true)), nested(body, 0.5, false)),
                {"loose inside of a cavity", "Split in Connected Components"});
}

TEST(MakeSolid, RefusesASurfaceWithoutVolume) {
  expectRefusal(transformed(blob(3), Vec3(1, 1, 0).asDiagonal()), {"no volume"});
}

} // namespace
} // namespace massprops::testing
