// What may be hollow, against closed forms.
#include "core/optimum/admissible_cells.h"

#include "cells.h"
#include "core/base/angles.h"
#include "core/physics/moments.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace massprops::testing {
namespace {

TriangleTree treeOf(const TriangleMesh& mesh) {
  return {mesh.vertices, mesh.faces};
}

TEST(AdmissibleCells, OfABoxFillTheSmallerBox) {
  const double wall = 0.07;
  const TriangleMesh outer = box({1.0, 1.5, 2.0}, 2);
  const AdmissibleCells cells = cellsBehind(treeOf(outer), wall);
  const Eigen::Array3d inner = Eigen::Array3d(1.0, 1.5, 2.0) - 2 * wall;
  const double volume = inner.prod();
  const Eigen::RowVectorXd sums = cells.colwise().sum();
  // Parts that an edge cuts are not quite known.
  EXPECT_NEAR(sums[0], volume, 2e-3 * volume);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(sums[1 + axis], 0.0, 1e-3 * volume);
    const double second = volume * inner[axis] * inner[axis] / 12;
    EXPECT_NEAR(sums[4 + axis], second, 5e-3 * second);
    EXPECT_NEAR(sums[7 + axis], 0.0, 1e-3 * volume);
  }
}

TEST(AdmissibleCells, LeaveOutWhatIsOutsideWhereTheWallIsThinnerThanACell) {
  const double wall = 1e-3;
  const TriangleMesh outer = torus(1.0, 0.4, 96, 48);
  const AdmissibleCells cells = cellsBehind(treeOf(outer), wall, 5000);
  const double volume = moments(outer.vertices, outer.faces)[0];
  const double area = 4 * kPi * kPi * 0.4;
  EXPECT_NEAR(cells.col(0).sum(), volume - area * wall, 1e-2 * volume);
}

TEST(AdmissibleCells, KnowTheEdgesThatPassThroughThem) {
  const Vec3 size(1.0, 0.8, 0.6);
  const double wall = 0.1;
  const TriangleMesh outer =
      transformed(box(size, 1), rotation(Vec3(0.3, 0.5, 0.8).normalized(), 0.7));
  const Vec3 inner = size - Vec3::Constant(2.0 * wall);
  const double volume = inner.prod();
  for (const int cells : {2000, 20000}) {
    const FeasibleRegion region = regionBehind(treeOf(outer), wall, cells);
    const double edges = 4.0 * inner.sum();
    // An edge's share of the square of the region's cubes that it passes through.
    const double most = 0.125 * edges * region.edge * region.edge;
    const double error =
        admissibleCells(region, Admissible::BehindWalls, cells).col(0).sum() - volume;
    EXPECT_LT(std::abs(error), most) << cells;
  }
}

TEST(AdmissibleCells, HaveTheMomentsOfAnAskewBox) {
  const Vec3 size(1.0, 0.8, 0.6);
  const double wall = 0.1;
  const Mat3 turn = rotation(Vec3(0.3, 0.5, 0.8).normalized(), 0.7);
  const TriangleMesh outer = transformed(box(size, 1), turn, {0.3, -0.2, 0.1});
  const TriangleMesh inner =
      transformed(box(size - Vec3::Constant(2.0 * wall), 1), turn, {0.3, -0.2, 0.1});
  const Moments wanted = moments(inner.vertices, inner.faces);
  const Moments found = cellsBehind(treeOf(outer), wall).colwise().sum().transpose();
  // Cubes along edges, 2 % of the volume, are known to some per cent.
  for (int i = 0; i < 10; ++i) EXPECT_NEAR(found[i], wanted[i], 2e-3 * wanted[0]) << i;
}

TEST(AdmissibleCells, AreThoseOfTheSameRegionHoweverManyTheyAre) {
  const TriangleMesh outer = torus(1.0, 0.4, 96, 48);
  const FeasibleRegion region = regionBehind(treeOf(outer), 0.1);
  const AdmissibleCells few = admissibleCells(region, Admissible::BehindWalls, 500.0);
  const AdmissibleCells many = admissibleCells(region, Admissible::BehindWalls, 50000.0);
  EXPECT_LT(8 * few.rows(), many.rows());
  const Moments difference = (few.colwise().sum() - many.colwise().sum()).transpose();
  EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-9);
  const double volume = 2.0 * kPi * kPi * 0.3 * 0.3;
  // The torus has facets.
  EXPECT_NEAR(many.col(0).sum(), volume, 1e-2 * volume);
}

TEST(AdmissibleCells, AreNotCutByHeightsBetweenLayers) {
  const TriangleMesh outer = blob(12);
  const FeasibleRegion region = regionBehind(treeOf(outer), 0.1, 5000.0);
  const AdmissibleCells cells = admissibleCells(region, Admissible::BehindWalls, 5000.0);
  const std::vector<double> heights = layerHeights(region, 5000.0);
  ASSERT_GT(heights.size(), 10U);
  EXPECT_TRUE(std::is_sorted(heights.begin(), heights.end()));
  EXPECT_LE(heights.size(), 100U);
  const double edge = heights[1] - heights[0];
  for (Eigen::Index c = 0; c < cells.rows(); ++c) {
    const double z = cells(c, 3) / cells(c, 0);
    const double spread = std::sqrt(std::max(cells(c, 6) / cells(c, 0) - z * z, 0.0));
    const double above = std::fmod(z - region.origin.z(), edge) / edge;
    // (z - low)(high - z) ≥ spread² for whatever lies between low and high. Of a part that is cut
    // the spread is taken to be that of the whole eighth of a cube, a fourth of a cell wide.
    constexpr double kOfPart = 1.0 / (12.0 * 16.0);
    EXPECT_GE(above * (1.0 - above), spread * spread / (edge * edge) - kOfPart - 1e-9);
  }
}

TEST(AdmissibleCells, AreNoneWhereTheWallIsTooThick) {
  const TriangleMesh outer = box({1.0, 1.0, 1.0}, 1);
  EXPECT_EQ(cellsBehind(treeOf(outer), 0.6).rows(), 0);
}

TEST(AdmissibleCells, AreBoundedInNumberForSheetsOfAlmostNoThickness) {
  const TriangleMesh sheet = box({1.0, 1.0, 1e-12}, 4);
  const TriangleTree tree = treeOf(sheet);
  const FeasibleSet set{tree, 1e-14, 1e-14};
  const FeasibleRegion region = feasibleRegion(set, edgeFor(set));
  EXPECT_LT(region.border.size() + region.whole.size(), 1000000U);
  EXPECT_LT(admissibleCells(region, Admissible::BehindWalls, kCellsInBox).rows(), 1000000);
}

} // namespace
} // namespace massprops::testing
