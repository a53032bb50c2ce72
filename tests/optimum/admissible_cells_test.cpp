// What may be hollow, against closed forms.
#include "core/optimum/admissible_cells.h"

#include "core/physics/moments.h"
#include "large_test.h"
#include "shapes.h"

#include <gtest/gtest.h>

namespace massprops::testing {
namespace {

constexpr double kPi = 3.14159265358979323846;

TriangleTree treeOf(const TriangleMesh& mesh) {
  return {mesh.vertices, mesh.faces};
}

TEST(AdmissibleCells, OfABoxFillTheSmallerBox) {
  const double wall = 0.07;
  const TriangleMesh outer = box({1.0, 1.5, 2.0}, 2);
  const AdmissibleCells cells = admissibleCells(treeOf(outer), wall);
  const Eigen::Array3d inner = Eigen::Array3d(1.0, 1.5, 2.0) - 2 * wall;
  const double volume = inner.prod();
  const Eigen::RowVectorXd sums = cells.colwise().sum();
  // Parts that an edge cuts are taken for larger than they are.
  EXPECT_GT(sums[0], volume);
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
  const AdmissibleCells cells = admissibleCells(treeOf(outer), wall, 5000);
  const double volume = moments(outer.vertices, outer.faces)[0];
  const double area = 4 * kPi * kPi * 0.4;
  EXPECT_NEAR(cells.col(0).sum(), volume - area * wall, 1e-2 * volume);
}

TEST(AdmissibleCells, AreSmallerWhereRoomsAreNarrow) {
  LARGE_TEST();
  const double tube = 0.06;
  const double wall = 0.045;
  const TriangleMesh outer = torus(1.0, tube, 192, 96);
  const TriangleTree tree = treeOf(outer);
  const double volume = 2 * kPi * kPi * (tube - wall) * (tube - wall);
  const RegionParts coarse = admissibleParts(tree, wall);
  const RegionParts fine = resolvedParts(tree, wall);
  EXPECT_LT(fine.edge, 0.5 * coarse.edge);
  const auto error = [&](const RegionParts& parts) {
    return std::abs(cellsOf(parts).col(0).sum() - volume);
  };
  EXPECT_LT(error(fine), 0.02 * volume);
  EXPECT_LT(error(fine), 0.5 * error(coarse));
  // Where rooms are wide they are those of the other function.
  EXPECT_EQ(resolvedParts(treeOf(sphere(20)), 0.1).edge,
            admissibleParts(treeOf(sphere(20)), 0.1).edge);
}

TEST(AdmissibleCells, KnowTheEdgesThatPassThroughThem) {
  const Vec3 size(1.0, 0.8, 0.6);
  const double wall = 0.1;
  const TriangleMesh outer =
      transformed(box(size, 1), rotation(Vec3(0.3, 0.5, 0.8).normalized(), 0.7));
  const Vec3 inner = size - Vec3::Constant(2.0 * wall);
  const double volume = inner.prod();
  for (const int cells : {2000, 20000}) {
    const RegionParts parts = admissibleParts(treeOf(outer), wall, cells);
    const double edges = 4.0 * inner.sum();
    // An eighth of a cell is an edge's share of the square of the smallest parts.
    const double most = 0.125 * edges * parts.edge * parts.edge / 8.0;
    const double error = cellsOf(parts).col(0).sum() - volume;
    EXPECT_GT(error, -1e-9) << cells;
    EXPECT_LT(error, most) << cells;
  }
}

TEST(AdmissibleCells, AreNoneWhereTheWallIsTooThick) {
  const TriangleMesh outer = box({1.0, 1.0, 1.0}, 1);
  EXPECT_EQ(admissibleCells(treeOf(outer), 0.6).rows(), 0);
}

TEST(AdmissibleCells, AreBoundedInNumberForSheetsOfAlmostNoThickness) {
  const TriangleMesh sheet = box({1.0, 1.0, 1e-12}, 4);
  EXPECT_LT(admissibleCells(treeOf(sheet), 1e-14).rows(), 1000000);
}

} // namespace
} // namespace massprops::testing
