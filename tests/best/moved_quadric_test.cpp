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

/// A step of the cap's cut, upwards.
Points raised(const Cap& cap, double step) {
  Points vertices = cap.contour.mesh.vertices;
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    if (cap.contour.on[static_cast<std::size_t>(v)] == On::Cut) vertices(v, 2) += step;
  }
  return vertices;
}

TEST(MovingQuadric, GoesWithItsCutAndStaysWhereThatIsNear) {
  Cap cap = capAbove(0.2);
  MovingQuadric moving(cap.plane);
  moving.begin();
  EXPECT_FALSE(moving.follow(cap.contour, raised(cap, 0.01), 0.1));
  EXPECT_FALSE(moving.hasMoved());
  EXPECT_TRUE(moving.follow(cap.contour, raised(cap, 0.1), 0.1));
  EXPECT_TRUE(moving.hasMoved());
  EXPECT_NEAR(cap.plane.valueAt(Vec3(0.1, 0.2, 0.3)), 0.0, 1e-2);
  moving.begin();
  EXPECT_TRUE(moving.isAsMeant(capAbove(0.3).contour));
  EXPECT_FALSE(moving.hasMoved());
  EXPECT_FALSE(moving.isAtRest());
}

TEST(MovingQuadric, GoesBackFromWhereItWasNotMeantToGo) {
  Cap cap = capAbove(0.2);
  const Moments before = cap.plane.quadrics.front();
  MovingQuadric moving(cap.plane);
  EXPECT_TRUE(moving.follow(cap.contour, raised(cap, 0.1), 0.1));
  EXPECT_NE(cap.plane.quadrics.front(), before);
  moving.begin();
  EXPECT_FALSE(moving.isAsMeant(capAbove(-0.5).contour));
  EXPECT_TRUE(moving.hasMoved());
  EXPECT_TRUE(moving.isAtRest());
  EXPECT_EQ(cap.plane.quadrics.front(), before);
}

} // namespace
} // namespace massprops::testing
