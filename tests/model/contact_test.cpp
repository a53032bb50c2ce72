// Contact areas and tipping angles against geometry that is known without them.
#include "core/model/contact.h"

#include "core/base/angles.h"
#include "shapes.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace massprops::testing {
namespace {

ContactArea square(double side) {
  const double h = side / 2;
  return {{{-h, -h}, {h, -h}, {h, h}, {-h, h}}, {}};
}

ContactArea ellipse(double rx, double ry) {
  return {{}, Vec2(rx, ry)};
}

/// The definition, by brute force over 100,000 directions; the angle changes by less than
/// (2π/1e5)·|c|/c_z from one to the next and its minimum, being smooth, by the square of that.
double angleByDefinition(const ContactArea& area, const Vec3& c) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 100000; ++i) {
    const double t = 2 * kPi * i / 100000;
    const Vec2 u(std::cos(t), std::sin(t));
    double farthest = -std::numeric_limits<double>::infinity();
    if (area.radii) {
      for (int j = 0; j < 1; ++j)
        farthest =
            std::sqrt(std::pow(area.radii->x() * u.x(), 2) + std::pow(area.radii->y() * u.y(), 2));
    } else {
      for (const Vec2& p : area.polygon) farthest = std::max(farthest, u.dot(p));
    }
    least = std::min(least, std::atan2(farthest - u.dot(c.head<2>()), c.z()) * kDegrees);
  }
  return least;
}

TEST(TippingAngle, OfACubeIsFortyFiveDegrees) {
  EXPECT_NEAR(tippingAngle(square(1.0), {0, 0, 0.5}), 45.0, 1e-12);
}

TEST(TippingAngle, OfABoxIsTheArcTangentOfHalfItsWidthOverHalfItsHeight) {
  for (const double height : {0.1, 1.0, 10.0}) {
    EXPECT_NEAR(tippingAngle(square(1.0), {0, 0, height / 2}),
                std::atan2(0.5, height / 2) * kDegrees, 1e-12);
  }
}

TEST(TippingAngle, IsZeroAboveTheBorderAndNegativeBeyondIt) {
  EXPECT_NEAR(tippingAngle(square(1.0), {0.5, 0.1, 0.7}), 0.0, 1e-12);
  EXPECT_NEAR(tippingAngle(square(1.0), {0.8, 0.1, 0.7}), std::atan2(-0.3, 0.7) * kDegrees, 1e-12);
  // Beyond a corner the nearest point is the corner itself: 3, 4, 5.
  EXPECT_NEAR(tippingAngle(square(1.0), {0.8, 0.9, 1.0}), std::atan2(-0.5, 1.0) * kDegrees, 1e-12);
}

TEST(TippingAngle, OfADiscDependsOnTheDistanceFromItsCentreOnly) {
  const ContactArea disc = ellipse(0.3, 0.3);
  for (int i = 0; i < 7; ++i) {
    const double t = 0.9 * i;
    for (const double r : {0.0, 0.1, 0.29, 0.5}) {
      // The minimum is found by golden sections in the direction's angle: half of 16 digits.
      EXPECT_NEAR(tippingAngle(disc, {r * std::cos(t), r * std::sin(t), 0.8}),
                  std::atan2(0.3 - r, 0.8) * kDegrees, 1e-7);
    }
  }
}

TEST(TippingAngle, IsTheLeastOverAllDirections) {
  Random random(3);
  for (int trial = 0; trial < 10; ++trial) {
    const Vec3 c(0.6 * random(), 0.6 * random(), 0.6 + 0.3 * random());
    const ContactArea triangle{{{-0.4, -0.3}, {0.5, -0.2}, {0.0, 0.45}}, {}};
    for (const ContactArea& area : {square(0.7), triangle, ellipse(0.5, 0.2)}) {
      EXPECT_NEAR(tippingAngle(area, c), angleByDefinition(area, c), 5e-3) << "trial " << trial;
    }
  }
}

TEST(SignedDistance, IsThatFromTheNearestPointOfTheBorder) {
  EXPECT_NEAR(signedDistance(square(2.0), {0.7, 0.2}), 0.3, 1e-15);
  EXPECT_NEAR(signedDistance(square(2.0), {1.5, 0.2}), -0.5, 1e-15);
  EXPECT_NEAR(signedDistance(square(2.0), {4.0, -5.0}), -5.0, 1e-15); // beyond a corner: 3, 4, 5
  // Along the normal of a point of the ellipse, which then is the nearest.
  const double t = 0.7;
  const Vec2 p(3 * std::cos(t), std::sin(t));
  const Vec2 normal = Vec2(std::cos(t) / 3, std::sin(t)).normalized();
  EXPECT_NEAR(signedDistance(ellipse(3.0, 1.0), p + 2.0 * normal), -2.0, 1e-9);
  EXPECT_NEAR(signedDistance(ellipse(3.0, 1.0), p - 0.2 * normal), 0.2, 1e-9);
}

TEST(TippingAngle, DoesNotDependOnTheUnit) {
  const Vec3 c(0.1, -0.2, 0.5);
  for (const ContactArea& area : {square(0.7), ellipse(0.5, 0.2)}) {
    EXPECT_NEAR(tippingAngle(scaled(area, 1e-3), c * 1e3), tippingAngle(area, c), 1e-6);
  }
}

