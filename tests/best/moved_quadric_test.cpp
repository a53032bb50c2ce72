// The quadric through points of another one's cut is that one.
#include "core/best/moved_quadric.h"

#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace massprops::testing {
namespace {

/// A cap of a sphere's surface, cut off by a plane: its points on the cut, the others beyond.
struct Cap {
  Contour contour;
  LayeredQuadric plane;
};

Cap capAbove(double height) {
  Cap cap;
  cap.contour.mesh = sphere(12);
  Points& vertices = cap.contour.mesh.vertices;
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    const bool isCut = vertices(v, 2) < height;
    if (isCut) vertices(v, 2) = height;
    cap.contour.on.push_back(isCut ? On::Cut : On::Inset);
  }
  Moments plane = Moments::Zero();
  plane[0] = -height;
  plane[3] = 1.0;
  cap.plane = LayeredQuadric::ofOneLayer(plane);
  return cap;
}

TEST(QuadricThrough, IsThatOfTheMovedCut) {
  const Cap cap = capAbove(0.2);
  Points vertices = cap.contour.mesh.vertices;
  const auto heightAt = [](double x, double y) { return 0.25 + 0.1 * x - 0.05 * y * y; };
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    if (cap.contour.on[static_cast<std::size_t>(v)] == On::Cut)
      vertices(v, 2) = heightAt(vertices(v, 0), vertices(v, 1));
  }
  const auto moved = quadricThrough(cap.plane, cap.contour, vertices);
  ASSERT_TRUE(moved);
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    const Vec3 x = vertices.row(v).transpose();
    if (cap.contour.on[static_cast<std::size_t>(v)] == On::Cut) {
      EXPECT_NEAR(moved->valueAt(x), 0.0, 1e-3) << x.transpose();
    } else {
      EXPECT_EQ(moved->valueAt(x) > 0.0, x.z() > heightAt(x.x(), x.y())) << x.transpose();
    }
  }
}

TEST(QuadricThrough, IsNoneWhereTheCutWentNowhereNearOne) {
  const Cap cap = capAbove(0.2);
  Points vertices = cap.contour.mesh.vertices;
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    if (cap.contour.on[static_cast<std::size_t>(v)] == On::Cut)
      vertices(v, 2) += 0.05 * std::sin(40.0 * vertices(v, 0));
  }
  EXPECT_FALSE(quadricThrough(cap.plane, cap.contour, vertices));
}

TEST(QuadricThrough, StaysInLayersWithoutACut) {
  Cap cap = capAbove(0.2);
  const Moments plane = cap.plane.quadrics.front();
  cap.plane = {{0.8}, {plane, 2.0 * plane}};
  Points vertices = cap.contour.mesh.vertices;
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    if (cap.contour.on[static_cast<std::size_t>(v)] == On::Cut) vertices(v, 2) += 0.1;
  }
  const auto moved = quadricThrough(cap.plane, cap.contour, vertices);
  ASSERT_TRUE(moved);
  EXPECT_EQ(moved->quadrics[1], Moments(2.0 * plane));
  EXPECT_GT((moved->quadrics[0] - plane).norm(), 0.01);
}

} // namespace
} // namespace massprops::testing
