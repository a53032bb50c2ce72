// Where a ball fits, against closed forms.
#include "core/base/angles.h"
#include "core/contour/cavity_contour.h"
#include "core/contour/opening.h"
#include "core/mesh/components.h"
#include "core/mesh/signed_volume.h"
#include "large_test.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace massprops::testing {
namespace {

const Mat3 kAskew = Eigen::AngleAxisd(0.6, Vec3(3, 1, 2).normalized()).toRotationMatrix();

/// The depth inside of a box with its middle at the origin, before it was turned.
Sample depthInBox(const Vec3& half, const Vec3& x) {
  int axis = 0;
  const double depth = (half - x.cwiseAbs()).minCoeff(&axis);
  return {depth, kAskew * Vec3(Vec3::Unit(axis) * (x[axis] > 0.0 ? -1.0 : 1.0))};
}

/// A plate with a round hole in its middle, as C-shaped as one outline takes, halfway up at z = 0.
TriangleMesh plateWithHole(double outer, double inner, double thickness) {
  constexpr int kPieces = 200;
  constexpr double kSlit = 0.02;
  std::vector<Vec2> outline;
  const auto at = [](double radius, double angle) {
    return Vec2(radius * std::cos(angle), radius * std::sin(angle));
  };
  const auto angleOf = [&](int i) { return kSlit + (2.0 * kPi - 2.0 * kSlit) * i / kPieces; };
  for (int i = 0; i <= kPieces; ++i) outline.push_back(at(outer, angleOf(i)));
  for (int i = kPieces; i >= 0; --i) outline.push_back(at(inner, angleOf(i)));
  return shifted(prism(outline, thickness), {0.0, 0.0, -0.5 * thickness});
}

TEST(OpeningProbe, FindsTheNearestPlaceBesideAHoleInAPlateThatTheBallJustFits) {
  const double fits = 0.15;
  const double reach = 0.09;
  const double half = 0.1501;
  const double hole = 0.4;
  const TriangleMesh outer = plateWithHole(1.0, hole, 2.0 * half);
  const TriangleTree tree(outer.vertices, outer.faces);
  const Opening opening{fits, reach};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(0.0, 1.0);
  OpeningProbe probe(tree, opening);
  for (int i = 0; i < 1000; ++i) {
    const double fromHole = fits * (0.7 + 0.3 * number(random));
    const double height = (half - 0.1) * (2.0 * number(random) - 1.0);
    const double angle = 0.5 + 5.0 * number(random); // off the slit
    const Vec3 x((hole + fromHole) * std::cos(angle), (hole + fromHole) * std::sin(angle), height);
    const double away =
        std::hypot(fits - fromHole, std::max(std::abs(height) - (half - fits), 0.0));
    const auto value = probe.at(x, probe.depthAt(x, false), 1.0, 0.03);
    ASSERT_TRUE(value);
    EXPECT_NEAR(value->value, reach - away, 0.05 * reach) << x.transpose();
  }
}

TEST(OpeningProbe, FindsTheNearestPlaceInABox) {
  const double fits = 0.15;
  const double reach = 0.09;
  const double horizon = 0.03;
  // Roomy, a sheet and a bar as thin as a thousandth of the ball, and a sheet of no thickness.
  for (const Vec3& half : {Vec3(0.5, 0.4, 0.3), Vec3(0.5, 0.4, 0.15005), Vec3(0.5, 0.15005, 0.1501),
                           Vec3(0.5, 0.4, 0.15)}) {
    const TriangleMesh outer = transformed(box(2.0 * half, 3), kAskew);
    const TriangleTree tree(outer.vertices, outer.faces);
    const Vec3 middle = kAskew.transpose() * (0.5 * (tree.lower() + tree.upper()));
    ASSERT_LT(middle.norm(), 1e-6);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    int found = 0;
    int beyond = 0;
    for (int i = 0; i < 3000; ++i) {
      const Vec3 x = half.cwiseProduct(Vec3(number(random), number(random), number(random)));
      const double away =
          (x.cwiseAbs() - (half - Vec3::Constant(fits))).cwiseMax(0.0).norm(); // from all places
      OpeningProbe probe(tree, {fits, reach}); // knows of no other place
      const auto value = probe.at(kAskew * x, depthInBox(half, x), 1.0, horizon);
      if (away == 0.0) {
        ASSERT_TRUE(value);
        EXPECT_GE(value->value, reach - 1e-12) << x.transpose();
      } else if (away < reach + horizon - 1e-6) {
        ASSERT_TRUE(value) << x.transpose() << ' ' << away;
        EXPECT_NEAR(value->value, reach - away, 1e-6) << x.transpose();
        EXPECT_NEAR(value->slope.norm(), 1.0, 1e-9);
        ++found;
      } else if (away > reach + horizon + 1e-6) {
        EXPECT_FALSE(value) << x.transpose();
        ++beyond;
      }
    }
    EXPECT_GT(found, 100);
    EXPECT_GT(beyond, 10);
  }
}

TEST(OpeningProbe, FindsNoPlaceInASheetThatIsTooThin) {
  const Vec3 half(0.5, 0.4, 0.149);
  const TriangleMesh outer = transformed(box(2.0 * half, 3), kAskew);
  const TriangleTree tree(outer.vertices, outer.faces);
  OpeningProbe probe(tree, {0.15, 0.09});
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (int i = 0; i < 500; ++i) {
    const Vec3 x = half.cwiseProduct(Vec3(number(random), number(random), number(random)));
    EXPECT_FALSE(probe.at(kAskew * x, depthInBox(half, x), 1.0, 0.03));
  }
}

// Of two plates too thin for the ball the corner where they meet has place for it: around the edge
// that bulges into the room depth does not bend down.
TEST(OpeningProbe, FindsTheCornerOfTwoThinPlates) {
  const double thickness = 0.26;
  const double fits = 0.15;
  const double reach = 0.09;
  std::vector<std::array<int, 3>> cells{{0, 0, 0}};
  for (int i = 1; i < 5; ++i) {
    cells.push_back({i, 0, 0});
    cells.push_back({0, i, 0});
  }
  std::vector<std::array<int, 3>> tall; // so that its ends are far away
  for (const auto& cell : cells) {
    for (int k = 0; k < 5; ++k) tall.push_back({cell[0], cell[1], k});
  }
  TriangleMesh outer = polycube(tall, 1);
  outer.vertices *= thickness;
  const TriangleTree tree(outer.vertices, outer.faces);
  std::vector<Vec2> places;
  for (int i = 0; i < 400; ++i) {
    for (int j = 0; j < 400; ++j) {
      const Vec2 place = Vec2::Constant(fits) + 0.0005 * Vec2(i, j);
      if ((place - Vec2::Constant(thickness)).norm() >= fits && place.maxCoeff() < thickness)
        places.push_back(place);
    }
  }
  ASSERT_FALSE(places.empty());
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(0.01, 0.5);
  int found = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec2 inPlane(number(random), number(random));
    if (inPlane.minCoeff() > thickness - 0.01) continue;
    double away = 1.0;
    for (const Vec2& place : places) away = std::min(away, (place - inPlane).norm());
    const Vec3 x(inPlane.x(), inPlane.y(), 2.5 * thickness);
    OpeningProbe probe(tree, {fits, reach});
    const auto value = probe.at(x, probe.depthAt(x, true), 1.0, 0.02);
    if (away < reach - 0.01) {
      ASSERT_TRUE(value) << x.transpose();
      EXPECT_GT(std::min(value->value, reach), reach - away - 0.01) << x.transpose();
      ++found;
    }
    if (value) {
      EXPECT_LT(std::min(value->value, reach), reach - away + 0.001) << x.transpose();
    }
  }
  EXPECT_GT(found, 50);
}

