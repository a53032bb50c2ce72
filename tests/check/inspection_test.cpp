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
  return inspect(inner.vertices, inner.faces, TriangleTree(outer.vertices, outer.faces), wanted,
                 false);
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

} // namespace
} // namespace massprops::testing
