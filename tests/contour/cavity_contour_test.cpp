// The surface of a cavity: what it promises, measured by other means.
#include "core/contour/cavity_contour.h"

#include "core/base/triangle.h"
#include "core/contour/slivers.h"
#include "core/contour/wall_keeping.h"
#include "core/mesh/components.h"
#include "core/mesh/connectivity.h"
#include "core/query/point_in_mesh.h"
#include "core/query/self_intersection.h"
#include "core/query/surface_distance.h"
#include "large_test.h"
#include "property/cases.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace massprops::testing {
namespace {

double smallestAngle(const TriangleMesh& mesh) {
  double least = 180.0;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    least = std::min(least, leastAngle(mesh.vertices.row(mesh.faces(f, 0)).transpose(),
                                       mesh.vertices.row(mesh.faces(f, 1)).transpose(),
                                       mesh.vertices.row(mesh.faces(f, 2)).transpose()));
  }
  return least;
}

void expectCavity(const TriangleTree& surface, double wall, const TriangleMesh& mesh) {
  EXPECT_GT(mesh.faces.rows(), 0);
  const EdgeCounts edges = countEdges(mesh.vertices.rows(), mesh.faces);
  EXPECT_EQ(edges.boundary + edges.nonManifold + edges.incoherent, 0U);
  EXPECT_TRUE(selfIntersectingFaces(mesh.vertices, mesh.faces).empty());
  EXPECT_GE(ClearanceQuery(surface).measure(mesh.vertices, mesh.faces, 2.0 * wall).least, wall);
  EXPECT_GT(smallestAngle(mesh), 5.0);
}

TEST(CavityContour, OfABoxIsTheSmallerBoxInFewTriangles) {
  const TriangleMesh outer = box({1.0, 1.5, 2.0}, 3);
  const TriangleTree tree(outer.vertices, outer.faces);
  const double wall = 0.05;
  const auto cavity = cavityContour(
      openedSet(tree, wall, edgeOfCubes(surfaceArea(outer.vertices, outer.faces), 20000)), {});
  ASSERT_TRUE(cavity);
  const TriangleMesh& mesh = cavity->contour.mesh;
  expectCavity(tree, wall, mesh);
  EXPECT_LT(mesh.faces.rows(), 5000);
  const double volume = (Eigen::Array3d(1.0, 1.5, 2.0) - 2.0 * wall).prod();
  EXPECT_NEAR(moments(mesh.vertices, mesh.faces)[0], volume, 1e-3 * volume);
}

TEST(CavityContour, FillsAlmostAllOfWhatABallLeaves) {
  LARGE_TEST();
  const TriangleMesh outer = sphere(30);
  const TriangleTree tree(outer.vertices, outer.faces);
  const double wall = 0.05;
  const auto cavity = cavityContour(
      openedSet(tree, wall, edgeOfCubes(surfaceArea(outer.vertices, outer.faces), 40000)), {});
  ASSERT_TRUE(cavity);
  expectCavity(tree, wall, cavity->contour.mesh);
  const double volume = moments(outer.vertices, outer.faces)[0] * std::pow(1.0 - wall, 3);
  EXPECT_NEAR(moments(cavity->contour.mesh.vertices, cavity->contour.mesh.faces)[0], volume,
              3e-3 * volume);
}

TEST(CavityContour, HasNoRoomsOfAFewWallsBesideALargeOne) {
  LARGE_TEST();
  const double wall = 0.05;
  // Its room is as wide as 1.8 walls.
  const TriangleMesh small = scaled(sphere(12), 1.9 * wall);
  const TriangleMesh both = joined(sphere(30), shifted(small, {2.0, 0.0, 0.0}));
  for (const TriangleMesh& outer : {small, both}) {
    const TriangleTree tree(outer.vertices, outer.faces);
    const auto cavity = cavityContour(openedSet(tree, wall, 0.4 * wall), {});
    ASSERT_TRUE(cavity);
    const TriangleMesh& mesh = cavity->contour.mesh;
    expectCavity(tree, wall, mesh);
    EXPECT_EQ(connectedComponents(mesh.vertices.rows(), mesh.faces).size(), 1U);
  }
}

