// What is left of cells outside of a surface, against closed forms.
#include "core/optimum/parts_cut.h"

#include "core/base/angles.h"
#include "core/base/cube_cut.h"
#include "core/physics/moments.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace massprops::testing {
namespace {

/// Of what is deeper than `depth` between a box of edge 2 and a ball within it.
Moments deepBetween(double radius, const Vec3& centre, double depth, int cells = 20000) {
  const TriangleMesh outer = box({2.0, 2.0, 2.0}, 3);
  const Vec3 middle =
      0.5 * (outer.vertices.colwise().minCoeff() + outer.vertices.colwise().maxCoeff()).transpose();
  const TriangleMesh ball = shifted(scaled(sphere(24), radius), middle + centre);
  const TriangleTree outside(outer.vertices, outer.faces);
  const TriangleTree inside(ball.vertices, ball.faces);
  const AdmissibleCells deep =
      cellsOf(partsOutside(inside, depth, admissibleParts(outside, depth, cells)));
  Moments sum = deep.colwise().sum().transpose();
  sum.segment<3>(1) -= sum[0] * middle;
  return sum;
}

double ballVolume(double radius) {
  return 4.0 / 3.0 * kPi * std::pow(radius, 3);
}

TEST(PartsOutside, AreWhatABallLeavesOfABox) {
  const Moments deep = deepBetween(0.5, {0.1, -0.2, 0.05}, 0.1);
  const double ball = ballVolume(0.6);
  const double volume = std::pow(1.8, 3) - ball;
  EXPECT_NEAR(deep[0], volume, 2e-3 * volume);
  const Vec3 first = -ball * Vec3(0.1, -0.2, 0.05);
  EXPECT_LT((deep.segment<3>(1) - first).norm(), 2e-3 * volume);
}

// At the narrowest place the layers leave a twentieth of the box.
TEST(PartsOutside, HaveBothBordersOfASheet) {
  const double depth = 0.1;
  const double left = 0.1;
  const double radius = 1.0 - 2.0 * depth - left;
  const double volume = std::pow(2.0 - 2.0 * depth, 3) - ballVolume(radius + depth);
  EXPECT_NEAR(deepBetween(radius, Vec3::Zero(), depth)[0], volume, 3e-3 * volume);
}

// Of two balls, a tenth of a part's width apart.
TEST(PartsOutside, HaveSheetsThinnerThanTheyAre) {
  const double depth = 0.1;
  constexpr int kAcross = 20;
  const double thickness = 0.1 * 0.5 * 2.0 / kAcross;
  const TriangleMesh outer = sphere(48);
  const TriangleMesh inner = scaled(sphere(48), 1.0 - 2.0 * depth - thickness);
  const TriangleTree outside(outer.vertices, outer.faces);
  const TriangleTree inside(inner.vertices, inner.faces);
  const AdmissibleCells deep = cellsOf(
      partsOutside(inside, depth, admissibleParts(outside, depth, kAcross * kAcross * kAcross)));
  const double volume = ballVolume(1.0 - depth) - ballVolume(1.0 - depth - thickness);
  EXPECT_NEAR(deep.col(0).sum(), volume, 0.1 * volume);
}

// A border that parts have been divided at down to a level is cut by another one that asks for
// larger parts.
TEST(PartsLeft, AreThoseOfTwoBordersInAnyOrder) {
  const TriangleMesh outer = box({1.0, 1.0, 1.0}, 2);
  const TriangleTree tree(outer.vertices, outer.faces);
  const RegionParts all = admissibleParts(tree, 0.1, 1000);
  const auto plane = [](const Vec3& slope, double at) {
    return [=] {
      return [=](const RegionPart& part, double) {
        return std::optional<Sample>({part.centre.dot(slope) - at, slope});
      };
    };
  };
  const Vec3 middle =
      0.5 * (outer.vertices.colwise().minCoeff() + outer.vertices.colwise().maxCoeff()).transpose();
  const Vec3 slope = Vec3(2, 1, 2) / 3.0;
  const double at = slope.dot(middle);
  const double thickness = 0.01;
  const auto low = plane(slope, at - 0.5 * thickness);
  const auto high = plane(-slope, -at - 0.5 * thickness);
  const double fineFirst = cellsOf(partsLeft(partsLeft(all, low, -1), high)).col(0).sum();
  const double coarseFirst = cellsOf(partsLeft(partsLeft(all, high), low, -1)).col(0).sum();
  // What may be hollow is a cube of edge 0.8.
  const double offset = 0.5 * thickness / 0.8;
  const double layer =
      std::pow(0.8, 3) * (cubeCut(slope, -offset).volume - cubeCut(slope, offset).volume);
  EXPECT_NEAR(fineFirst, layer, 5e-3 * layer);
  EXPECT_NEAR(coarseFirst, layer, 5e-3 * layer);
}

TEST(PartsOutside, AreNoneInsideOfTheSurface) {
  const TriangleMesh outer = box({1.0, 1.0, 1.0}, 2);
  const TriangleMesh around = shifted(box({3.0, 3.0, 3.0}, 2), Vec3::Constant(-1.0));
  const TriangleTree tree(outer.vertices, outer.faces);
  const TriangleTree larger(around.vertices, around.faces);
  EXPECT_TRUE(partsOutside(larger, 0.1, admissibleParts(tree, 0.1)).parts.empty());
}

} // namespace
} // namespace massprops::testing
