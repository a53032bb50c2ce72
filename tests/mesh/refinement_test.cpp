// A refined surface has the same shape, in triangles that are neither long nor thin.
#include "core/mesh/refinement.h"

#include "core/base/triangle.h"
#include "core/mesh/components.h"
#include "core/physics/moments.h"
#include "judge/checks.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
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

/// The upper half of a ball after the lower one, and where it begins.
struct Halves {
  TriangleMesh mesh = sphere(24);
  Eigen::Index first = 0;

  Halves() {
    Faces sorted(mesh.faces.rows(), 3);
    Eigen::Index row = 0;
    for (const bool isUpper : {false, true}) {
      if (isUpper) first = row;
      for (const auto& face : mesh.faces.rowwise()) {
        const double z =
            mesh.vertices(face[0], 2) + mesh.vertices(face[1], 2) + mesh.vertices(face[2], 2);
        if ((z > 0.3) == isUpper) sorted.row(row++) = face;
      }
    }
    mesh.faces = sorted;
  }
};

TEST(RemeshedPart, HasTrianglesOfOneSizeNearWhereItWas) {
  Halves halves;
  TriangleMesh& whole = halves.mesh;
  // Folds: every other vertex of the upper half nearer to the middle.
  std::vector<char> isUpper(static_cast<std::size_t>(whole.vertices.rows()), 1);
  for (const int v : whole.faces.topRows(halves.first).reshaped())
    isUpper[static_cast<std::size_t>(v)] = 0;
  for (Eigen::Index v = 0; v < whole.vertices.rows(); v += 2) {
    if (isUpper[static_cast<std::size_t>(v)] != 0) whole.vertices.row(v) *= 0.9;
  }
  const TriangleMesh part = remeshedPart(whole, halves.first);
  ASSERT_GT(part.faces.rows(), 0);
  EXPECT_EQ(part.vertices.topRows(whole.vertices.rows()), whole.vertices);
  // It takes the place of the old one.
  Faces all(halves.first + part.faces.rows(), 3);
  all << whole.faces.topRows(halves.first), part.faces;
  const TriangleMesh together = submesh(part.vertices, all).mesh;
  EXPECT_TRUE(isClosedAndOriented(together));
  for (const auto& x :
       part.vertices.bottomRows(part.vertices.rows() - whole.vertices.rows()).rowwise()) {
    EXPECT_GT(x.norm(), 0.85);
    EXPECT_LT(x.norm(), 1.0 + 1e-4);
  }
  const Points& x = part.vertices;
  const double edge = (x.row(part.faces(0, 0)) - x.row(part.faces(0, 1))).norm();
  EXPECT_LT(longestEdge(part.vertices, part.faces), 3.0 * edge);
  EXPECT_LT(shareOfNeedles({part.vertices, part.faces}, 15.0), 0.02);
}

TEST(RemeshedPart, HangsOnNeitherLastDigitsNorMemory) {
  const Halves halves;
  const TriangleMesh part = remeshedPart(halves.mesh, halves.first);
  std::vector<std::unique_ptr<TriangleMesh>> kept;
  for (int round = 0; round < 4; ++round) {
    TriangleMesh moved = halves.mesh;
    for (Eigen::Index v = 0; v < moved.vertices.rows(); v += 3)
      moved.vertices(v, round % 3) += 1e-12 * round;
    kept.push_back(std::make_unique<TriangleMesh>(remeshedPart(moved, halves.first)));
    ASSERT_EQ(kept.back()->faces.rows(), part.faces.rows()) << round;
    EXPECT_EQ(kept.back()->faces, part.faces);
    EXPECT_LT((kept.back()->vertices - part.vertices).cwiseAbs().maxCoeff(), 1e-6);
  }
}

TEST(RemeshedPart, IsNoneOfWhatIsNoManifold) {
  Halves halves;
  TriangleMesh& whole = halves.mesh;
  whole.faces.conservativeResize(whole.faces.rows() + 1, 3);
  whole.faces.row(whole.faces.rows() - 1) = whole.faces.row(0);
  EXPECT_EQ(remeshedPart(whole, halves.first).faces.rows(), 0);
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
