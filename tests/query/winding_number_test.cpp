#include "core/query/winding_number.h"

#include "core/query/surface_deviation.h"
#include "judge/checks.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace massprops::testing {
namespace {

TEST(WindingNumber, IsTheSumOfAllSolidAngles) {
  TriangleMesh open = blob(8);
  open.faces.conservativeResize(open.faces.rows() * 3 / 4, 3);
  const WindingNumber winding(open.vertices, open.faces);
  Random random(5);
  for (int i = 0; i < 200; ++i) {
    const Vec3 p = 2.0 * random.vector();
    // What the dipoles lose.
    EXPECT_NEAR(winding.at(p), windingNumber(open, p), 0.03) << p.transpose();
  }
}

TEST(WindingNumber, OfNothingIsZero) {
  EXPECT_EQ(WindingNumber({}, {}).at(Vec3::Zero()), 0.0);
}

TEST(GreatestDistance, IsThatOfTheFarthestCornerOrMiddle) {
  const TriangleMesh one = sphere(10);
  const TriangleMesh two = scaled(sphere(10), 1.1);
  const TriangleTree tree(one.vertices, one.faces);
  EXPECT_NEAR(greatestDistance(two.vertices, two.faces, tree), 0.1, 1e-9);
  EXPECT_EQ(greatestDistance(one.vertices, Faces(0, 3), tree), 0.0);
}

} // namespace
} // namespace massprops::testing
