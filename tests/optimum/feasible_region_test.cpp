// Where a cavity may be, against closed forms.
#include "core/optimum/feasible_region.h"

#include "core/base/angles.h"
#include "core/base/triangle.h"
#include "core/optimum/admissible_cells.h"
#include "core/physics/moments.h"
#include "shapes.h"
#include "thread_count.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <stdexcept>
#include <vector>

namespace massprops::testing {
namespace {

const Mat3 kAskew = Eigen::AngleAxisd(0.6, Vec3(3, 1, 2).normalized()).toRotationMatrix();
constexpr double kMostCells = 20000.0;

double volumeOf(const FeasibleRegion& region, Admissible which = Admissible::Reached) {
  return admissibleCells(region, which, kMostCells).col(0).sum();
}

/// Places in each of which one cube of one edge lies, and whether it is on the border.
struct Cover {
  std::vector<Place> places;
  std::vector<char> isWhole;
  PlaceNumbers numbers;
  bool isOverlapping = false;

  explicit Cover(const FeasibleRegion& region) {
    for (const std::array<int, 8>& cube : region.border) add(region.placeOf(cube[0]), false);
    for (const WholeCube& cube : region.whole) {
      const int across = 1 << cube.level;
      for (int i = 0; i < across * across * across; ++i)
        add(cube.place + Place(i % across, i / across % across, i / (across * across)), true);
    }
  }

