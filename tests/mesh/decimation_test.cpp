// A decimated surface keeps the topology, about the shape, and depends on no number of threads.
#include "core/mesh/decimation.h"

#include "core/mesh/components.h"
#include "core/physics/moments.h"
#include "judge/checks.h"
#include "shapes.h"
#include "thread_count.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace massprops::testing {
namespace {

Eigen::Index eulerCharacteristic(const TriangleMesh& mesh) {
  return mesh.vertices.rows() - mesh.faces.rows() / 2; // closed: 3 faces have 2 edges each
}

TEST(DecimatedMesh, HasTheSizeAskedForAndTheTopologyOfTheSurface) {
  for (const TriangleMesh& mesh :
       {sphere(40), torus(1, 0.3, 120, 60),
        joined(sphere(20), transformed(sphere(20), Mat3::Identity(), {3, 0, 0}))}) {
    const DecimatedMesh coarse = decimated(mesh.vertices, mesh.faces, {600, 600, 0.0});
    EXPECT_EQ(coarse.mesh.vertices.rows(), 600);
    EXPECT_TRUE(isClosedAndOriented(coarse.mesh));
    EXPECT_EQ(eulerCharacteristic(coarse.mesh), eulerCharacteristic(mesh));
    EXPECT_EQ(connectedComponents(600, coarse.mesh.faces).size(),
              connectedComponents(mesh.vertices.rows(), mesh.faces).size());
  }
}

TEST(DecimatedMesh, IsTheSurfaceItselfWhereThatIsCoarse) {
  const TriangleMesh mesh = blob(8);
  const DecimatedMesh coarse = decimated(mesh.vertices, mesh.faces, {600, 600, 0.0});
  EXPECT_EQ(coarse.mesh.vertices, mesh.vertices);
  EXPECT_TRUE(coarse.isWhole());
}

TEST(DecimatedMesh, HasVerticesOfTheSurfaceAndNearlyItsVolume) {
  const TriangleMesh mesh = blob(40);
  const DecimatedMesh copy = decimated(mesh.vertices, mesh.faces, {1000, 1000, 0.0});
  ASSERT_EQ(copy.vertexFor.size(), static_cast<std::size_t>(mesh.vertices.rows()));
  for (std::size_t i = 0; i < copy.vertexOf.size(); ++i) {
    EXPECT_EQ(copy.mesh.vertices.row(static_cast<Eigen::Index>(i)),
              mesh.vertices.row(copy.vertexOf[i]));
    EXPECT_EQ(copy.vertexFor[static_cast<std::size_t>(copy.vertexOf[i])], static_cast<int>(i));
  }
  // A vertex falls together with one that is a few edges of the copy away at most.
  for (std::size_t v = 0; v < copy.vertexFor.size(); ++v) {
    EXPECT_LT((copy.mesh.vertices.row(copy.vertexFor[v]) -
               mesh.vertices.row(static_cast<Eigen::Index>(v)))
                  .norm(),
              0.5);
  }
  // Edges of length 0.13 on curvatures of about 1 cut off 1/8·0.13² of the radius.
  EXPECT_NEAR(moments(copy.mesh.vertices, copy.mesh.faces)[0] /
                  moments(mesh.vertices, mesh.faces)[0],
              1.0, 0.01);
}

TEST(DecimatedMesh, IsAsCoarseAsTheDistanceAllows) {
  const auto sizeOf = [](const TriangleMesh& mesh, double distance) {
    return decimated(mesh.vertices, mesh.faces, {4000, 300, distance}).mesh.vertices.rows();
  };
  // The sides of a box lose nothing.
  EXPECT_EQ(sizeOf(box({1, 1, 1}, 40), 1e-9), 300);
  // On a ball the distance goes with the square of the edges, that is, inversely with their number.
  const TriangleMesh ball = sphere(40);
  const auto fine = static_cast<double>(sizeOf(ball, 1e-3));
  const auto coarse = static_cast<double>(sizeOf(ball, 4e-3));
  EXPECT_LT(fine, 4000);
  EXPECT_GT(coarse, 300);
  EXPECT_NEAR(fine / coarse, 4.0, 1.0);
}

TEST(DecimatedMesh, IsTheSameWithAnyNumberOfThreads) {
  // Numbered along the ring, so that both halves are thinned out at once.
  const TriangleMesh ring = torus(2, 0.5, 400, 100);
  const auto copy = [&](int threads) {
    const ThreadCount count(threads);
    return decimated(ring.vertices, ring.faces, {1500, 1500, 0.0});
  };
  const DecimatedMesh one = copy(1);
  EXPECT_EQ(one.mesh.vertices.rows(), 1500);
  EXPECT_TRUE(isClosedAndOriented(one.mesh));
  EXPECT_EQ(eulerCharacteristic(one.mesh), 0);
  for (const int threads : {2, 4}) {
    const DecimatedMesh other = copy(threads);
    EXPECT_EQ(one.mesh.faces, other.mesh.faces);
    EXPECT_EQ(one.vertexOf, other.vertexOf);
  }
}

TEST(DecimatedMesh, HasTheSizeAskedForWhateverTheNumbersOfTheVertices) {
  // Every vertex has neighbours in the other half.
  TriangleMesh ring = torus(2, 0.5, 400, 100);
  const auto n = static_cast<int>(ring.vertices.rows());
  const auto number = [&](int v) { return v % 2 * (n / 2) + v / 2; };
  const Points before = ring.vertices;
  for (int v = 0; v < n; ++v) ring.vertices.row(number(v)) = before.row(v);
  ring.faces = ring.faces.unaryExpr(number).eval();
  const DecimatedMesh copy = decimated(ring.vertices, ring.faces, {1500, 1500, 0.0});
  EXPECT_EQ(copy.mesh.vertices.rows(), 1500);
  EXPECT_EQ(eulerCharacteristic(copy.mesh), 0);
}

TEST(DecimatedMesh, HasFewSliversAlsoOfVeryFineSurfaces) {
  const TriangleMesh fine = blob(150); // 225,000 vertices
  const TriangleMesh copy = decimated(fine.vertices, fine.faces, {3000, 3000, 0.0}).mesh;
  EXPECT_EQ(copy.vertices.rows(), 3000);
  Eigen::Index slivers = 0;
  for (Eigen::Index f = 0; f < copy.faces.rows(); ++f) {
    const auto edge = [&](int k) {
      return Vec3(
          (copy.vertices.row(copy.faces(f, (k + 1) % 3)) - copy.vertices.row(copy.faces(f, k)))
              .transpose());
    };
    const double longest =
        std::max({edge(0).squaredNorm(), edge(1).squaredNorm(), edge(2).squaredNorm()});
    slivers += edge(0).cross(edge(1)).norm() < 0.2 * longest ? 1 : 0;
  }
  EXPECT_LE(slivers, copy.faces.rows() / 50);
}

} // namespace
} // namespace massprops::testing
