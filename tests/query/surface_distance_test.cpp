// Distances between surfaces in closed form, by all pairs, and with memory of earlier ones.
#include "core/query/surface_distance.h"

#include "core/base/angles.h"
#include "judge/checks.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace massprops::testing {
namespace {

Vector distances(const TriangleMesh& mesh, const TriangleMesh& other, double horizon) {
  const TriangleTree tree(other.vertices, other.faces);
  return ClearanceQuery(tree).measure(mesh.vertices, mesh.faces, horizon).distance;
}

TEST(Clearance, OfConcentricBoxesIsTheirGap) {
  const TriangleMesh outer = box({1.2, 1.4, 1.6}, 2);
  const TriangleMesh inner = box({1, 1, 1}, 3);
  const Vector found = distances(inner, outer, 0.5);
  EXPECT_NEAR(found.minCoeff(), 0.1, 1e-12);
}

TEST(Clearance, SeesCrossingEdgesWhoseEndsAreFar) {
  const double quarter = kPi / 4;
  const TriangleMesh barX = transformed(box({4, 1, 1}, 1), rotation(Vec3::UnitX(), quarter));
  const TriangleMesh barY =
      transformed(transformed(box({1, 4, 1}, 1), rotation(Vec3::UnitY(), quarter)),
                  Mat3::Identity(), {0, 0, 2});
  const Vector found = distances(barX, barY, 1.0);
  EXPECT_NEAR(found.minCoeff(), 2 - std::sqrt(2.0), 1e-12);
}

TEST(Clearance, IsTheLeastDistanceOfAnyTwoTriangles) {
  const TriangleMesh outer = blob(6);
  const TriangleMesh inner = transformed(blob(5), 0.8 * Mat3::Identity(), {0.03, 0.02, -0.05});
  const Vector found = distances(inner, outer, 0.5);
  EXPECT_NEAR(found.minCoeff(), leastDistance(inner, outer), 1e-12);
}

class RememberedClearance : public ::testing::TestWithParam<double> {};

TEST_P(RememberedClearance, IsThatOfAMeasurementWithoutMemory) {
  const TriangleMesh other = blob(12);
  const TriangleTree tree(other.vertices, other.faces);
  TriangleMesh moving = transformed(blob(5), GetParam() * Mat3::Identity(), {0.01, 0.02, -0.01});
  const double horizon =
      1.4 * ClearanceQuery(tree).measure(moving.vertices, moving.faces, 1.0).distance.minCoeff();
  ClearanceQuery remembering(tree);
  std::size_t below = 0;
  // Some vertices move a little, some more, most rest; faces go, and one comes.
  for (int round = 0; round < 12; ++round) {
    const Clearance seen = remembering.measure(moving.vertices, moving.faces, horizon);
    const Clearance fresh = ClearanceQuery(tree).measure(moving.vertices, moving.faces, horizon);
    EXPECT_NEAR(seen.least, fresh.least, 1e-14);
    for (Eigen::Index v = 0; v < moving.vertices.rows(); ++v) {
      if (fresh.distance[v] >= horizon) {
        EXPECT_GE(seen.distance[v], horizon * (1.0 - 1e-12));
      } else {
        EXPECT_NEAR(seen.distance[v], fresh.distance[v], 1e-14);
        ++below;
      }
    }
    for (Eigen::Index v = round; v < moving.vertices.rows(); v += 5) {
      moving.vertices.row(v) *= 1.0 + (v % 2 == 0 ? 1e-4 : 0.02) * std::sin(static_cast<double>(v));
    }
    moving.faces.conservativeResize(moving.faces.rows() - 3, 3);
    moving.faces.row(7 * round) = moving.faces.row(7 * round).reverse().eval();
    // Vertices come and go, too.
    const Eigen::Index n = moving.vertices.rows();
    if (round % 4 == 1) {
      moving.vertices.conservativeResize(n + 1, 3);
      moving.vertices.row(n) = 0.9 * moving.vertices.row(moving.faces(0, 0));
      moving.faces(0, 0) = static_cast<int>(n);
    } else if (round % 4 == 3) {
      moving.vertices.conservativeResize(n - 1, 3);
      moving.faces.row(0) = moving.faces.row(1);
    }
  }
  EXPECT_GT(below, 60U);
}

// Inside of the other surface corners are nearest, around it the insides of faces.
INSTANTIATE_TEST_SUITE_P(Geometry, RememberedClearance, ::testing::Values(0.8, 1.3));

TEST(Clearance, NamesTheFacesThatMeetTheOtherSurface) {
  const TriangleMesh outer = sphere(6);
  const TriangleMesh inside = scaled(outer, 0.5);
  const TriangleTree tree(outer.vertices, outer.faces);
  EXPECT_TRUE(ClearanceQuery(tree).measure(inside.vertices, inside.faces, 0.1).crossing.empty());
  const TriangleMesh across = transformed(inside, Mat3::Identity(), {0.7, 0, 0});
  const std::vector<int> crossing =
      ClearanceQuery(tree).measure(across.vertices, across.faces, 0.1).crossing;
  ASSERT_FALSE(crossing.empty());
  // Each of them has corners near the outer sphere, within an edge length.
  for (const int f : crossing) {
    const double radius = across.vertices.row(across.faces(f, 0)).norm();
    EXPECT_NEAR(radius, 1.0, 0.15);
  }
}

} // namespace
} // namespace massprops::testing
