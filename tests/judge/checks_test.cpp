// The second opinions themselves see what they are to see.
#include "judge/checks.h"

#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace massprops::testing {
namespace {

TEST(Checks, SeeEveryKindOfSelfIntersection) {
  EXPECT_EQ(intersectingPairs(blob(4)), 0U);
  EXPECT_EQ(intersectingPairs(box({1, 1, 1}, 3)), 0U); // coplanar neighbours are fine
  // No shared vertex: a vertex pulled through the opposite side.
  TriangleMesh pierced = sphere(4);
  pierced.vertices.row(0) *= -1.5;
  EXPECT_GT(intersectingPairs(pierced), 0U);
  // A shared edge: the neighbour folded flat onto a triangle.
  TriangleMesh folded;
  folded.vertices.resize(4, 3);
  folded.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.2, 0.3, 0;
  folded.faces.resize(2, 3);
  folded.faces << 0, 1, 2, 1, 0, 3;
  EXPECT_EQ(intersectingPairs(folded), 1U);
  folded.vertices.row(3) << 0.2, -0.3, 0;
  EXPECT_EQ(intersectingPairs(folded), 0U);
  // A shared corner: the opposite edge of one goes through the other.
  TriangleMesh crossed;
  crossed.vertices.resize(5, 3);
  crossed.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.3, 0.2, 0.5, 0.2, 0.3, -0.5;
  crossed.faces.resize(2, 3);
  crossed.faces << 0, 1, 2, 0, 3, 4;
  EXPECT_EQ(intersectingPairs(crossed), 1U);
  crossed.vertices(4, 2) = 0.4;
  EXPECT_EQ(intersectingPairs(crossed), 0U);
}

TEST(Checks, TellInsideFromOutside) {
  const TriangleMesh mesh = torus(2, 0.5, 24, 12);
  EXPECT_NEAR(windingNumber(mesh, {2, 0, 0}), 1.0, 1e-12);
  EXPECT_NEAR(windingNumber(mesh, {0, 0, 0}), 0.0, 1e-12); // in the hole
  EXPECT_NEAR(windingNumber(reversed(mesh), {2, 0, 0}), -1.0, 1e-12);
  EXPECT_TRUE(isInside(scaled(blob(4), 0.5), blob(4)));
  EXPECT_FALSE(isInside(scaled(blob(4), 1.5), blob(4)));
  EXPECT_EQ(intersectingPairs(scaled(blob(4), 0.5), blob(4)), 0U);
  EXPECT_GT(intersectingPairs(transformed(blob(4), Mat3::Identity(), {0.5, 0, 0}), blob(4)), 0U);
}

TEST(Checks, MeasureDistancesBetweenFacesEdgesAndCorners) {
  const TriangleMesh cube = box({1, 1, 1}, 1);
  // Face to face, with coarse triangles whose corners are far from each other.
  EXPECT_NEAR(leastDistance(cube, box({1.2, 1.4, 1.6}, 3)), 0.1, 1e-12);
  // Crossing edges: two square bars, turned on edge and laid across each other.
  const double quarter = std::acos(-1.0) / 4;
  const TriangleMesh barX = transformed(box({4, 1, 1}, 1), rotation(Vec3::UnitX(), quarter));
  const TriangleMesh barY =
      transformed(transformed(box({1, 4, 1}, 1), rotation(Vec3::UnitY(), quarter)),
                  Mat3::Identity(), {0, 0, 2});
  EXPECT_NEAR(leastDistance(barX, barY), 2 - std::sqrt(2.0), 1e-12);
}

TEST(Checks, IntegrateBoxesExactly) {
  const TriangleMesh mesh = transformed(box({1, 2, 3}, 2), Mat3::Identity(), {0.5, 1, 1.5});
  Eigen::Matrix<double, 10, 1> expected;
  expected << 6, 3, 6, 9, 2, 8, 18, 3, 9, 4.5;
  // The rule's coefficients have 15 digits.
  EXPECT_LT((quadratureMoments(mesh) - expected).cwiseAbs().maxCoeff(), 1e-12 * 18);
}

TEST(Checks, IntegrateWhatLiesBelowALevel) {
  const Mat3 turn = someRotation();
  const Vec3 up = turn.col(2);
  const TriangleMesh turned = transformed(box({1, 2, 3}, 2), turn, {0.3, -0.2, 0.1});
  const double level = up.dot(Vec3(0.3, -0.2, 0.1)) - 0.4; // 1.1 above the box's foot
  const Eigen::Vector4d below = momentsOfColumns(turned, up, level);
  EXPECT_NEAR(below[0], 2.2, 1e-12);
  const Vec3 centre = Vec3(0.3, -0.2, 0.1) + turn * Vec3(0, 0, 0.55 - 1.5);
  EXPECT_LT((below.tail<3>() - 2.2 * centre).norm(), 1e-12);
}

TEST(Checks, CountEdges) {
  EXPECT_TRUE(isClosedAndOriented(figure(2)));
  EXPECT_EQ(eulerCharacteristic(figure(2)), 2);
  EXPECT_EQ(eulerCharacteristic(torus(2, 0.5, 12, 8)), 0);
  TriangleMesh open = box({1, 1, 1}, 1);
  open.faces.conservativeResize(11, 3);
  EXPECT_FALSE(isClosedAndOriented(open));
}

TEST(Checks, TellSharpEdges) {
  const TriangleMesh cube = box({1, 1, 1}, 1); // 12 edges, and 6 across its sides
  EXPECT_NEAR(shareOfSharpEdges(cube, 89.0), 12.0 / 18.0, 1e-12);
  EXPECT_EQ(shareOfSharpEdges(cube, 91.0), 0.0);
}

} // namespace
} // namespace massprops::testing
