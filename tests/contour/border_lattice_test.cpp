// The cubes along the border of a cavity.
#include "core/contour/border_lattice.h"

#include "core/contour/dual_contour.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/signed_volume.h"
#include "core/query/self_intersection.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

namespace massprops::testing {
namespace {

/// A lump's region, half of it where it is cut.
struct Lump {
  TriangleMesh outer = blob(16);
  TriangleTree tree{outer.vertices, outer.faces};
  FeasibleSet set{tree, 0.1, 0.1};
  FeasibleRegion region = feasibleRegion(set, 0.06);
  std::optional<QuadricCut> cut, none;

  Lump() {
    Moments plane = Moments::Zero();
    plane[0] = -0.05;
    plane.segment<3>(1) = Vec3(0.6, 0.0, 0.8);
    cut = QuadricCut{LayeredQuadric::ofOneLayer(plane)};
  }
};

/// Whether corners that are marked are one piece along a cube's edges.
bool isOnePiece(unsigned marked) {
  std::vector<int> pieces(8);
  for (int i = 0; i < 8; ++i) pieces[static_cast<std::size_t>(i)] = i;
  for (int round = 0; round < 8; ++round) {
    for (int i = 0; i < 8; ++i) {
      for (const int step : {1, 2, 4}) {
        const int j = i ^ step;
        if ((marked >> i & 1U) == 0 || (marked >> j & 1U) == 0) continue;
        int& a = pieces[static_cast<std::size_t>(i)];
        int& b = pieces[static_cast<std::size_t>(j)];
        a = b = std::min(a, b);
      }
    }
  }
  int first = -1;
  for (int i = 0; i < 8; ++i) {
    if ((marked >> i & 1U) == 0) continue;
    if (first >= 0 && pieces[static_cast<std::size_t>(i)] != first) return false;
    first = pieces[static_cast<std::size_t>(i)];
  }
  return true;
}

void expectTame(const BorderLattice& lattice) {
  for (int cube = 0; cube < static_cast<int>(lattice.cubes().size()); ++cube) {
    const unsigned inside = lattice.cornersInside(cube);
    EXPECT_TRUE(isOnePiece(inside) && isOnePiece(~inside & 255U)) << inside;
  }
}

TEST(BorderLattice, IsCutOnceInEachCube) {
  const Lump lump;
  expectTame(BorderLattice(lump.set, lump.region, lump.none));
  expectTame(BorderLattice(lump.set, lump.region, lump.cut));
}

TEST(BorderLattice, HasCornersInsideOnlyWhereTheCutLeavesThem) {
  const Lump lump;
  const BorderLattice lattice(lump.set, lump.region, lump.cut);
  int inside = 0;
  for (const std::array<int, 8>& cube : lattice.cubes()) {
    for (const int c : cube) {
      if (!lattice.corner(c).isInside) continue;
      const Vec3 x = lattice.positionOf(c);
      EXPECT_GT(cutAt(*lump.cut, x).value, 0.0);
      EXPECT_GT(RegionProbe(lump.set).insetAt(x, 0.1), 0.0);
      ++inside;
    }
  }
  EXPECT_GT(inside, 1000);
}

TEST(BorderLattice, TakesOutWhatIsAskedForAndStaysSound) {
  const Lump lump;
  BorderLattice lattice(lump.set, lump.region, lump.none);
  const Contour whole = dualContour(lattice);
  const Points& vertices = whole.mesh.vertices;
  const std::vector<Vec3> points{vertices.row(whole.mesh.faces(0, 0)).transpose(),
                                 vertices.row(whole.mesh.faces(500, 0)).transpose()};
  lattice.takeOut(points);
  expectTame(lattice);
  const Contour less = dualContour(lattice);
  const EdgeCounts edges = countEdges(less.mesh.vertices.rows(), less.mesh.faces);
  EXPECT_EQ(edges.boundary + edges.nonManifold + edges.incoherent, 0U);
  EXPECT_TRUE(selfIntersectingFaces(less.mesh.vertices, less.mesh.faces).empty());
  const double before = signedVolume(vertices, whole.mesh.faces);
  const double after = signedVolume(less.mesh.vertices, less.mesh.faces);
  EXPECT_LT(after, before);
  EXPECT_GT(after, before - 60.0 * std::pow(lattice.edge(), 3));
  // Vertices keep the numbers of their cubes, and those far away their places.
  int kept = 0;
  for (Eigen::Index v = 0; v < std::min(vertices.rows(), less.mesh.vertices.rows()); ++v)
    kept += vertices.row(v) == less.mesh.vertices.row(v) ? 1 : 0;
  EXPECT_GT(kept, vertices.rows() * 9 / 10);
}

} // namespace
} // namespace massprops::testing
