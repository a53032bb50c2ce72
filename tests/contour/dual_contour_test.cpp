// Borders of regions with known shapes.
#include "core/contour/dual_contour.h"

#include "core/base/angles.h"
#include "core/contour/projection.h"
#include "core/mesh/components.h"
#include "core/mesh/connectivity.h"
#include "core/query/self_intersection.h"
#include "core/query/surface_distance.h"
#include "large_test.h"
#include "shapes.h"
#include "thread_count.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace massprops::testing {
namespace {

TriangleTree treeOf(const TriangleMesh& mesh) {
  return {mesh.vertices, mesh.faces};
}

void expectClosedManifold(const TriangleMesh& mesh) {
  const EdgeCounts edges = countEdges(mesh.vertices.rows(), mesh.faces);
  EXPECT_EQ(edges.boundary, 0U);
  EXPECT_EQ(edges.nonManifold, 0U);
  EXPECT_EQ(edges.incoherent, 0U);
  EXPECT_TRUE(selfIntersectingFaces(mesh.vertices, mesh.faces).empty());
}

LayeredQuadric halfSpace(const Vec3& normal, double offset) {
  Moments quadric = Moments::Zero();
  quadric[0] = -offset;
  quadric.segment<3>(1) = normal;
  return LayeredQuadric::ofOneLayer(quadric);
}

TEST(DualContour, OfABoxIsTheSmallerBoxWithItsEdges) {
  const TriangleMesh outer = box({1.0, 1.5, 2.0}, 3);
  const TriangleTree tree = treeOf(outer);
  const double wall = 0.13;
  const Contour inner = dualContour(borderLattice({tree, wall}, 0.071));
  expectClosedManifold(inner.mesh);
  const Eigen::Array3d size = Eigen::Array3d(1.0, 1.5, 2.0) - 2.0 * wall;
  EXPECT_NEAR(moments(inner.mesh.vertices, inner.mesh.faces)[0], size.prod(), 1e-9);
  const Vec3 corner = inner.mesh.vertices.colwise().maxCoeff().transpose();
  EXPECT_TRUE(corner.isApprox(0.5 * size.matrix(), 1e-9));
}

TEST(DualContour, OfABoxCutByAPlaneHasACreaseWhereTheyMeet) {
  const TriangleMesh outer = box({2.0, 2.0, 2.0}, 3);
  const TriangleTree tree = treeOf(outer);
  const double wall = 0.2;
  const Vec3 normal = Vec3(1.0, 1.0, 1.0).normalized();
  const Region region{tree, wall, {}, halfSpace(normal, 0.1)};
  const double edge = 0.073;
  Contour inner = dualContour(borderLattice(region, edge));
  expectClosedManifold(inner.mesh);
  project(region, edge, inner);
  expectClosedManifold(inner.mesh);
  int creases = 0;
  int away = 0;
  int chamfers = 0;
  for (Eigen::Index v = 0; v < inner.mesh.vertices.rows(); ++v) {
    const Vec3 x = inner.mesh.vertices.row(v).transpose();
    const double fromInset = 0.8 - x.cwiseAbs().maxCoeff();
    const double fromCut = normal.dot(x) - 0.1;
    EXPECT_GT(std::min(fromInset, fromCut), -1e-6);
    const On on = inner.on[static_cast<std::size_t>(v)];
    if (on == On::Chamfer) {
      ++chamfers;
      EXPECT_LT(std::max(fromInset, fromCut), 0.2 * edge);
      continue;
    }
    if ((on != On::Cut && fromInset > 1e-6) || (on != On::Inset && fromCut > 1e-6)) ++away;
    if (on == On::Crease) ++creases;
  }
  EXPECT_GT(creases, 50);
  EXPECT_EQ(away, 0);
  EXPECT_LT(chamfers, creases / 2);
}

TEST(DualContour, OfABallCutByAnEllipsoidHasTheVolumeBetween) {
  const TriangleMesh outer = sphere(40);
  const TriangleTree tree = treeOf(outer);
  // Outside of an ellipsoid inside of the ball.
  Moments quadric = Moments::Zero();
  const Vec3 half(0.3, 0.4, 0.5);
  quadric[0] = -1.0;
  quadric.segment<3>(4) = half.cwiseAbs2().cwiseInverse();
  const Contour inner =
      dualContour(borderLattice({tree, 0.1, {}, LayeredQuadric::ofOneLayer(quadric)}, 0.04));
  expectClosedManifold(inner.mesh);
  const double kPi4_3 = 4.0 / 3.0 * kPi;
  EXPECT_NEAR(moments(inner.mesh.vertices, inner.mesh.faces)[0],
              kPi4_3 * (0.9 * 0.9 * 0.9 - half.prod()), 5e-3);
  EXPECT_EQ(connectedComponents(inner.mesh.vertices.rows(), inner.mesh.faces).size(), 2U);
}

TEST(DualContour, IsFreeOfCrossingsHoweverCoarse) {
  LARGE_TEST();
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const TriangleMesh outer = figure(4);
  const TriangleTree tree = treeOf(outer);
  const Vec3 extent =
      (outer.vertices.colwise().maxCoeff() - outer.vertices.colwise().minCoeff()).transpose();
  for (int i = 0; i < 30; ++i) {
    Moments quadric;
    for (double& term : quadric) term = normal(random);
    quadric.tail<6>() *= 3.0;
    const double wall = extent.norm() * (0.004 + 0.001 * (i % 10));
    const double edge = wall * (0.5 + 0.1 * (i % 13));
    const Contour contour =
        dualContour(borderLattice({tree, wall, {}, LayeredQuadric::ofOneLayer(quadric)}, edge));
    expectClosedManifold(contour.mesh);
  }
}

TEST(DualContour, IsTheSameWithAnyNumberOfThreads) {
  const TriangleMesh outer = blob(16);
  const TriangleTree tree = treeOf(outer);
  const Region region{tree, 0.1, {}, halfSpace(Vec3::UnitZ(), 0.1)};
  Contour one;
  {
    const ThreadCount threads(1);
    one = dualContour(borderLattice(region, 0.05));
    project(region, 0.05, one);
  }
  const ThreadCount threads(4);
  Contour four = dualContour(borderLattice(region, 0.05));
  project(region, 0.05, four);
  EXPECT_EQ(one.mesh.faces, four.mesh.faces);
  EXPECT_EQ(one.mesh.vertices, four.mesh.vertices);
}

TEST(BorderLattice, TakesOutWhatIsAskedForAndStaysSound) {
  const TriangleMesh outer = blob(16);
  const TriangleTree tree = treeOf(outer);
  BorderLattice lattice = borderLattice({tree, 0.1}, 0.06);
  const double before =
      moments(dualContour(lattice).mesh.vertices, dualContour(lattice).mesh.faces)[0];
  const Contour whole = dualContour(lattice);
  const std::vector<Vec3> points{whole.mesh.vertices.row(0).transpose(),
                                 whole.mesh.vertices.row(500).transpose()};
  takeOut(points, lattice);
  const Contour less = dualContour(lattice);
  expectClosedManifold(less.mesh);
  const double after = moments(less.mesh.vertices, less.mesh.faces)[0];
  EXPECT_LT(after, before);
  EXPECT_GT(after, before - 60.0 * std::pow(0.06, 3));
}

TEST(Projection, PutsVerticesOnWhatTheyLieOn) {
  const TriangleMesh outer = blob(16);
  const TriangleTree tree = treeOf(outer);
  const Region region{tree, 0.1, {}, halfSpace(Vec3(1.0, 0.0, 0.5).normalized(), 0.05)};
  Contour contour = dualContour(borderLattice(region, 0.05));
  project(region, 0.05, contour);
  InsetProbe probe(region);
  int off = 0;
  for (Eigen::Index v = 0; v < contour.mesh.vertices.rows(); ++v) {
    const Vec3 x = contour.mesh.vertices.row(v).transpose();
    const On on = contour.on[static_cast<std::size_t>(v)];
    const bool isOff = (on != On::Cut && std::abs(probe.at(x, 0.1).value) > 1e-6) ||
                       (on != On::Inset && std::abs(cutAt(region, x).value) > 1e-6);
    if (on != On::Chamfer && isOff) ++off;
  }
  EXPECT_LT(off, contour.mesh.vertices.rows() / 200);
}

} // namespace
} // namespace massprops::testing