// Else bodies would depend on how threads take turns.
TEST(OpeningProbe, FindsTheSameWhetherAnotherProbeCameBeforeIt) {
  const TriangleMesh outer = transformed(box(Vec3(1.0, 0.8, 0.3), 7), kAskew);
  const TriangleTree tree(outer.vertices, outer.faces);
  const Opening opening{0.145, 0.3};
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  std::vector<Vec3> points;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 x(number(random), number(random), number(random));
    points.emplace_back(kAskew * Vec3(0.49, 0.39, 0.149).cwiseProduct(x));
  }
  constexpr double kSlack = 0.05;
  const auto values = [&](const Opening& places) {
    OpeningProbe probe(tree, places, kSlack);
    std::vector<Sample> result;
    for (const Vec3& x : points) {
      const auto value = probe.at(x, probe.depthAt(x, true), 0.29, 0.02);
      result.push_back(value.value_or(Sample{-1.0, Vec3::Zero()}));
    }
    return result;
  };
  const std::vector<Sample> first = values(opening);
  const std::vector<Sample> second = values(opening);
  int found = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(first[i].value, second[i].value) << i;
    EXPECT_EQ(first[i].slope, second[i].slope) << i;
    if (first[i].value > 0.0 && first[i].value < 0.29) ++found;
  }
  EXPECT_GT(found, 300);
}

