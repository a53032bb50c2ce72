// A refined surface has the same shape, in triangles that are neither long nor thin.
#include "core/mesh/refinement.h"

#include "core/base/triangle.h"
#include "core/physics/moments.h"
#include "judge/checks.h"
#include "large_test.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace massprops::testing {
namespace {

double area(const TriangleMesh& mesh) {
  return surfaceArea(mesh.vertices, mesh.faces);
}

/// The share of the area that lies in triangles with an angle below this many degrees.
double shareOfNeedles(const TriangleMesh& mesh, double degrees) {
  double thin = 0.0;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    const auto corner = [&](int k) -> Vec3 {
      return mesh.vertices.row(mesh.faces(f, k)).transpose();
    };
    if (leastAngle(corner(0), corner(1), corner(2)) < degrees) {
      thin += 0.5 * areaNormal(mesh.vertices, mesh.faces, f).norm();
    }
  }
  return thin / area(mesh);
}

std::vector<TriangleMesh> models() {
  return {box({3, 2, 1}),    unevenlyCut(box({3, 2, 1}), 4),
          bracket(12),       tetrahedron({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}),
          capsule(1, 6, 24), unevenlyCut(blob(8), 2)};
}

TEST(Refined, HasTheSameShapeWithoutLongEdges) {
  LARGE_TEST();
  for (const TriangleMesh& mesh : models()) {
    const double before = longestEdge(mesh.vertices, mesh.faces);
    for (const double share : {1.0, 0.4, 0.1}) {
      const TriangleMesh fine = refined(mesh.vertices, mesh.faces, share * before);
      EXPECT_LE(longestEdge(fine.vertices, fine.faces), share * before);
      EXPECT_TRUE(isClosedAndOriented(fine));
      EXPECT_EQ(intersectingPairs(fine), 0U);
      EXPECT_EQ(fine.vertices.topRows(mesh.vertices.rows()), mesh.vertices);
      // A flip may turn triangles that are flat but for a thousandth of their size.
      EXPECT_NEAR(area(fine) / area(mesh), 1.0, 1e-5);
      EXPECT_NEAR(moments(fine.vertices, fine.faces)[0] / moments(mesh.vertices, mesh.faces)[0],
                  1.0, 1e-4);
    }
  }
}

TEST(Refined, HasNoNeedlesWhereTheSurfaceIsFlat) {
  for (const TriangleMesh& mesh :
       {box({3, 2, 1}), box({10, 8, 0.5}), unevenlyCut(box({3, 2, 1}), 3), bracket(12)}) {
    const TriangleMesh fine = refined(mesh.vertices, mesh.faces, 0.3);
    EXPECT_LT(shareOfNeedles(fine, 10.0), 0.02);
  }
}

TEST(Refined, LeavesAWellShapedSurfaceAsItIs) {
  const TriangleMesh mesh = blob(12);
  const TriangleMesh same =
      refined(mesh.vertices, mesh.faces, longestEdge(mesh.vertices, mesh.faces));
  EXPECT_EQ(same.vertices, mesh.vertices);
  EXPECT_NEAR(area(same) / area(mesh), 1.0, 1e-12);
}

} // namespace
} // namespace massprops::testing
