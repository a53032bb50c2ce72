// A contour becomes a surface that keeps the wall.
#include "core/contour/cavity_surface.h"

#include "core/base/angles.h"
#include "core/mesh/components.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/signed_volume.h"
#include "core/query/self_intersection.h"
#include "large_test.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <utility>
#include <vector>

namespace massprops::testing {
namespace {

std::vector<char> all(const Contour& contour) {
  return std::vector<char>(static_cast<std::size_t>(contour.mesh.vertices.rows()), 1);
}

Contour contourOf(const FeasibleSet& set, double edge, const std::optional<QuadricCut>& cut = {}) {
  const FeasibleRegion region = feasibleRegion(set, edge);
  return dualContour(BorderLattice(set, region, cut));
}

TEST(CavitySurface, KeepsTheWallOfWhatWasTooNear) {
  const TriangleMesh outer = sphere(20);
  const TriangleTree tree(outer.vertices, outer.faces);
  TriangleMesh inner = sphere(15);
  inner.vertices *= 0.93;
  ClearanceQuery clearance(tree);
  EXPECT_TRUE(keepWall(clearance, 0.08, inner.faces, inner.vertices).empty());
  EXPECT_GE(ClearanceQuery(tree).measure(inner.vertices, inner.faces, 0.2).least, 0.08);
  EXPECT_GT(signedVolume(inner.vertices, inner.faces), 0.97 * 4.0 / 3.0 * kPi * std::pow(0.92, 3));
}

TEST(CavitySurface, LeavesWhatIsFarEnoughWhereItIs) {
  const TriangleMesh outer = sphere(20);
  const TriangleTree tree(outer.vertices, outer.faces);
  TriangleMesh inner = sphere(15);
  inner.vertices *= 0.85;
  const Points before = inner.vertices;
  ClearanceQuery clearance(tree);
  EXPECT_TRUE(keepWall(clearance, 0.08, inner.faces, inner.vertices).empty());
  EXPECT_EQ(inner.vertices, before);
}

// The step is Newton's: what is left is of second order in its length, which is the contour's.
TEST(CavitySurface, HasVerticesOnTheWallsOnceTheyAreMovedThere) {
  const TriangleMesh outer = blob(16);
  const TriangleTree tree(outer.vertices, outer.faces);
  const FeasibleSet set{tree, 0.1, 0.1};
  const double edge = 0.05;
  Contour contour = contourOf(set, edge);
  RegionProbe probe(set);
  const auto largest = [&] {
    double error = 0.0;
    double sum = 0.0;
    int count = 0;
    for (const int v : submesh(contour.mesh.vertices, contour.mesh.faces).vertexOf) {
      if (contour.on[static_cast<std::size_t>(v)] != On::Wall) continue;
      const double depth = probe.depthAt(contour.mesh.vertices.row(v).transpose(), 1.0).value;
      error = std::max(error, std::abs(depth - set.wall));
      sum += std::abs(depth - set.wall);
      ++count;
    }
    EXPECT_GT(count, 500);
    return std::pair(error, sum / count);
  };
  const auto [before, meanBefore] = largest();
  moveOntoWalls(tree, set.wall, edge, all(contour), contour);
  const auto [after, meanAfter] = largest();
  EXPECT_LT(after, 0.5 * before);
  EXPECT_LT(meanAfter, 0.05 * meanBefore);
  EXPECT_LT(after, 0.02 * edge);
}

TEST(CavitySurface, MovesOnlyWhatMayMove) {
  const TriangleMesh outer = blob(12);
  const TriangleTree tree(outer.vertices, outer.faces);
  const FeasibleSet set{tree, 0.1, 0.1};
  Moments plane = Moments::Zero();
  plane[3] = 1.0;
  Contour contour = contourOf(set, 0.05, QuadricCut{LayeredQuadric::ofOneLayer(plane)});
  const Points before = contour.mesh.vertices;
  std::vector<char> moves = all(contour);
  for (std::size_t v = 0; v < moves.size(); v += 2) moves[v] = 0;
  moveOntoWalls(tree, set.wall, 0.05, moves, contour);
  int moved = 0;
  for (Eigen::Index v = 0; v < before.rows(); ++v) {
    if (contour.mesh.vertices.row(v) == before.row(v)) continue;
    const auto i = static_cast<std::size_t>(v);
    EXPECT_NE(moves[i], 0);
    // What does not lie on the wall alone only goes inwards.
    const auto depth = [&](const Points& at) {
      return std::sqrt(tree.nearest(at.row(v).transpose()).squaredDistance);
    };
    if (contour.on[i] != On::Wall) {
      EXPECT_LT(depth(before), set.wall);
      EXPECT_GT(depth(contour.mesh.vertices), depth(before));
    }
    EXPECT_LE((contour.mesh.vertices.row(v) - before.row(v)).norm(), 0.5 * 0.05 + 1e-12);
    ++moved;
  }
  EXPECT_GT(moved, 100);
}

TEST(CavitySurface, HasNoComponentsSmallerThanTheBall) {
  Contour contour;
  const double ball = 0.2;
  contour.mesh = joined(sphere(8), joined(shifted(scaled(sphere(8), 0.6 * ball), {3.0, 0.0, 0.0}),
                                          shifted(scaled(sphere(8), 0.4 * ball), {4.0, 0.0, 0.0})));
  contour.on.assign(static_cast<std::size_t>(contour.mesh.vertices.rows()), On::Wall);
  removeSmallComponents(ball, contour);
  const Components left = connectedComponents(contour.mesh.vertices.rows(), contour.mesh.faces);
  ASSERT_EQ(left.size(), 2U);
  EXPECT_GT(contour.mesh.vertices(left[0](0, 0), 0), -1.1);
  EXPECT_NEAR(contour.mesh.vertices(left[1](0, 0), 0), 3.0, ball);
  // Their vertices stay.
  EXPECT_EQ(contour.on.size(), static_cast<std::size_t>(contour.mesh.vertices.rows()));
  removeSmallComponents(3.0, contour);
  EXPECT_EQ(contour.mesh.faces.rows(), 0);
}

// What is still too thin after that becomes solid: it must be little.
TEST(CavitySurface, KeepsItsPromisesButForAFewVerticesForAnyQuadric) {
  LARGE_TEST();
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  const TriangleMesh outer = figure(5);
  const TriangleTree tree(outer.vertices, outer.faces);
  const double diagonal = (tree.upper() - tree.lower()).norm();
  for (int i = 0; i < 12; ++i) {
    Moments quadric;
    for (double& term : quadric) term = normal(random);
    quadric.tail<6>() *= 2.0;
    const double wall = 0.01 * diagonal;
    const FeasibleSet set{tree, wall, wall};
    const double edge = edgeFor(set);
    Contour contour = contourOf(set, edge, QuadricCut{LayeredQuadric::ofOneLayer(quadric), edge});
    removeSmallComponents(set.ball, contour);
    if (contour.mesh.faces.rows() == 0) continue;
    // A little farther than need be, for chords.
    moveOntoWalls(tree, (1.0 + 5e-4) * wall, edge, all(contour), contour);
    ClearanceQuery clearance(tree);
    const TriangleMesh& mesh = contour.mesh;
    const std::vector<int> thin = keepWall(clearance, wall, mesh.faces, contour.mesh.vertices);
    EXPECT_LE(static_cast<Eigen::Index>(thin.size()), mesh.faces.rows() / 500 + 10);
    const EdgeCounts edges = countEdges(mesh.vertices.rows(), mesh.faces);
    EXPECT_EQ(edges.boundary + edges.nonManifold + edges.incoherent, 0U);
    const auto crossing =
        static_cast<Eigen::Index>(selfIntersectingFaces(mesh.vertices, mesh.faces).size());
    EXPECT_LE(crossing, mesh.faces.rows() / 200 + 10); // up to 0.3 %
    if (thin.empty()) {
      EXPECT_GE(ClearanceQuery(tree).measure(mesh.vertices, mesh.faces, 2.0 * wall).least, wall);
    }
  }
}

} // namespace
} // namespace massprops::testing