// A plate three walls thick has room for a sheet as wide as a wall.
TEST(CavityContour, OfAPlateHardlyWiderThanThreeWallsIsASheet) {
  const double wall = 0.02;
  for (const double room : {1.0, 1.003, 1.05}) {
    const Vec3 size(1.0, 0.8, (2.0 + room) * wall);
    const TriangleMesh outer = transformed(box(size, 3), kAskew);
    const TriangleTree tree(outer.vertices, outer.faces);
    const auto cavity = cavityContour(openedSet(tree, wall, 0.5 * wall), {});
    ASSERT_TRUE(cavity);
    const TriangleMesh& mesh = cavity->contour.mesh;
    const double volume = (size - Vec3::Constant(2.0 * wall)).prod();
    EXPECT_NEAR(signedVolume(mesh.vertices, mesh.faces), volume, 0.01 * volume) << room;
    EXPECT_LT(mesh.faces.rows(), 5000) << room; // of 30,000 before flat parts are thinned out
  }
}

// There is room only where the rim of a pan meets its floor: from far away cutting planes find no
// place there.
TEST(CavityContour, OfAThinPanIsARing) {
  LARGE_TEST();
  const double wall = 0.014;
  const double rim = 0.03;
  const double floor = 0.04;
  const TriangleMesh outer = revolved(
      {{0, floor}, {0.49 - rim, floor}, {0.49 - rim, 0.15}, {0.49, 0.15}, {0.49, 0}, {0, 0}}, 100);
  const TriangleTree tree(outer.vertices, outer.faces);
  // Behind the walls where they meet, and beside that as far as the ball reaches at most.
  const double length = 2.0 * kPi * (0.49 - 0.5 * rim);
  const double least = length * (rim - 2.0 * wall) * (floor - 2.0 * wall);
  const double most = least + length * 1.5 * wall * (rim + floor - 4.0 * wall);
  for (const double edge : {0.3, 0.4, 0.53}) {
    const auto cavity = cavityContour(openedSet(tree, wall, edge * wall), {});
    ASSERT_TRUE(cavity);
    const TriangleMesh& mesh = cavity->contour.mesh;
    EXPECT_EQ(connectedComponents(mesh.vertices.rows(), mesh.faces).size(), 1) << edge;
    const double volume = signedVolume(mesh.vertices, mesh.faces);
    EXPECT_GT(volume, least) << edge;
    EXPECT_LT(volume, most) << edge;
  }
}

} // namespace
} // namespace massprops::testing