TEST(CavityContour, LeavesCubesAroundPointsSolid) {
  LARGE_TEST();
  const TriangleMesh outer = sphere(30);
  const TriangleTree tree(outer.vertices, outer.faces);
  const double wall = 0.05;
  const OpenedSet set =
      openedSet(tree, wall, edgeOfCubes(surfaceArea(outer.vertices, outer.faces), 40000));
  const Vec3 place = Vec3(1, 2, 2).normalized() * (1.0 - wall);
  const auto nearest = [&](const TriangleMesh& mesh) {
    return std::sqrt(TriangleTree(mesh.vertices, mesh.faces).nearest(place).squaredDistance);
  };
  const auto whole = cavityContour(set, {});
  const auto cavity = cavityContour(set, {}, {}, {place});
  ASSERT_TRUE(whole && cavity);
  const TriangleMesh& mesh = cavity->contour.mesh;
  expectCavity(tree, wall, mesh);
  EXPECT_LT(nearest(whole->contour.mesh), 0.1 * set.edge);
  EXPECT_GT(nearest(mesh), 0.3 * set.edge);
  EXPECT_FALSE(PointInMesh(TriangleTree(mesh.vertices, mesh.faces)).contains(place));
  const double lost = moments(whole->contour.mesh.vertices, whole->contour.mesh.faces)[0] -
                      moments(mesh.vertices, mesh.faces)[0];
  EXPECT_GT(lost, 0.0);
  EXPECT_LT(lost, 100.0 * std::pow(set.edge, 3));
}

TEST(CavityContour, HasNoMoreTrianglesThanAnybodyWantsWhereTheyCostLittle) {
  LARGE_TEST();
  const TriangleMesh outer = sphere(60);
  const TriangleTree tree(outer.vertices, outer.faces);
  constexpr double kWall = 0.02;
  const double area = surfaceArea(outer.vertices, outer.faces);
  const auto cavity = cavityContour(openedSet(tree, kWall, edgeOfCubes(area, 150000)), {});
  ASSERT_TRUE(cavity);
  const TriangleMesh& mesh = cavity->contour.mesh;
  expectCavity(tree, kWall, mesh);
  EXPECT_LE(mesh.faces.rows(), kEnoughTriangles);
  EXPECT_GT(mesh.faces.rows(), kEnoughTriangles / 8) << "that was more than it takes";
  const double volume = moments(outer.vertices, outer.faces)[0] * std::pow(1.0 - kWall, 3);
  EXPECT_NEAR(moments(mesh.vertices, mesh.faces)[0], volume, 5e-3 * volume);
}

TEST(CavityContour, HasMoreTrianglesWhereTheyAreWorthIt) {
  LARGE_TEST();
  const TriangleMesh outer = sphere(60);
  const TriangleTree tree(outer.vertices, outer.faces);
  constexpr double kWall = 0.02;
  const double area = surfaceArea(outer.vertices, outer.faces);
  const OpenedSet set = openedSet(tree, kWall, edgeOfCubes(area, 150000));
  const double whole = moments(outer.vertices, outer.faces)[0] * std::pow(1.0 - kWall, 3);
  // So small a gain is lost with a thousandth of the volume.
  ContourUse use;
  use.loss = [&](const Contour& contour) {
    return 1000.0 * (1.0 - moments(contour.mesh.vertices, contour.mesh.faces)[0] / whole);
  };
  const auto few = cavityContour(set, {});
  const auto cavity = cavityContour(set, {}, use);
  ASSERT_TRUE(few && cavity);
  expectCavity(tree, kWall, cavity->contour.mesh);
  EXPECT_GT(cavity->contour.mesh.faces.rows(), few->contour.mesh.faces.rows());
  EXPECT_LT(use.loss(cavity->contour), use.loss(few->contour));
}

