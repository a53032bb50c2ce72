// What a cavity may take in rooms hardly wider than a wall, against closed forms.
#include "core/best/best_cavity.h"

#include "core/base/angles.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace massprops::testing {
namespace {

/// A cylinder of radius 0.4 and height 1, around it a disc of radius 1 and this thickness; askew.
TriangleMesh cylinderInDisc(double thickness) {
  const double half = 0.5 * thickness;
  const Mat3 turn = Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  return transformed(revolved({{0.0, 0.5},
                               {0.4, 0.5},
                               {0.4, half},
                               {1.0, half},
                               {1.0, -half},
                               {0.4, -half},
                               {0.4, -0.5},
                               {0.0, -0.5}},
                              96),
                     turn);
}

struct Volumes {
  double behindWall, wide, cylinder;
};

Volumes volumesWith(double room) {
  const double wall = 0.05;
  const TriangleMesh outer = cylinderInDisc((2.0 + room) * wall);
  const TriangleTree tree(outer.vertices, outer.faces);
  const RegionParts behindWall = resolvedParts(tree, wall);
  const AdmissibleCells cells = cellsOf(behindWall);
  const Deliverable found = deliverableSet(tree, wall, behindWall, cells);
  EXPECT_EQ(found.set.ball, wall);
  return {cells.col(0).sum(), found.cells.col(0).sum(),
          kPi * std::pow(0.4 - wall, 2) * (1.0 - 2.0 * wall)};
}

TEST(DeliverableSet, HasRoomsHardlyWiderThanTheWall) {
  for (const double room : {1.0, 1.002, 1.02, 1.1, 1.5}) {
    const Volumes volumes = volumesWith(room);
    ASSERT_GT(volumes.behindWall, 1.3 * volumes.cylinder);
    // The ball does not reach all of the disc's rim.
    EXPECT_GT(volumes.wide, 0.97 * volumes.behindWall) << room;
    EXPECT_LE(volumes.wide, (1.0 + 1e-9) * volumes.behindWall) << room;
  }
}

TEST(DeliverableSet, LosesRoomsHardlyNarrowerThanTheWall) {
  const Volumes volumes = volumesWith(0.9);
  ASSERT_GT(volumes.behindWall, 1.3 * volumes.cylinder);
  EXPECT_LT(volumes.wide, 1.1 * volumes.cylinder);
  EXPECT_GT(volumes.wide, 0.99 * volumes.cylinder);
}

} // namespace
} // namespace massprops::testing
