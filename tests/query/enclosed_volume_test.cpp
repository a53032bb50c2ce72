#include "core/query/enclosed_volume.h"

#include "judge/checks.h"
#include "shapes.h"

#include <gtest/gtest.h>

namespace massprops::testing {
namespace {

TEST(EnclosedVolume, IsThatOfABallAlsoWithAHole) {
  const TriangleMesh ball = sphere(12);
  TriangleMesh open = ball;
  open.faces.conservativeResize(open.faces.rows() - 8, 3);
  const double expected = quadratureMoments(ball)[0];
  EXPECT_NEAR(enclosedVolume(ball), expected, 0.005 * expected); // of the lines at its rim
  EXPECT_NEAR(enclosedVolume(open), expected, 0.01 * expected);
  EXPECT_NEAR(enclosedVolume(reversed(ball)), enclosedVolume(ball), 1e-9);
}

TEST(EnclosedVolume, CountsOverlapsOnceAndNoCavities) {
  const TriangleMesh two = joined(box({2, 1, 1}, 3), shifted(box({2, 1, 1}, 2), {1, 0, 0}));
  EXPECT_NEAR(enclosedVolume(two), 3.0, 0.03);
  const TriangleMesh hollow = joined(box({2, 2, 2}, 3), reversed(box({1, 1, 1}, 2)));
  EXPECT_NEAR(enclosedVolume(hollow), 7.0, 0.07);
}

TEST(EnclosedVolume, SeesThinPlatesWhateverTheyFace) {
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 size = Vec3::Ones();
    size[axis] = 1e-4;
    // Beside a small body, so that the box is no plate.
    const TriangleMesh both = joined(box(size, 2), shifted(box({0.01, 0.01, 0.01}), {1, 1, 1}));
    EXPECT_NEAR(enclosedVolume(both), 1e-4, 0.05e-4) << axis;
  }
}

TEST(EnclosedVolume, OfABoxWithoutLidIsTheBoxs) {
  const TriangleMesh whole = box({2, 2, 2}, 4);
  TriangleMesh open = whole;
  Eigen::Index rows = 0;
  for (Eigen::Index f = 0; f < whole.faces.rows(); ++f) {
    double height = 1.0;
    for (const int v : whole.faces.row(f)) height = std::min(height, whole.vertices(v, 2));
    if (height < 0.999) open.faces.row(rows++) = whole.faces.row(f);
  }
  open.faces.conservativeResize(rows, 3);
  EXPECT_NEAR(enclosedVolume(open), 8.0, 0.1);
}

TEST(EnclosedVolume, OfNothingIsZero) {
  EXPECT_EQ(enclosedVolume({}), 0.0);
  EXPECT_EQ(enclosedVolume({box({1, 1, 1}).vertices, Faces(0, 3)}), 0.0);
}

} // namespace
} // namespace massprops::testing
