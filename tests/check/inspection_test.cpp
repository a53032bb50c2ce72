// What an inspection lets pass, and what it does not.
#include "core/check/inspection.h"

#include "shapes.h"

#include <gtest/gtest.h>

namespace massprops::testing {
namespace {

/// Of a cube of edge 1 whose cavity is a cube, too, at this distance from it.
Inspection ofCubes(double distance, double wanted) {
  const TriangleMesh outer = box({1.0, 1.0, 1.0}, 4);
  const TriangleMesh inner = box(Vec3::Constant(1.0 - 2.0 * distance), 3);
  return inspect(inner.vertices, inner.faces, TriangleTree(outer.vertices, outer.faces), wanted);
}

TEST(Inspection, LetsNoWallPassThatIsThinnerThanTheWantedOne) {
  const double wall = 0.1;
  // What it cannot measure, a billionth, counts as missing.
  for (const double share : {0.9, 0.997, 1.0 - 1e-6, 1.0 - 1e-9, 1.0}) {
    const Inspection inspection = ofCubes(share * wall, wall);
    EXPECT_FALSE(inspection.thin.empty()) << share;
    EXPECT_FALSE(inspection.isClean()) << share;
  }
  for (const double share : {1.0 + 2e-9, 1.001, 1.5}) {
    const Inspection inspection = ofCubes(share * wall, wall);
    EXPECT_TRUE(inspection.isClean()) << share;
    EXPECT_NEAR(inspection.leastWall, share * wall, 1e-15);
  }
}

TEST(Inspection, SeesFacesThatTouchOnlyWhereTheyAreStored) {
  const TriangleMesh outer = box({1.0, 1.0, 1.0}, 4);
  // A pyramid whose tip is a hair above its base.
  const TriangleMesh inner =
      scaled(tetrahedron({1, 0, 0}, {0, 1, 0}, {-1, -1, 0}, {0, 0, 1e-9}), 0.3);
  const TriangleTree tree(outer.vertices, outer.faces);
  const auto isClean = [&](double step) {
    const auto rounded = [&](const Points& points) {
      return Points((points.array() / step).round() * step);
    };
    return inspect(inner.vertices, inner.faces, tree, 0.01, nullptr, rounded).isClean();
  };
  EXPECT_TRUE(isClean(1e-12));
  EXPECT_FALSE(isClean(1e-6));
}

} // namespace
} // namespace massprops::testing