TEST(Extent, IsTheSupportFunction) {
  EXPECT_NEAR(extent(square(2.0), Vec2(1, 0)), 1.0, 1e-15);
  EXPECT_NEAR(extent(square(2.0), Vec2(1, 1).normalized()), std::sqrt(2.0), 1e-15);
  EXPECT_NEAR(extent(ellipse(3.0, 1.0), Vec2(1, 0)), 3.0, 1e-15);
  EXPECT_NEAR(extent(ellipse(3.0, 1.0), Vec2(0, 1)), 1.0, 1e-15);
  // The largest u·p over points p of the ellipse, found by scanning it.
  const Vec2 u = Vec2(0.6, 0.8);
  double farthest = 0.0;
  for (int i = 0; i < 100000; ++i) {
    const double t = 2 * kPi * i / 100000;
    farthest = std::max(farthest, u.dot(Vec2(3 * std::cos(t), std::sin(t))));
  }
  EXPECT_NEAR(extent(ellipse(3.0, 1.0), u), farthest, 1e-8);
}

TEST(GroundContact, OfABoxIsItsBase) {
  const TriangleMesh mesh = transformed(box({1, 2, 3}, 4), Mat3::Identity(), {5, 6, 7});
  const GroundContact contact = groundContact(mesh.vertices, {});
  EXPECT_LT((contact.centre - Vec3(5, 6, 5.5)).norm(), 1e-12);
  ASSERT_EQ(contact.area.polygon.size(), 4U); // no corners within the sides
  EXPECT_NEAR(extent(contact.area, Vec2(1, 0)), 0.5, 1e-12);
  EXPECT_NEAR(extent(contact.area, Vec2(0, -1)), 1.0, 1e-12);
}

TEST(GroundContact, OfTwoFeetIsTheirConvexHull) {
  // Two columns and a bridge: the ground between the feet counts.
  const TriangleMesh bridge = polycube({{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {2, 0, 1}, {2, 0, 0}}, 2);
  const GroundContact contact = groundContact(bridge.vertices, {});
  EXPECT_LT((contact.centre - Vec3(1.5, 0.5, 0)).norm(), 1e-12);
  EXPECT_NEAR(extent(contact.area, Vec2(1, 0)), 1.5, 1e-12);
  EXPECT_NEAR(extent(contact.area, Vec2(0, 1)), 0.5, 1e-12);
}

TEST(GroundContact, HasTheCentroidOfItsAreaNotOfItsCorners) {
  // A right triangle whose longest side carries many contact points.
  Points points(9, 3);
  points << 0, 0, 0, 3, 0, 0, 0, 3, 0, 0.6, 2.4, 0, 1.2, 1.8, 0, 1.8, 1.2, 0, 2.4, 0.6, 0, 1, 1, 5,
      2.9, 0.1, 0;
  EXPECT_LT((groundContact(points, {}).centre - Vec3(1, 1, 0)).norm(), 1e-12);
}

TEST(GroundContact, OfABallIsRefusedUnlessRadiiAreGiven) {
  const TriangleMesh ball = sphere(5);
  try {
    requireArea(groundContact(ball.vertices, {}).area);
    FAIL() << "a point is no contact area";
  } catch (const InvalidInput& e) {
    EXPECT_NE(std::string(e.what()).find("radius_x"), std::string::npos);
  }
  const GroundContact contact = groundContact(ball.vertices, Vec2(0.2, 0.1));
  EXPECT_NEAR(extent(contact.area, Vec2(1, 0)), 0.2, 1e-15);
  EXPECT_NEAR(contact.centre.z(), ball.vertices.col(2).minCoeff(), 1e-15);
}

TEST(GroundContact, MovesAndScalesWithTheModel) {
  const TriangleMesh mesh = figure(2);
  const GroundContact before = groundContact(mesh.vertices, {});
  const Points moved = (1e3 * mesh.vertices).rowwise() + Eigen::RowVector3d(40, 50, 60);
  const GroundContact after = groundContact(moved, {});
  EXPECT_LT((after.centre - 1e3 * before.centre - Vec3(40, 50, 60)).norm(), 1e-8);
  ASSERT_EQ(after.area.polygon.size(), before.area.polygon.size());
  EXPECT_NEAR(extent(after.area, Vec2(1, 0)), 1e3 * extent(before.area, Vec2(1, 0)), 1e-8);
}

TEST(GroundContact, IsFoundFarFromTheOrigin) {
  // A layer matrix moves the floats of a file by numbers of double precision.
  const Vec3 shift(5e6, -5e6, 5e6);
  for (const double size : {1e-2, 1.0, 1e2}) {
    // A shaft on a foot of a twentieth of its height, and on a round one of many corners.
    for (const TriangleMesh& mesh :
         {box({0.05, 0.05, 1}, 2),
          transformed(ellipsoid({0.05, 0.05, 1}, 16), Mat3::Identity(), {0, 0, 0.5})}) {
      Points here = size * mesh.vertices;
      here.col(2) = here.col(2).cwiseMax(-0.4 * size); // cut flat
      here = here.cast<float>().cast<double>();
      const GroundContact near = groundContact(here, {});
      const GroundContact far = groundContact(here.rowwise() + shift.transpose(), {});
      ASSERT_GE(near.area.polygon.size(), 4U);
      ASSERT_GE(far.area.polygon.size(), 4U) << "of size " << size;
      // Two roundings of coordinates as large as the shift.
      EXPECT_LT((far.centre - shift - near.centre).norm(), 4e-9);
      for (const Vec2& u : {Vec2(1, 0), Vec2(0, 1), Vec2(0.6, -0.8)}) {
        EXPECT_NEAR(extent(far.area, u), extent(near.area, u), 4e-9);
      }
    }
  }
}

} // namespace
} // namespace massprops::testing