  int find(const Place& place) const {
    return numbers.find(place, [&](int i) { return places[static_cast<std::size_t>(i)]; });
  }

private:
  void add(const Place& place, bool whole) {
    if (find(place) >= 0) {
      isOverlapping = true;
      return;
    }
    numbers.add(place, [&](int i) { return places[static_cast<std::size_t>(i)]; });
    places.push_back(place);
    isWhole.push_back(whole ? 1 : 0);
  }
};

TEST(FeasibleRegion, OfABoxIsTheSmallerBox) {
  const Vec3 size(1.0, 1.5, 2.0);
  const double wall = 0.07;
  const TriangleMesh outer = box(size, 2);
  const TriangleTree tree(outer.vertices, outer.faces);
  const FeasibleRegion region = feasibleRegion({tree, wall, wall}, 0.023);
  const double volume = (size - Vec3::Constant(2.0 * wall)).prod();
  // Only of the cubes along edges, 0.3 % of the volume, anything is not known exactly.
  EXPECT_NEAR(volumeOf(region), volume, 3e-4 * volume);
  for (std::size_t c = 0; c < region.corners.size(); ++c) {
    const RegionCorner& corner = region.corners[c];
    const Vec3 x = region.positionOf(region.placeOf(static_cast<int>(c)));
    // Depths are exact near the wall and up to where the ball fits.
    const double inset = (0.5 * size - x.cwiseAbs()).minCoeff() - wall;
    if (inset >= 0.0 && inset < 0.5 * wall) {
      EXPECT_NEAR(corner.wall, inset, 1e-6);
    }
    EXPECT_EQ(corner.wall > 1e-6, inset > 1e-6) << x.transpose();
    // A ball reaches past √3 radii, so into the corners.
    if (inset > 1e-6) {
      EXPECT_TRUE(corner.isReached) << x.transpose();
    }
  }
}

TEST(FeasibleRegion, HasEachPlaceBehindTheWallsInOneCube) {
  const TriangleMesh outer = blob(16);
  const TriangleTree tree(outer.vertices, outer.faces);
  const FeasibleSet set{tree, 0.1, 0.15};
  const FeasibleRegion region = feasibleRegion(set, 0.021);
  const Cover cover(region);
  EXPECT_FALSE(cover.isOverlapping);
  RegionProbe probe(set);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(0.0, 1.0);
  int inWhole = 0;
  int onBorder = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 share(number(random), number(random), number(random));
    const Vec3 x = region.origin + share.cwiseProduct(region.extent);
    const Place place = ((x - region.origin) / region.edge).array().floor().cast<int>().matrix();
    const int cube = cover.find(place);
    const double inset = probe.insetAt(x, 0.1);
    if (cube >= 0 && cover.isWhole[static_cast<std::size_t>(cube)] != 0) {
      // Corners all lie inside; what bulges into a cube is no more than a chord's rise.
      EXPECT_GT(inset, -0.02 * region.edge) << x.transpose();
      ++inWhole;
    } else if (cube >= 0) {
      // Of the border's cubes a corner lies behind the wall.
      EXPECT_GT(probe.depthAt(x, 1.0).value, set.wall - 1.8 * region.edge);
      ++onBorder;
    } else {
      // What no corner sees may still be inside by half a cube.
      EXPECT_LT(inset, 0.5 * region.edge) << x.transpose();
    }
  }
  EXPECT_GT(inWhole, 1000);
  EXPECT_GT(onBorder, 500);
}

/// A cylinder of radius 0.4 and height 1, around it a disc of radius 1 and this thickness; askew.
TriangleMesh cylinderInDisc(double thickness) {
  const double half = 0.5 * thickness;
  return transformed(revolved({{0.0, 0.5},
                               {0.4, 0.5},
                               {0.4, half},
                               {1.0, half},
                               {1.0, -half},
                               {0.4, -half},
                               {0.4, -0.5},
                               {0.0, -0.5}},
                              96),
                     kAskew);
}

struct Volumes {
  double behindWalls, reached, cylinder;
};

Volumes volumesWith(double room) {
  const double wall = 0.05;
  const TriangleMesh outer = cylinderInDisc((2.0 + room) * wall);
  const TriangleTree tree(outer.vertices, outer.faces);
  const FeasibleSet set{tree, wall, wall};
  const FeasibleRegion region = feasibleRegion(set, edgeFor(set));
  return {volumeOf(region, Admissible::BehindWalls), volumeOf(region),
          kPi * std::pow(0.4 - wall, 2) * (1.0 - 2.0 * wall)};
}

TEST(FeasibleRegion, HasRoomsHardlyWiderThanTheWall) {
  for (const double room : {1.0, 1.02, 1.1, 1.5}) {
    const Volumes volumes = volumesWith(room);
    ASSERT_GT(volumes.behindWalls, 1.3 * volumes.cylinder) << room;
    // The ball does not reach all of the disc's rim.
    EXPECT_GT(volumes.reached, 0.97 * volumes.behindWalls) << room;
    EXPECT_LE(volumes.reached, (1.0 + 1e-9) * volumes.behindWalls) << room;
  }
}

TEST(FeasibleRegion, LosesRoomsHardlyNarrowerThanTheWall) {
  const double wall = 0.05;
  const double room = 0.9;
  const Volumes volumes = volumesWith(room);
  ASSERT_GT(volumes.behindWalls, 1.3 * volumes.cylinder);
  EXPECT_GT(volumes.reached, 0.99 * volumes.cylinder);
  // Into the disc no farther than the reach from where the ball is at the mouth.
  const double most = volumes.cylinder +
                      kPi * (std::pow(0.4 + 0.4 * wall, 2) - std::pow(0.4 - wall, 2)) * room * wall;
  EXPECT_LT(volumes.reached, 1.01 * most);
}

TEST(FeasibleRegion, LosesACollarThinnerThanTheBallAndKeepsAWiderOne) {
  const Volumes thin = volumesWith(0.6);
  EXPECT_LT(thin.reached, 1.05 * thin.cylinder);
  const Volumes wide = volumesWith(1.6);
  EXPECT_NEAR(wide.reached, wide.behindWalls, 3e-3 * wide.behindWalls);
}

TEST(FeasibleRegion, IsEmptyWhereNoBallFits) {
  const double wall = 0.1;
  // Rooms of 0.7 walls, and of none.
  for (const double thickness : {0.27, 0.15}) {
    const TriangleMesh outer = box({1.0, 1.0, thickness}, 3);
    const TriangleTree tree(outer.vertices, outer.faces);
    const FeasibleSet set{tree, wall, wall};
    const FeasibleRegion region = feasibleRegion(set, edgeFor(set));
    EXPECT_EQ(admissibleCells(region, Admissible::Reached, kMostCells).rows(), 0) << thickness;
    if (thickness < 2.0 * wall) {
      EXPECT_TRUE(region.isEmpty());
    }
  }
}

TEST(FeasibleRegion, IsTheSameWithAnyNumberOfThreads) {
  const TriangleMesh outer = blob(16);
  const TriangleTree tree(outer.vertices, outer.faces);
  const auto on = [&](int threads) {
    const ThreadCount count(threads);
    return feasibleRegion({tree, 0.1, 0.2}, 0.03);
  };
  const FeasibleRegion one = on(1);
  const FeasibleRegion four = on(4);
  EXPECT_EQ(one.border, four.border);
  ASSERT_EQ(one.whole.size(), four.whole.size());
  for (std::size_t i = 0; i < one.whole.size(); ++i) {
    EXPECT_EQ(one.whole[i].place, four.whole[i].place);
    EXPECT_EQ(one.whole[i].level, four.whole[i].level);
  }
  ASSERT_EQ(one.corners.size(), four.corners.size());
  for (std::size_t c = 0; c < one.corners.size(); ++c) {
    EXPECT_EQ(one.corners[c].place, four.corners[c].place);
    EXPECT_EQ(one.corners[c].wall, four.corners[c].wall);
    EXPECT_EQ(one.corners[c].open, four.corners[c].open);
    EXPECT_EQ(one.corners[c].isReached, four.corners[c].isReached);
  }
}

TEST(FeasibleRegion, HasWallsThinnerThanAnEdge) {
  const TriangleMesh outer = torus(1.0, 0.4, 96, 48);
  const TriangleTree tree(outer.vertices, outer.faces);
  const double wall = 1e-3;
  for (const double edge : {0.12, 0.06}) {
    const FeasibleRegion region = feasibleRegion({tree, wall, 0.0}, edge);
    const double volume =
        moments(outer.vertices, outer.faces)[0] - surfaceArea(outer.vertices, outer.faces) * wall;
    // In a cube the border's rise is taken as one of a polynomial of degree 2.
    EXPECT_NEAR(volumeOf(region), volume, 0.01 * volume) << edge;
  }
}

TEST(FeasibleRegion, WithinAPlaneIsTheBoxCutByIt) {
  const TriangleMesh outer = box({1.0, 1.0, 1.0}, 2);
  const TriangleTree tree(outer.vertices, outer.faces);
  const double wall = 0.1;
  const FeasibleRegion all = feasibleRegion({tree, wall, wall}, 0.023);
  GridFunction half;
  half.grid.rotation = kAskew;
  half.grid.edge = 0.1;
  half.grid.origin = Vec3::Constant(-1.0);
  half.grid.counts = {21, 21, 21};
  // Through the middle: each of two opposite halves is half of the whole, however it is turned.
  for (int k = 0; k < 21; ++k) {
    for (int j = 0; j < 21; ++j) {
      for (int i = 0; i < 21; ++i)
        half.values.push_back(static_cast<float>(
            half.grid.positionOf(i, j, k).dot(Vec3(2, 1, 2) / 3.0) / half.grid.edge));
    }
  }
  const AdmissibleCells cells = admissibleCells(within(half, all), Admissible::Reached, kMostCells);
  const double volume = std::pow(1.0 - 2.0 * wall, 3);
  EXPECT_NEAR(cells.col(0).sum(), 0.5 * volume, 1e-3 * volume);
  EXPECT_GT(cells.col(1).sum(), 0.0);
  // All that lies behind the walls is what it was.
  EXPECT_NEAR(volumeOf(within(half, all), Admissible::BehindWalls), volumeOf(all), 1e-3 * volume);
}

TEST(FeasibleRegion, RefusesMoreCubesThanPlacesCanCount) {
  const TriangleMesh outer = box({1.0, 1.0, 1.0}, 1);
  const TriangleTree tree(outer.vertices, outer.faces);
  EXPECT_THROW(feasibleRegion({tree, 0.1, 0.1}, 1.0 / 32001.0), std::invalid_argument);
}

TEST(FeasibleRegion, HasRoomUpToTheWallThatTheLargestBallTells) {
  const double radius = 0.2;
  const double wall = wallWithRoomFor(radius);
  const TriangleMesh outer = box({1.0, 1.0, 2.0 * radius}, 3);
  const TriangleTree tree(outer.vertices, outer.faces);
  for (const double share : {0.999, 1.001}) {
    const FeasibleSet set{tree, share * wall, share * wall};
    const double middle = set.fits();
    EXPECT_EQ(middle < radius, share < 1.0);
    EXPECT_EQ(volumeOf(feasibleRegion(set, edgeFor(set))) > 0.0, share < 1.0) << share;
  }
}

TEST(RegionProbe, FindsTheNearestPlaceOfABallInABox) {
  // Roomy, a sheet and a bar as thin as a thousandth of the ball.
  for (const Vec3& half :
       {Vec3(0.5, 0.4, 0.3), Vec3(0.5, 0.4, 0.15005), Vec3(0.5, 0.15005, 0.1501)}) {
    const TriangleMesh outer = transformed(box(2.0 * half, 3), kAskew);
    const TriangleTree tree(outer.vertices, outer.faces);
    const double ball = 0.1;
    const FeasibleSet set{tree, 0.15 - 0.5 * 0.95 * ball, ball};
    ASSERT_NEAR(set.fits(), 0.15, 1e-12);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    int reached = 0;
    int beyond = 0;
    for (int i = 0; i < 3000; ++i) {
      const Vec3 x = half.cwiseProduct(Vec3(number(random), number(random), number(random)));
      const double wall = (half - x.cwiseAbs()).minCoeff() - set.wall;
      if (wall <= 1e-6) continue;
      const double away = (x.cwiseAbs() - (half - Vec3::Constant(set.fits()))).cwiseMax(0.0).norm();
      RegionProbe probe(set); // knows of no other place
      const double inset = probe.insetAt(kAskew * x, 0.03);
      if (away < set.reach() - 1e-6) {
        EXPECT_NEAR(std::min(inset, 0.03), std::min({wall, set.reach() - away, 0.03}), 1e-6)
            << x.transpose();
        ++reached;
      } else if (away > set.reach() + 1e-6) {
        EXPECT_LE(inset, 0.0) << x.transpose();
        ++beyond;
      }
    }
    EXPECT_GT(reached, 100);
    EXPECT_EQ(beyond, 0); // of what lies behind the walls of right angles all is reached
  }
}

TEST(RegionProbe, FindsNoPlaceInASheetThatIsTooThin) {
  const Vec3 half(0.5, 0.4, 0.149);
  const TriangleMesh outer = transformed(box(2.0 * half, 3), kAskew);
  const TriangleTree tree(outer.vertices, outer.faces);
  RegionProbe probe({tree, 0.15 - 0.5 * 0.95 * 0.1, 0.1});
  std::mt19937 random(5);
  std::uniform_real_distribution<double> number(-1.0, 1.0);
  for (int i = 0; i < 500; ++i) {
    const Vec3 x = half.cwiseProduct(Vec3(number(random), number(random), number(random)));
    EXPECT_LE(probe.insetAt(kAskew * x, 0.03), 0.0) << x.transpose();
  }
}

// Far away another face than the nearest one is about as near, and shows its back.
TEST(RegionProbe, TellsTheSideOfAFlatBodyFromAfar) {
  const TriangleMesh outer =
      tetrahedron({0, 0, 0}, {1, 0, 0.02}, {0.3, 0.9, 0.01}, {0.4, 0.3, 0.06});
  const TriangleTree tree(outer.vertices, outer.faces);
  const PointInMesh inside(tree);
  const FeasibleSet set{tree, 0.005, 0.0};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-0.5, 1.5);
  int in = 0;
  RegionProbe exact(set);
  RegionProbe quick(set);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 x(number(random), number(random), 0.2 * number(random));
    const bool isInside = inside.contains(x);
    in += isInside ? 1 : 0;
    const double depth = exact.depthAt(x, 10.0).value;
    EXPECT_LE(depth > 0.0, isInside) << x.transpose();
    // 5 % too large beyond what is to be exact.
    const double quickly = quick.depthAt(x, set.wall, isInside && i % 2 == 0).value;
    EXPECT_EQ(quickly > 0.0, depth > 0.0) << x.transpose();
    EXPECT_GE(std::abs(quickly), (1.0 - 1e-9) * std::abs(depth)) << x.transpose();
    const double slack = std::abs(depth) > set.wall ? TriangleTree::kSlack : 1.0 + 1e-9;
    EXPECT_LE(std::abs(quickly), slack * std::abs(depth)) << x.transpose();
  }
  EXPECT_GT(in, 50);
}

} // namespace
} // namespace massprops::testing
