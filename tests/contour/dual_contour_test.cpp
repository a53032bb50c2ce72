// Borders of regions with known shapes.
#include "core/contour/dual_contour.h"

#include "core/base/angles.h"
#include "core/mesh/components.h"
#include "core/mesh/connectivity.h"
#include "core/physics/moments.h"
#include "core/query/self_intersection.h"
#include "large_test.h"
#include "shapes.h"
#include "thread_count.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>
#include <vector>

namespace massprops::testing {
namespace {

TriangleTree treeOf(const TriangleMesh& mesh) {
  return {mesh.vertices, mesh.faces};
}

void expectClosedManifold(const TriangleMesh& mesh) {
  const EdgeCounts edges = countEdges(mesh.vertices.rows(), mesh.faces);
  EXPECT_EQ(edges.boundary, 0U);
  EXPECT_EQ(edges.nonManifold, 0U);
  EXPECT_EQ(edges.incoherent, 0U);
  EXPECT_TRUE(selfIntersectingFaces(mesh.vertices, mesh.faces).empty());
}

/// Behind the walls, without a ball, on the positive side of the quadric, if there is one.
Contour contourOf(const TriangleTree& tree, double wall, double edge,
                  const std::optional<QuadricCut>& cut = {}) {
  const FeasibleSet set{tree, wall, 0.0};
  const FeasibleRegion region = feasibleRegion(set, edge);
  return dualContour(BorderLattice(set, region, cut));
}

double volumeOf(const TriangleMesh& mesh) {
  return moments(mesh.vertices, mesh.faces)[0];
}

/// Vertices that a face uses.
std::vector<int> used(const TriangleMesh& mesh) {
  return submesh(mesh.vertices, mesh.faces).vertexOf;
}

QuadricCut halfSpace(const Vec3& normal, double offset) {
  Moments quadric = Moments::Zero();
  quadric[0] = -offset;
  quadric.segment<3>(1) = normal;
  return {LayeredQuadric::ofOneLayer(quadric)};
}

TEST(DualContour, OfABoxIsTheSmallerBoxWithItsEdges) {
  const TriangleMesh outer = box({1.0, 1.5, 2.0}, 3);
  const TriangleTree tree = treeOf(outer);
  const double wall = 0.13;
  const Contour inner = contourOf(tree, wall, 0.071);
  expectClosedManifold(inner.mesh);
  const Eigen::Array3d size = Eigen::Array3d(1.0, 1.5, 2.0) - 2.0 * wall;
  EXPECT_NEAR(volumeOf(inner.mesh), size.prod(), 1e-9);
  const Vec3 corner =
      inner.mesh.vertices(used(inner.mesh), Eigen::all).colwise().maxCoeff().transpose();
  // Corners of the region know their distances as floats.
  EXPECT_TRUE(corner.isApprox(0.5 * size.matrix(), 1e-7));
}

TEST(DualContour, OfABoxCutByAPlaneHasACreaseWhereTheyMeet) {
  const TriangleMesh outer = box({2.0, 2.0, 2.0}, 3);
  const TriangleTree tree = treeOf(outer);
  const double wall = 0.2;
  const Vec3 normal = Vec3(1.0, 1.0, 1.0).normalized();
  const double edge = 0.073;
  const Contour inner = contourOf(tree, wall, edge, halfSpace(normal, 0.1));
  expectClosedManifold(inner.mesh);
  int creases = 0;
  int away = 0;
  for (const int v : used(inner.mesh)) {
    const Vec3 x = inner.mesh.vertices.row(v).transpose();
    const double fromWall = 0.8 - x.cwiseAbs().maxCoeff();
    const double fromCut = normal.dot(x) - 0.1;
    EXPECT_GT(std::min(fromWall, fromCut), -1e-6);
    const On on = inner.on[static_cast<std::size_t>(v)];
    const double off = std::max(on == On::Cut ? 0.0 : fromWall, on == On::Wall ? 0.0 : fromCut);
    // Where an edge of the box ends, three planes meet, and a cube may see two of them.
    EXPECT_LT(off, 0.2 * edge);
    if (off > 1e-6) ++away;
    if (on == On::Crease) ++creases;
  }
  EXPECT_GT(creases, 50);
  EXPECT_LT(away, creases / 2);
  // Beyond a plane at t from the middle of a cube of half edge a: for its part that the plane
  // leaves the corner's pyramid of height √3a − t less those beyond three corners next to it.
  const double a = 0.8;
  const auto pyramid = [](double legs) { return legs > 0.0 ? std::pow(legs, 3) / 6.0 : 0.0; };
  const double legs = 3.0 * a - 0.1 * std::sqrt(3.0);
  const double volume = pyramid(legs) - 3.0 * pyramid(legs - 2.0 * a);
  EXPECT_NEAR(volumeOf(inner.mesh), volume, 1e-3 * volume);
}

TEST(DualContour, OfABallCutByAnEllipsoidHasTheVolumeBetween) {
  const TriangleMesh outer = sphere(40);
  const TriangleTree tree = treeOf(outer);
  // Outside of an ellipsoid inside of the ball.
  Moments quadric = Moments::Zero();
  const Vec3 half(0.3, 0.4, 0.5);
  quadric[0] = -1.0;
  quadric.segment<3>(4) = half.cwiseAbs2().cwiseInverse();
  const Contour inner = contourOf(tree, 0.1, 0.04, QuadricCut{LayeredQuadric::ofOneLayer(quadric)});
  expectClosedManifold(inner.mesh);
  const double kPi4_3 = 4.0 / 3.0 * kPi;
  EXPECT_NEAR(volumeOf(inner.mesh), kPi4_3 * (0.9 * 0.9 * 0.9 - half.prod()), 5e-3);
  EXPECT_EQ(connectedComponents(inner.mesh.vertices.rows(), inner.mesh.faces).size(), 2U);
}

TEST(DualContour, IsFreeOfCrossingsHoweverCoarse) {
  LARGE_TEST();
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const TriangleMesh outer = figure(4);
  const TriangleTree tree = treeOf(outer);
  const Vec3 extent =
      (outer.vertices.colwise().maxCoeff() - outer.vertices.colwise().minCoeff()).transpose();
  for (int i = 0; i < 30; ++i) {
    Moments quadric;
    for (double& term : quadric) term = normal(random);
    quadric.tail<6>() *= 3.0;
    const double wall = extent.norm() * (0.004 + 0.001 * (i % 10));
    const double edge = wall * (0.5 + 0.1 * (i % 13));
    // A ball makes corners that are lost beside others that are not.
    const FeasibleSet set{tree, wall, i % 2 == 0 ? wall : 0.0};
    const FeasibleRegion region = feasibleRegion(set, edge);
    const std::optional<QuadricCut> cut = QuadricCut{LayeredQuadric::ofOneLayer(quadric)};
    const Contour contour = dualContour(BorderLattice(set, region, cut));
    expectClosedManifold(contour.mesh);
  }
}

TEST(DualContour, IsTheSameWithAnyNumberOfThreads) {
  const TriangleMesh outer = blob(16);
  const TriangleTree tree = treeOf(outer);
  const auto on = [&](int threads) {
    const ThreadCount count(threads);
    return contourOf(tree, 0.1, 0.05, halfSpace(Vec3::UnitZ(), 0.1));
  };
  const Contour one = on(1);
  const Contour four = on(4);
  EXPECT_EQ(one.mesh.faces, four.mesh.faces);
  EXPECT_EQ(one.mesh.vertices, four.mesh.vertices);
}

TEST(DualContour, HasAStepBetweenLayers) {
  const TriangleMesh outer = box({1.0, 1.0, 1.0}, 3);
  const TriangleTree tree = treeOf(outer);
  LayeredQuadric quadric{{0.1}, {Moments::Zero(), Moments::Zero()}};
  // Hollow where x > −0.2 below the height 0.1, where x > 0.3 above it.
  quadric.quadrics[0].head<2>() << 0.2, 1.0;
  quadric.quadrics[1].head<2>() << -0.3, 1.0;
  const double edge = 0.02;
  const Contour inner = contourOf(tree, 0.05, edge, QuadricCut{quadric, edge});
  expectClosedManifold(inner.mesh);
  const double volume = 0.9 * (0.65 * 0.55 + 0.15 * 0.35);
  EXPECT_NEAR(volumeOf(inner.mesh), volume, 5e-3 * volume);
  // The step is one: between the planes nothing is farther from its height than the transition.
  for (const int v : used(inner.mesh)) {
    const Vec3 x = inner.mesh.vertices.row(v).transpose();
    if (x.x() > -0.15 && x.x() < 0.25 && std::abs(x.y()) < 0.4 && x.z() > -0.4) {
      EXPECT_NEAR(x.z(), 0.1, 1.01 * edge);
    }
  }
}

// Two balls, and between them a passage so many walls wide: a ball as wide as a wall passes, or
// does not.
TEST(DualContour, HasNoChannelsNarrowerThanTheBall) {
  const double wall = 0.1;
  for (const double width : {0.6, 1.6}) {
    const double radius = 0.5 * (2.0 + width) * wall; // of the passage's outer surface
    std::vector<Vec2> profile;
    const auto addBall = [&](double height, bool isUpper) {
      constexpr int kPieces = 24;
      for (int i = 0; i <= kPieces; ++i) {
        const double angle = kPi * i / kPieces;
        const Vec2 p(0.5 * std::sin(angle), height + 0.5 * std::cos(angle));
        const bool isNeck = p.x() < radius && (isUpper ? p.y() < height : p.y() > height);
        if (!isNeck) profile.push_back(p);
      }
    };
    addBall(0.8, true);
    for (const double height : {0.3, 0.0, -0.3}) profile.emplace_back(radius, height);
    addBall(-0.8, false);
    profile.front().x() = profile.back().x() = 0.0;
    const TriangleMesh outer = revolved(profile, 48);
    const TriangleTree tree = treeOf(outer);
    const FeasibleSet set{tree, wall, wall};
    const FeasibleRegion region = feasibleRegion(set, edgeFor(set));
    const Contour contour = dualContour(BorderLattice(set, region, {}));
    expectClosedManifold(contour.mesh);
    EXPECT_EQ(connectedComponents(contour.mesh.vertices.rows(), contour.mesh.faces).size(),
              width < 1.0 ? 2U : 1U);
  }
}

TEST(DualContour, IsTheBoxThatIsLeftOfOneWithACollarThatTheBallDoesNotReach) {
  const double wall = 0.05;
  const double half = 0.5 * 2.6 * wall; // room for 0.6 walls
  const TriangleMesh outer = revolved({{0.0, 0.5},
                                       {0.4, 0.5},
                                       {0.4, half},
                                       {1.0, half},
                                       {1.0, -half},
                                       {0.4, -half},
                                       {0.4, -0.5},
                                       {0.0, -0.5}},
                                      96);
  const TriangleTree tree = treeOf(outer);
  const FeasibleSet set{tree, wall, wall};
  const FeasibleRegion region = feasibleRegion(set, edgeFor(set));
  const Contour contour = dualContour(BorderLattice(set, region, {}));
  expectClosedManifold(contour.mesh);
  int reach = 0;
  for (const int v : used(contour.mesh)) {
    EXPECT_LT(contour.mesh.vertices.row(v).head<2>().norm(), 0.4 + wall);
    reach += contour.on[static_cast<std::size_t>(v)] == On::Reach ? 1 : 0;
  }
  EXPECT_GT(reach, 0);
}

} // namespace
} // namespace massprops::testing
