// Surfaces cut by a plane, against solids whose part above it is known.
#include "core/mesh/plane_cut.h"

#include "core/base/angles.h"
#include "judge/checks.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace massprops::testing {
namespace {

Points asTheyAre(const Points& points) {
  return points;
}

Points asFloats(const Points& points) {
  return points.cast<float>().cast<double>();
}

double volume(const TriangleMesh& mesh) {
  return quadratureMoments(mesh)[0];
}

/// Closed, free of crossings and of faces without area, nothing below the level, and as much of the
/// volume as lies above it by an integral of its own.
void expectPartAbove(const TriangleMesh& whole, double level, const TriangleMesh& part) {
  EXPECT_TRUE(isClosedAndOriented(part));
  EXPECT_EQ(intersectingPairs(part), 0U);
  EXPECT_EQ(facesWithoutArea(part), 0U);
  EXPECT_GE(part.vertices.col(2).minCoeff(), level);
  const double below = momentsOfColumns(whole, Vec3::UnitZ(), level)[0];
  EXPECT_NEAR(volume(part), volume(whole) - below, 1e-9 * volume(whole));
}

TEST(PlaneCut, OfABallLeavesTheRestOfIt) {
  const TriangleMesh ball = sphere(8);
  for (const double level : {-0.93, -0.41, 0.013, 0.77}) {
    const auto cut = cutAbove(ball.vertices, ball.faces, level, 0.0, asTheyAre);
    ASSERT_TRUE(cut) << level;
    EXPECT_EQ(cut->spread, 0.0);
    expectPartAbove(ball, level, cut->mesh);
  }
}

TEST(PlaneCut, OfALyingRingHasACapWithAHole) {
  const TriangleMesh ring = torus(1.0, 0.3, 31, 17);
  const auto cut = cutAbove(ring.vertices, ring.faces, -0.21, 0.0, asTheyAre);
  ASSERT_TRUE(cut);
  expectPartAbove(ring, -0.21, cut->mesh);
  EXPECT_EQ(eulerCharacteristic(cut->mesh), 0);
}

TEST(PlaneCut, OfSeveralFeetHasACapForEach) {
  const TriangleMesh bridge = polycube({{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {2, 0, 1}, {2, 0, 0}}, 2);
  const auto cut = cutAbove(bridge.vertices, bridge.faces, 0.3, 0.0, asTheyAre);
  ASSERT_TRUE(cut);
  expectPartAbove(bridge, 0.3, cut->mesh);
  // Four feet of a standing ring that is cut in its middle, where it falls in two.
  const TriangleMesh ring =
      transformed(torus(1.0, 0.3, 31, 17), rotation(Vec3::UnitX(), 0.5 * kPi));
  const auto halves = cutAbove(ring.vertices, ring.faces, 0.02, 0.0, asTheyAre);
  ASSERT_TRUE(halves);
  expectPartAbove(ring, 0.02, halves->mesh);
  EXPECT_EQ(eulerCharacteristic(halves->mesh), 2);
}

TEST(PlaneCut, LiesInOnePlaneAsFloatsToo) {
  Random random(5);
  for (int trial = 0; trial < 8; ++trial) {
    TriangleMesh body = transformed(blob(9), someRotation(), {31.7, -20.3, 17.9});
    body.vertices = asFloats(body.vertices);
    const double low = body.vertices.col(2).minCoeff();
    const double level = low + 0.2 + 0.2 * random();
    const auto cut = cutAbove(body.vertices, body.faces, level, 0.0, asFloats);
    ASSERT_TRUE(cut);
    EXPECT_EQ(cut->spread, 0.0);
    EXPECT_EQ(cut->mesh.vertices, asFloats(cut->mesh.vertices));
    EXPECT_TRUE(isClosedAndOriented(cut->mesh));
    EXPECT_EQ(intersectingPairs(cut->mesh), 0U);
    const double lowest = cut->mesh.vertices.col(2).minCoeff();
    EXPECT_EQ(lowest, static_cast<double>(static_cast<float>(level)));
    EXPECT_GT((cut->mesh.vertices.col(2).array() == lowest).count(), 3);
  }
}

double shortestEdge(const TriangleMesh& mesh) {
  double shortest = std::numeric_limits<double>::infinity();
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      shortest = std::min(shortest, (mesh.vertices.row(mesh.faces(f, k)) -
                                     mesh.vertices.row(mesh.faces(f, (k + 1) % 3)))
                                        .norm());
    }
  }
  return shortest;
}

TEST(PlaneCut, HasNoShortEdgesWhereCornersAreMerged) {
  // Just below and just above a row of vertices of a lattice.
  const TriangleMesh cube = box({1, 1, 1}, 10);
  for (const double off : {-1e-7, 1e-7}) {
    const double level = -0.2 + off;
    const auto plain = cutAbove(cube.vertices, cube.faces, level, 0.0, asTheyAre);
    const auto merged = cutAbove(cube.vertices, cube.faces, level, 1e-4, asTheyAre);
    ASSERT_TRUE(plain && merged);
    EXPECT_LT(shortestEdge(plain->mesh), 1e-6);
    EXPECT_GT(shortestEdge(merged->mesh), 0.05);
    EXPECT_TRUE(isClosedAndOriented(merged->mesh));
    EXPECT_EQ(intersectingPairs(merged->mesh), 0U);
    EXPECT_NEAR(volume(merged->mesh), 0.7, 1e-6);
  }
}

/// Edges of one face.
std::size_t borderEdges(const TriangleMesh& mesh) {
  std::set<std::pair<int, int>> edges;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) edges.emplace(mesh.faces(f, k), mesh.faces(f, (k + 1) % 3));
  }
  return static_cast<std::size_t>(std::count_if(edges.begin(), edges.end(), [&](const auto& edge) {
    return edges.count({edge.second, edge.first}) == 0;
  }));
}

TEST(PlaneCut, OfAnOpenSurfaceKeepsItsOpening) {
  TriangleMesh cup = box({1, 1, 1}, 4);
  Faces faces(cup.faces.rows(), 3);
  Eigen::Index kept = 0;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    double lowest = 1.0;
    for (const int v : cup.faces.row(f)) lowest = std::min(lowest, cup.vertices(v, 2));
    if (lowest < 0.5) faces.row(kept++) = cup.faces.row(f);
  }
  cup.faces = faces.topRows(kept);
  const auto cut = cutAbove(cup.vertices, cup.faces, -0.33, 0.0, asTheyAre);
  ASSERT_TRUE(cut);
  // The border is the opening's four sides of four edges.
  EXPECT_EQ(borderEdges(cut->mesh), 16U);
}

TEST(PlaneCut, IsNothingWhereCornersMeet) {
  // Rounding takes the width of one of the polygons.
  const TriangleMesh body = box({1.0, 1.0, 1.0}, 2);
  const auto flattened = [](const Points& points) {
    Points rounded = points;
    rounded.col(0).setZero();
    rounded.col(1).setZero();
    return rounded;
  };
  EXPECT_FALSE(cutAbove(body.vertices, body.faces, 0.1, 0.0, flattened));
}

} // namespace
} // namespace massprops::testing
