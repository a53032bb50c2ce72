// A cavity of a volume behind an even wall.
#include "core/best/uniform_wall.h"

#include "core/base/angles.h"
#include "core/mesh/signed_volume.h"
#include "core/query/self_intersection.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace massprops::testing {
namespace {

constexpr double kTolerance = 1e-9;

std::optional<TriangleMesh> cavityOf(const TriangleTree& tree, double volume) {
  return cavityOfVolume(
      {tree, volume, kTolerance, 0.02, 0.02, 0.1, [](const Points& points) { return points; }});
}

TEST(UniformWall, IsTheDifferenceOfRadiiOfABall) {
  const TriangleMesh outer = sphere(12);
  const TriangleTree tree(outer.vertices, outer.faces);
  for (const double radius : {0.3, 0.6, 0.9}) {
    const double volume = 4.0 / 3.0 * kPi * std::pow(radius, 3);
    const std::optional<TriangleMesh> cavity = cavityOf(tree, volume);
    ASSERT_TRUE(cavity) << radius;
    EXPECT_NEAR(signedVolume(cavity->vertices, cavity->faces), volume, kTolerance);
    EXPECT_TRUE(selfIntersectingFaces(cavity->vertices, cavity->faces).empty());
    const Vector radii = cavity->vertices.rowwise().norm();
    EXPECT_NEAR(radii.mean(), radius, 0.01);
    EXPECT_LT(radii.maxCoeff() - radii.minCoeff(), 0.02);
  }
}

TEST(UniformWall, IsNotThereWhereTheLeastOneLeavesLessRoom) {
  const TriangleMesh outer = sphere(12);
  const TriangleTree tree(outer.vertices, outer.faces);
  const double all = signedVolume(outer.vertices, outer.faces);
  EXPECT_TRUE(cavityOf(tree, 0.9 * all));
  EXPECT_FALSE(cavityOf(tree, 0.96 * all)); // (1 - 0.02)³ = 0.94
}

} // namespace
} // namespace massprops::testing