TEST(CavityContour, LeavesOutChannelsNarrowerThanAWall) {
  LARGE_TEST();
  // Two rooms with a passage between them that is 0.6 walls wide, and one of 1.6 walls.
  const double wall = 0.1;
  for (const double width : {0.6, 1.6}) {
    const double thin = (2.0 + width) * wall;
    std::vector<Vec2> profile;
    const auto ball = [&](double height, bool isUpper) {
      for (int i = 0; i <= 24; ++i) {
        const double angle = 3.14159265358979 * i / 24;
        const Vec2 p(0.5 * std::sin(angle), height + 0.5 * std::cos(angle));
        const bool isNeck = p.x() < 0.5 * thin && (isUpper ? p.y() < height : p.y() > height);
        if (!isNeck) profile.push_back(p);
      }
    };
    ball(0.8, true);
    profile.emplace_back(0.5 * thin, 0.3);
    profile.emplace_back(0.5 * thin, 0.0);
    profile.emplace_back(0.5 * thin, -0.3);
    ball(-0.8, false);
    profile.front().x() = profile.back().x() = 0.0;
    const TriangleMesh outer = revolved(profile, 48);
    const TriangleTree tree(outer.vertices, outer.faces);
    const auto cavity = cavityContour(
        openedSet(tree, wall, edgeOfCubes(surfaceArea(outer.vertices, outer.faces), 40000)), {});
    ASSERT_TRUE(cavity);
    expectCavity(tree, wall, cavity->contour.mesh);
    const auto rooms =
        connectedComponents(cavity->contour.mesh.vertices.rows(), cavity->contour.mesh.faces);
    EXPECT_EQ(rooms.size(), width < 1.0 ? 2U : 1U);
  }
}

TEST(CavityContour, KeepsItsPromisesForAnyQuadric) {
  LARGE_TEST();
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  const TriangleMesh outer = figure(5);
  const TriangleTree tree(outer.vertices, outer.faces);
  const double diagonal =
      (outer.vertices.colwise().maxCoeff() - outer.vertices.colwise().minCoeff()).norm();
  for (int i = 0; i < 12; ++i) {
    Moments quadric;
    for (double& term : quadric) term = normal(random);
    quadric.tail<6>() *= 2.0;
    const double wall = 0.01 * diagonal;
    const auto cavity = cavityContour(
        openedSet(tree, wall, edgeOfCubes(surfaceArea(outer.vertices, outer.faces), 15000)),
        LayeredQuadric::ofOneLayer(quadric));
    ASSERT_TRUE(cavity);
    if (cavity->contour.mesh.faces.rows() > 0) expectCavity(tree, wall, cavity->contour.mesh);
  }
}

TEST(CavityContour, HasAStepBetweenLayers) {
  LARGE_TEST();
  const TriangleMesh outer = box({1.0, 1.0, 1.0}, 3);
  const TriangleTree tree(outer.vertices, outer.faces);
  const double wall = 0.05;
  LayeredQuadric quadric{{0.1}, {Moments::Zero(), Moments::Zero()}};
  // Hollow where x > −0.2 below the height 0.1, where x > 0.3 above it.
  quadric.quadrics[0].head<2>() << 0.2, 1.0;
  quadric.quadrics[1].head<2>() << -0.3, 1.0;
  const double edge = 0.02;
  const auto cavity = cavityContour(openedSet(tree, wall, edge), quadric);
  ASSERT_TRUE(cavity);
  const TriangleMesh& mesh = cavity->contour.mesh;
  expectCavity(tree, wall, mesh);
  const double volume = 0.9 * (0.65 * 0.55 + 0.15 * 0.35);
  EXPECT_NEAR(moments(mesh.vertices, mesh.faces)[0], volume, 2e-3 * volume);
  // The step is one: between the planes nothing is farther from its height than the transition.
  for (const auto& x : mesh.vertices.rowwise()) {
    if (x.x() > -0.15 && x.x() < 0.25 && std::abs(x.y()) < 0.4 && x.z() > -0.4) {
      EXPECT_NEAR(x.z(), 0.1, 1.01 * edge);
    }
  }
}

