// Holes that join a cavity with the outside, and their plugs.
#include "core/drill/cutting.h"

#include "core/base/angles.h"
#include "core/mesh/components.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/signed_volume.h"
#include "core/query/self_intersection.h"

#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <utility>
#include <vector>

namespace massprops::testing {
namespace {

Points asTheyAre(const Points& points) {
  return points;
}

double volumeOf(const TriangleMesh& mesh) {
  return signedVolume(mesh.vertices, mesh.faces);
}

Eigen::Index eulerOf(const TriangleMesh& mesh) {
  return mesh.vertices.rows() - mesh.faces.rows() / 2;
}

/// A round hole through the lower side of a hollow box, whose walls are 1 thick.
Hole holeBelow(double radius) {
  return {{0.3, 0.2, -3.5}, -Vec3::UnitZ(), radius, 2.0};
}

double coneVolume(double r0, double r1, double height) {
  return kPi * height * (r0 * r0 + r0 * r1 + r1 * r1) / 3.0;
}

TEST(Drilled, OneClosedBodyOfGenusOneLessForEachHole) {
  const TriangleMesh outer = box({10, 10, 10}, 3);
  const TriangleMesh cavity = box({8, 8, 8}, 4);
  const Hole side{{3.5, -0.4, 0.7}, Vec3::UnitX(), 0.8, 2.0};
  for (const std::vector<Hole>& holes : {std::vector<Hole>{holeBelow(1)}, {holeBelow(1), side}}) {
    const auto body = drilled(outer, cavity, holes, 0.1, asTheyAre);
    ASSERT_TRUE(body);
    EXPECT_EQ(connectedComponents(body->body.vertices.rows(), body->body.faces).size(), 1U);
    EXPECT_EQ(eulerOf(body->body), 4 - 2 * static_cast<Eigen::Index>(holes.size()));
    EXPECT_TRUE(selfIntersectingFaces(body->body.vertices, body->body.faces).empty());
    const EdgeCounts edges = countEdges(body->body.vertices.rows(), body->body.faces);
    EXPECT_EQ(edges.boundary + edges.nonManifold + edges.incoherent, 0U);
    EXPECT_EQ(body->plugs.size(), holes.size());
  }
}

TEST(Drilled, TakesAConeOutAndAPlugIsThatConeLessTheClearance) {
  const TriangleMesh outer = box({10, 10, 10}, 3);
  const TriangleMesh cavity = box({8, 8, 8}, 4);
  const Hole hole = holeBelow(1);
  const double clearance = 0.1;
  const auto body = drilled(outer, cavity, {hole}, clearance, asTheyAre);
  ASSERT_TRUE(body);
  // n sides around the cone: tan(π/n)/(π/n) of it.
  const double angle = kPi / Hole::kSides;
  const double sides = std::tan(angle) / angle;
  const double r0 = hole.radiusAt(0.5);
  const double r1 = hole.radiusAt(1.5);
  EXPECT_NEAR(1000.0 - 512.0 - volumeOf(body->body), sides * coneVolume(r0, r1, 1.0), 1e-9);
  const double less = clearance * std::hypot(1.0, Hole::kWidening);
  EXPECT_NEAR(volumeOf(body->plugs[0]), sides * coneVolume(r0 - less, r1 - less, 1.0), 1e-9);
  // Flush with both surfaces.
  EXPECT_EQ(body->plugs[0].vertices.col(2).minCoeff(), -5.0);
  EXPECT_EQ(body->plugs[0].vertices.col(2).maxCoeff(), -4.0);
}

TEST(Drilled, IsTheSameEveryTimeAndSurvivesRoundingToFloats) {
  const TriangleMesh outer = transformed(blob(20), someRotation());
  const TriangleMesh cavity = scaled(outer, 0.8);
  const auto rounding = [](const Points& points) {
    return Points(points.cast<float>().cast<double>());
  };
  const Hole hole{Vec3(0, 0, -0.3), -Vec3::UnitZ(), 0.08, 1.5};
  const TriangleMesh body{rounding(outer.vertices), outer.faces};
  const TriangleMesh room{rounding(cavity.vertices), cavity.faces};
  const auto once = drilled(body, room, {hole}, 0.01, rounding);
  const auto again = drilled(body, room, {hole}, 0.01, rounding);
  ASSERT_TRUE(once && again);
  EXPECT_EQ(once->body.vertices, again->body.vertices);
  EXPECT_EQ(once->body.faces, again->body.faces);
  EXPECT_EQ(once->body.vertices, rounding(once->body.vertices));
  EXPECT_TRUE(selfIntersectingFaces(once->body.vertices, once->body.faces).empty());
}

TEST(Drilled, IsTheSameWhereverInMemoryItHappens) {
  // The drill's sides share coordinates with the box: what comes first of those must not depend on
  // addresses. Blocks of all sizes that are used up or left free move what is allocated.
  const TriangleMesh outer = box({10, 10, 10}, 12);
  const TriangleMesh cavity = box({8, 8, 8}, 12);
  const Hole side{{3.5, 0.0, 0.0}, Vec3::UnitX(), 0.8, 2.0};
  std::mt19937 random(1);
  std::uniform_int_distribution<std::size_t> size(1000, 100000);
  std::vector<std::vector<char>> blocks;
  std::optional<DrilledBody> first;
  for (int i = 0; i < 20; ++i) {
    for (int k = 0; k < 40; ++k) blocks.emplace_back(size(random));
    std::shuffle(blocks.begin(), blocks.end(), random);
    blocks.resize(blocks.size() / 2);
    std::optional<DrilledBody> again = drilled(outer, cavity, {holeBelow(1), side}, 0.1, asTheyAre);
    ASSERT_TRUE(again);
    if (!first) first = again;
    EXPECT_EQ(again->body.vertices, first->body.vertices);
    EXPECT_EQ(again->body.faces, first->body.faces);
    ASSERT_EQ(again->plugs.size(), first->plugs.size());
    for (std::size_t k = 0; k < first->plugs.size(); ++k) {
      EXPECT_EQ(again->plugs[k].vertices, first->plugs[k].vertices);
      EXPECT_EQ(again->plugs[k].faces, first->plugs[k].faces);
    }
  }
}

TEST(Drilled, NothingWhereTheDrillDoesNotGoThrough) {
  const TriangleMesh outer = box({10, 10, 10}, 3);
  const TriangleMesh cavity = box({8, 8, 8}, 4);
  // It ends within the wall.
  EXPECT_FALSE(
      drilled(outer, cavity, {{{0.3, 0.2, -3.5}, -Vec3::UnitZ(), 1, 1.0}}, 0.1, asTheyAre));
}

} // namespace
} // namespace massprops::testing
