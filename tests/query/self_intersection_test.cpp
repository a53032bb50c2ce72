// Crossings of a surface with itself, against all pairs by other code.
#include "core/query/self_intersection.h"

#include "core/base/angles.h"
#include "judge/checks.h"
#include "shapes.h"

#include <Eigen/Geometry>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace massprops::testing {
namespace {

TEST(SelfIntersectingFaces, AgreeWithTheCheckPairByPair) {
  EXPECT_TRUE(selfIntersectingFaces(blob(6).vertices, blob(6).faces).empty());
  TriangleMesh pierced = sphere(5);
  pierced.vertices.row(0) *= -1.5;
  EXPECT_FALSE(selfIntersectingFaces(pierced.vertices, pierced.faces).empty());
  EXPECT_GT(intersectingPairs(pierced), 0U);
}

TEST(SelfIntersectingFaces, AreNoneWhereThereAreNoFaces) {
  EXPECT_TRUE(selfIntersectingFaces(Points(0, 3), Faces(0, 3)).empty());
}

TEST(SelfIntersectingFaces, AreFoundBesideFacesWithoutArea) {
  // A face's edge is broken at its middle, with a flat face in between; then two bodies overlap.
  TriangleMesh mesh = box({1, 1, 1}, 2);
  const Eigen::RowVector3i old = mesh.faces.row(0);
  const int middle = static_cast<int>(mesh.vertices.rows());
  mesh.vertices.conservativeResize(middle + 1, 3);
  mesh.vertices.row(middle) = 0.5 * (mesh.vertices.row(old[0]) + mesh.vertices.row(old[1]));
  const Eigen::Index count = mesh.faces.rows();
  mesh.faces.conservativeResize(count + 2, 3);
  mesh.faces.row(0) << old[0], middle, old[2];
  mesh.faces.row(count) << middle, old[1], old[2];
  mesh.faces.row(count + 1) << old[0], old[1], middle;
  EXPECT_EQ(facesWithoutArea(mesh), 1U);
  const std::size_t atTheFlatFace = selfIntersectingFaces(mesh.vertices, mesh.faces).size();
  const TriangleMesh two = joined(mesh, transformed(mesh, Mat3::Identity(), {0.5, 0.1, 0.2}));
  EXPECT_GT(selfIntersectingFaces(two.vertices, two.faces).size(), 2 * atTheFlatFace + 8);
}

TEST(SelfIntersectingFaces, AreThoseThatAllPairsHaveAlsoOnWrinkledSurfaces) {
  // From smooth, where whole patches are proved at once, to crumpled, where nearly none is.
  int crossingOnes = 0;
  for (const double wrinkle : {0.0, 0.02, 0.05, 0.08, 0.15, 0.3}) {
    for (std::uint32_t seed = 1; seed <= 4; ++seed) {
      const TriangleMesh mesh = jittered(blob(10), wrinkle, seed);
      const bool crosses = intersectingPairs(mesh) > 0;
      EXPECT_EQ(!selfIntersectingFaces(mesh.vertices, mesh.faces).empty(), crosses) << wrinkle;
      crossingOnes += crosses ? 1 : 0;
    }
  }
  EXPECT_GT(crossingOnes, 4);
  EXPECT_LT(crossingOnes, 20);
}

TEST(SelfIntersectingFaces, AreTheSameWithTheTreeOfASimilarSurface) {
  // Turned, scaled, rounded coarsely and in another order: what crosses by less than was rounded
  // lies apart there.
  const TriangleMesh two =
      joined(blob(10), transformed(blob(10), Mat3::Identity(), {1.98, 0.1, 0.2}));
  const std::vector<int> expected = selfIntersectingFaces(two.vertices, two.faces);
  EXPECT_GT(expected.size(), 8U);
  const Mat3 turn = Eigen::AngleAxisd(1.0, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  const std::vector<int> order = spatialOrder(two.vertices, two.faces);
  TriangleMesh other = transformed(two, 0.1 * turn, {3, 4, 5});
  constexpr double kGrid = 0.01;
  other.vertices = (other.vertices / kGrid).array().round() * kGrid;
  for (Eigen::Index f = 0; f < other.faces.rows(); ++f)
    other.faces.row(f) = two.faces.row(order[static_cast<std::size_t>(f)]);
  const TriangleTree tree(other.vertices, other.faces, TriangleTree::Order::Spatial);
  EXPECT_EQ(selfIntersectingFaces(two.vertices, two.faces, tree, {order, std::sqrt(3.0) * kGrid}),
            expected);
  EXPECT_NE(selfIntersectingFaces(two.vertices, two.faces, tree, {order, -kGrid}), expected)
      << "or it would not matter how far they are apart";
}

TEST(SelfIntersectingFaces, AreFoundAtVerticesWhereTwoFansMeet) {
  // Cones that share their tip: apart, and one turned into the other.
  for (const double lean : {0.0, 2.6}) {
    TriangleMesh mesh;
    constexpr int kSides = 8;
    mesh.vertices = Points::Zero(1 + 2 * kSides, 3);
    mesh.faces.resize(2 * kSides, 3);
    const Mat3 turn = Eigen::AngleAxisd(lean, Vec3::UnitX()).toRotationMatrix();
    for (int i = 0; i < kSides; ++i) {
      const double angle = 2.0 * kPi * i / kSides;
      const Vec3 rim(0.5 * std::cos(angle), 0.5 * std::sin(angle), 1.0);
      mesh.vertices.row(1 + i) = rim.transpose();
      mesh.vertices.row(1 + kSides + i) = -(turn * rim).transpose();
      mesh.faces.row(i) << 0, 1 + i, 1 + (i + 1) % kSides;
      mesh.faces.row(kSides + i) << 0, 1 + kSides + i, 1 + kSides + (i + 1) % kSides;
    }
    EXPECT_EQ(selfIntersectingFaces(mesh.vertices, mesh.faces).empty(), lean == 0.0);
    EXPECT_EQ(intersectingPairs(mesh) == 0, lean == 0.0);
  }
}

TEST(SelfIntersectingFaces, AreFoundWhereDistantPartsMeet) {
  // Two lobes whose tips reach into each other: each patch by itself is smooth.
  const TriangleMesh horseshoe = sphere(30);
  for (const double gap : {0.05, -0.05}) {
    TriangleMesh bent = horseshoe;
    for (Eigen::Index v = 0; v < bent.vertices.rows(); ++v) {
      // A long ellipsoid wound around the z axis, its ends `gap` apart.
      const double angle = (kPi - 0.5 * gap) * bent.vertices(v, 0);
      const double radius = 1.0 + 0.3 * bent.vertices(v, 1);
      bent.vertices.row(v) << radius * std::cos(angle), radius * std::sin(angle),
          0.3 * bent.vertices(v, 2);
    }
    EXPECT_EQ(selfIntersectingFaces(bent.vertices, bent.faces).empty(), gap > 0.0);
    EXPECT_EQ(intersectingPairs(bent) == 0, gap > 0.0);
  }
}

} // namespace
} // namespace massprops::testing
