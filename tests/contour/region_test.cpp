// The points that the walls leave, one after the other.
#include "core/contour/region.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace massprops::testing {
namespace {

// Far away another face than the nearest one is about as near, and shows its back.
TEST(InsetProbe, TellsTheSideOfAFlatBodyFromAfar) {
  const TriangleMesh outer =
      tetrahedron({0, 0, 0}, {1, 0, 0.02}, {0.3, 0.9, 0.01}, {0.4, 0.3, 0.06});
  const TriangleTree tree(outer.vertices, outer.faces);
  const PointInMesh inside(tree);
  const double wall = 0.005;
  const Region region{tree, wall};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-0.5, 1.5);
  int in = 0;
  InsetProbe probe(region);
  constexpr double kSlack = 0.03;
  InsetProbe quick(region, kSlack);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 x(number(random), number(random), 0.2 * number(random));
    const bool isInside = inside.contains(x);
    in += isInside ? 1 : 0;
    const double depth = probe.at(x, 1e-3).value + wall;
    EXPECT_LE(depth > 0.0, isInside) << x.transpose();
    const double quickly = quick.at(x, 1e-3, isInside && i % 2 == 0).value + wall;
    EXPECT_EQ(quickly > 0.0, depth > 0.0) << x.transpose();
    if (std::abs(depth) > wall + 1e-3) continue;
    EXPECT_LE(std::abs(quickly - depth), kSlack * std::abs(depth)) << x.transpose();
  }
  EXPECT_GT(in, 50);
}

} // namespace
} // namespace massprops::testing
