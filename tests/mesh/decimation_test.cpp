// A coarse copy carries smooth functions, keeps the surface's topology, and nothing depends on the
// number of threads.
#include "core/mesh/decimation.h"

#include "core/base/parallel.h"
#include "core/mesh/components.h"
#include "core/physics/moments.h"
#include "core/pipeline.h"
#include "core/query/self_intersection.h"
#include "judge/checks.h"
#include "shapes.h"
#include "thread_count.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

namespace massprops::testing {
namespace {

Eigen::Index eulerCharacteristic(const TriangleMesh& mesh) {
  return mesh.vertices.rows() - mesh.faces.rows() / 2; // closed: 3 faces have 2 edges each
}

TEST(Proxy, HasTheSizeAskedForAndTheTopologyOfTheSurface) {
  for (const TriangleMesh& mesh :
       {sphere(40), torus(1, 0.3, 120, 60),
        joined(sphere(20), transformed(sphere(20), Mat3::Identity(), {3, 0, 0}))}) {
    const Proxy proxy = makeProxy(mesh.vertices, mesh.faces, {600, 600, 0.0});
    EXPECT_EQ(proxy.mesh.vertices.rows(), 600);
    EXPECT_TRUE(isClosedAndOriented(proxy.mesh));
    EXPECT_EQ(eulerCharacteristic(proxy.mesh), eulerCharacteristic(mesh));
    EXPECT_EQ(connectedComponents(600, proxy.mesh.faces).size(),
              connectedComponents(mesh.vertices.rows(), mesh.faces).size());
  }
}

TEST(Proxy, IsTheSurfaceItselfWhereThatIsCoarse) {
  const TriangleMesh mesh = blob(8);
  const Proxy proxy = makeProxy(mesh.vertices, mesh.faces, {600, 600, 0.0});
  EXPECT_EQ(proxy.mesh.vertices, mesh.vertices);
  EXPECT_TRUE(interpolationFrom(proxy, mesh.vertices).isIdentity());
}

TEST(Proxy, HasVerticesOfTheSurfaceAndNearlyItsVolume) {
  const TriangleMesh mesh = blob(40);
  const CoarseCopy copy = coarseCopy(mesh.vertices, mesh.faces, {1000, 1000, 0.0});
  for (std::size_t i = 0; i < copy.vertexOf.size(); ++i) {
    EXPECT_EQ(copy.mesh.vertices.row(static_cast<Eigen::Index>(i)),
              mesh.vertices.row(copy.vertexOf[i]));
  }
  // Edges of length 0.13 on curvatures of about 1 cut off 1/8·0.13² of the radius.
  EXPECT_NEAR(moments(copy.mesh.vertices, copy.mesh.faces)[0] /
                  moments(mesh.vertices, mesh.faces)[0],
              1.0, 0.01);
}

TEST(CoarseCopy, IsAsCoarseAsTheDistanceAllows) {
  const auto sizeOf = [](const TriangleMesh& mesh, double distance) {
    return coarseCopy(mesh.vertices, mesh.faces, {4000, 300, distance}).mesh.vertices.rows();
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

TEST(CoarseCopy, IsTheSameWithAnyNumberOfThreads) {
  // Numbered along the ring, so that both halves are thinned out at once.
  const TriangleMesh ring = torus(2, 0.5, 400, 100);
  const auto copy = [&](int threads) {
    const ThreadCount count(threads);
    return coarseCopy(ring.vertices, ring.faces, {1500, 1500, 0.0});
  };
  const CoarseCopy one = copy(1);
  EXPECT_EQ(one.mesh.vertices.rows(), 1500);
  EXPECT_TRUE(isClosedAndOriented(one.mesh));
  EXPECT_EQ(eulerCharacteristic(one.mesh), 0);
  for (const int threads : {2, 4}) {
    const CoarseCopy other = copy(threads);
    EXPECT_EQ(one.mesh.faces, other.mesh.faces);
    EXPECT_EQ(one.vertexOf, other.vertexOf);
  }
}

TEST(CoarseCopy, HasTheSizeAskedForWhateverTheNumbersOfTheVertices) {
  // Every vertex has neighbours in the other half.
  TriangleMesh ring = torus(2, 0.5, 400, 100);
  const auto n = static_cast<int>(ring.vertices.rows());
  const auto number = [&](int v) { return v % 2 * (n / 2) + v / 2; };
  const Points before = ring.vertices;
  for (int v = 0; v < n; ++v) ring.vertices.row(number(v)) = before.row(v);
  ring.faces = ring.faces.unaryExpr(number).eval();
  const CoarseCopy copy = coarseCopy(ring.vertices, ring.faces, {1500, 1500, 0.0});
  EXPECT_EQ(copy.mesh.vertices.rows(), 1500);
  EXPECT_EQ(eulerCharacteristic(copy.mesh), 0);
}

TEST(CoarseCopy, HasFewSliversAlsoOfVeryFineSurfaces) {
  const TriangleMesh fine = blob(150); // 225,000 vertices
  const TriangleMesh copy = coarseCopy(fine.vertices, fine.faces, {3000, 3000, 0.0}).mesh;
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

TEST(Interpolation, ReproducesConstantsAndNearlyThePositions) {
  const TriangleMesh mesh = blob(40);
  const Proxy proxy = makeProxy(mesh.vertices, mesh.faces, {1000, 1000, 0.0});
  const Interpolation interpolation = interpolationFrom(proxy, mesh.vertices);
  const Vector ones = interpolation * Vector(Vector::Ones(1000));
  EXPECT_LT((ones.array() - 1.0).abs().maxCoeff(), 1e-14);
  const Points positions = interpolation * proxy.mesh.vertices;
  // A few times the depth of an arc over an edge.
  EXPECT_LT((positions - mesh.vertices).rowwise().norm().maxCoeff(), 0.02);
}

TEST(Interpolation, HasTheTransposeOfItself) {
  const TriangleMesh mesh = blob(40);
  const Proxy proxy = makeProxy(mesh.vertices, mesh.faces, {1000, 1000, 0.0});
  Random random(5);
  const Vector coarse = random.vector(1000);
  const Vector fine = random.vector(mesh.vertices.rows());
  const Interpolation interpolation = interpolationFrom(proxy, mesh.vertices);
  const Matrix back = interpolation.transposeTimes(fine);
  // Rounding of 16,000 terms of order one.
  EXPECT_NEAR(fine.dot(interpolation * coarse), back.col(0).dot(coarse), 1e-10);
}

// ---------------------------------------------------------------- threads

TEST(Threads, DoNotChangeASingleBitOfTheCavity) {
  // Large enough for a coarse copy and a proxy of it.
  const TriangleMesh mesh = transformed(blob(38), someRotation());
  Options options;
  options.radiusX = options.radiusY = 0.5;
  const auto cavity = [&](int threads) {
    const ThreadCount count(threads);
    return optimizeMassProperties(mesh, options).inner;
  };
  const TriangleMesh one = cavity(1);
  ASSERT_GT(one.faces.rows(), 0);
  for (const int threads : {2, 4}) {
    const TriangleMesh other = cavity(threads);
    EXPECT_EQ(one.vertices, other.vertices);
    EXPECT_EQ(one.faces, other.faces);
  }
}

// ---------------------------------------------------------------- crossings

TEST(SelfIntersections, AreThoseThatAllPairsHaveAlsoOnWrinkledSurfaces) {
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

TEST(SelfIntersections, AreFoundWhereDistantPartsMeet) {
  // Two lobes whose tips reach into each other: each patch by itself is smooth.
  const TriangleMesh horseshoe = sphere(30);
  for (const double gap : {0.05, -0.05}) {
    TriangleMesh bent = horseshoe;
    for (Eigen::Index v = 0; v < bent.vertices.rows(); ++v) {
      // A long ellipsoid wound around the z axis, its ends `gap` apart.
      const double angle = (3.14159265358979 - 0.5 * gap) * bent.vertices(v, 0);
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