// In rooms about as wide as cubes the way to the border may lead through the border opposite.
TEST(CavityContour, LosesLittleWhereVerticesCannotGoToTheBorder) {
  LARGE_TEST();
  const PropertyCase bowl = makeCase(7, 21);
  TriangleMesh outer = bowl.body;
  const double diagonal =
      (outer.vertices.colwise().maxCoeff() - outer.vertices.colwise().minCoeff()).norm();
  outer.vertices /= diagonal;
  const TriangleTree tree(outer.vertices, outer.faces);
  const double wall = bowl.wall / diagonal;
  const double edge = edgeOfCubes(surfaceArea(outer.vertices, outer.faces), 15000);
  EXPECT_GT(edge, 1.3 * wall);
  const auto cavity = cavityContour(openedSet(tree, wall, edge), {});
  ASSERT_TRUE(cavity);
  const TriangleMesh& mesh = cavity->contour.mesh;
  expectCavity(tree, wall, mesh);
  constexpr double kWhole = 0.03991; // with cubes a sixth as large
  EXPECT_GT(moments(mesh.vertices, mesh.faces)[0], 0.96 * kWhole);
}

TEST(CavityContour, IsEmptyWhereThereIsNoRoom) {
  const TriangleMesh outer = box({1.0, 1.0, 0.2}, 3);
  const TriangleTree tree(outer.vertices, outer.faces);
  const auto cavity = cavityContour(
      openedSet(tree, 0.11, edgeOfCubes(surfaceArea(outer.vertices, outer.faces), 20000)), {});
  ASSERT_TRUE(cavity);
  EXPECT_EQ(cavity->contour.mesh.faces.rows(), 0);
}

TEST(WallKeeping, MovesWhatIsTooNear) {
  const TriangleMesh outer = sphere(20);
  const TriangleTree tree(outer.vertices, outer.faces);
  TriangleMesh inner = sphere(15);
  inner.vertices *= 0.93;
  ClearanceQuery clearance(tree);
  EXPECT_TRUE(keepWall(clearance, 0.08, inner.faces, inner.vertices).empty());
  EXPECT_GE(ClearanceQuery(tree).measure(inner.vertices, inner.faces, 0.2).least, 0.08);
  EXPECT_GT(moments(inner.vertices, inner.faces)[0], 0.97 * 4.1888 * std::pow(0.92, 3));
}

TEST(Slivers, GoByCollapsesAndFlips) {
  Contour contour{sphere(12), {}};
  Points& x = contour.mesh.vertices;
  // A vertex next to one of its neighbours, and one on the opposite side of its ring.
  const int a = contour.mesh.faces(100, 0);
  const int b = contour.mesh.faces(100, 1);
  x.row(a) = 0.99 * x.row(b) + 0.01 * x.row(a);
  contour.on.assign(static_cast<std::size_t>(x.rows()), On::Inset);
  ASSERT_LT(smallestAngle(contour.mesh), 5.0);
  EXPECT_EQ(removeSlivers(8.0, contour), 0);
  EXPECT_GE(smallestAngle(contour.mesh), 8.0);
  const EdgeCounts edges = countEdges(contour.mesh.vertices.rows(), contour.mesh.faces);
  EXPECT_EQ(edges.boundary + edges.nonManifold + edges.incoherent, 0U);
  EXPECT_EQ(contour.on.size(), static_cast<std::size_t>(contour.mesh.vertices.rows()));
}

} // namespace
} // namespace massprops::testing
