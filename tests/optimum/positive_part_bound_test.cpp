// Bounds on integrals over what may be hollow, against closed forms.
#include "core/optimum/positive_part_bound.h"

#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

namespace massprops::testing {
namespace {

/// Of 1 along each side, its foot on the ground.
TriangleMesh standingCube() {
  return transformed(box({1, 1, 1}, 6), Mat3::Identity(), Vec3(0, 0, 0.5));
}

TEST(PositivePartBound, IsCloseAboveTheIntegral) {
  const TriangleMesh cube = standingCube();
  const TriangleTree surface(cube.vertices, cube.faces);
  const double wall = 0.1;
  // What may be hollow is the cube of 0.8; of 1 the integral is its volume, of z − 1/2 that of its
  // upper half: 0.8² 0.4²/2.
  Moments one = Moments::Zero();
  one[0] = 1.0;
  Moments upper = Moments::Zero();
  upper[0] = -0.5;
  upper[3] = 1.0;
  // x² − z² about the middle is positive where |x| > |z|: 0.8 · 4 ∫∫ (x² − z²) dz dx over a
  // quarter.
  Moments saddle = Moments::Zero();
  saddle[0] = -0.25;
  saddle[3] = 1.0;
  saddle[4] = 1.0;
  saddle[6] = -1.0;
  const double ofSaddle = 0.8 * 2.0 / 3.0 * std::pow(0.4, 4);
  for (const auto& [quadric, exact] :
       {std::pair(one, 0.512), std::pair(upper, 0.64 * 0.08), std::pair(saddle, ofSaddle)}) {
    const double bound = positivePartBound({{}, {quadric}}, surface, wall, 1.01 * exact);
    EXPECT_GE(bound, exact);
    EXPECT_LE(bound, 1.01 * exact);
  }
}

TEST(PositivePartBound, KnowsLayers) {
  const TriangleMesh cube = standingCube();
  const TriangleTree surface(cube.vertices, cube.faces);
  Moments one = Moments::Zero();
  one[0] = 1.0;
  // −2 up to a third of the height, then x, then 3 from 0.7 on: over the cube of 0.8.
  Moments x = Moments::Zero();
  x[1] = 1.0;
  const LayeredQuadric q{{1.0 / 3.0, 0.7}, {-2.0 * one, x, 3.0 * one}};
  const double exact = (0.7 - 1.0 / 3.0) * 0.8 * 0.08 + 3.0 * 0.64 * 0.2;
  const double bound = positivePartBound(q, surface, 0.1, 1.01 * exact);
  EXPECT_GE(bound, exact);
  EXPECT_LE(bound, 1.01 * exact);
}

} // namespace
} // namespace massprops::testing
