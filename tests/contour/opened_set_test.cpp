// What belongs to a cavity without narrow channels, against closed forms.
#include "core/contour/opened_set.h"

#include "core/base/angles.h"
#include "core/base/triangle.h"
#include "large_test.h"
#include "shapes.h"

#include <gtest/gtest.h>

namespace massprops::testing {
namespace {

TEST(OpenedSet, LosesACollarThinnerThanAWall) {
  LARGE_TEST();
  const double wall = 0.05;
  for (const double room : {0.6, 1.6}) {
    // A cylinder of radius 0.4 and height 1, around it a disc of radius 1; `room` walls of the disc
    // may be hollow.
    const double half = 0.5 * (2.0 + room) * wall;
    const TriangleMesh outer = revolved({{0.0, 0.5},
                                         {0.4, 0.5},
                                         {0.4, half},
                                         {1.0, half},
                                         {1.0, -half},
                                         {0.4, -half},
                                         {0.4, -0.5},
                                         {0.0, -0.5}},
                                        96);
    const TriangleTree tree(outer.vertices, outer.faces);
    const RegionParts all = admissibleParts(tree, wall, 40000);
    const double everything = cellsOf(all).col(0).sum();
    const double opened =
        cellsWithin(
            openedSet(tree, wall, edgeOfCubes(surfaceArea(outer.vertices, outer.faces), 40000)),
            all)
            .col(0)
            .sum();
    const double within = kPi * std::pow(0.4 - wall, 2) * (1.0 - 2.0 * wall);
    const double ring = kPi * (std::pow(1.0 - wall, 2) - std::pow(0.4 - wall, 2)) * room * wall;
    EXPECT_NEAR(everything, within + ring, 0.01 * (within + ring));
    if (room < 1.0) {
      // What is left of the ring is not farther from the cylinder's deep part than 0.9 walls.
      const double rest = kPi * (0.16 - std::pow(0.4 - wall, 2)) * room * wall;
      EXPECT_GT(opened, 0.99 * within);
      EXPECT_LT(opened, 1.01 * (within + rest));
    } else {
      EXPECT_NEAR(opened, everything, 1e-3 * everything);
    }
  }
}

TEST(OpenedSet, IsEmptyWhereNoBallFits) {
  const TriangleMesh outer = box({1.0, 1.0, 0.27}, 3);
  const TriangleTree tree(outer.vertices, outer.faces);
  const OpenedSet set =
      openedSet(tree, 0.1, edgeOfCubes(surfaceArea(outer.vertices, outer.faces), 20000));
  EXPECT_EQ(cellsWithin(set, admissibleParts(tree, 0.1)).rows(), 0);
}

// A disc that tapers to its rim: rooms end where both walls and the ball's reach meet.
TEST(OpenedSet, IsAboutAsLargeInCellsOfAnySize) {
  LARGE_TEST();
  const double wall = 0.05;
  const Mat3 turn = Eigen::AngleAxisd(0.6, Vec3(3, 1, 2).normalized()).toRotationMatrix();
  const TriangleMesh outer =
      transformed(revolved({{0.0, 0.09}, {1.0, 0.06}, {1.0, -0.06}, {0.0, -0.09}}, 96), turn);
  const TriangleTree tree(outer.vertices, outer.faces);
  const OpenedSet set = openedSet(tree, wall, 0.03);
  const auto volume = [&](const RegionParts& parts) {
    return cellsWithin(set, parts).col(0).sum();
  };
  const double fine = volume(admissibleParts(tree, wall, 2000000));
  EXPECT_NEAR(volume(admissibleParts(tree, wall, 20000)), fine, 6e-3 * fine);
}

} // namespace
} // namespace massprops::testing
