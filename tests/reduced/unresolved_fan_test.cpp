// A vertex whose triangles are all smaller than the working frame's grid: their area is 0 there.
#include "core/model/frame.h"
#include "core/pipeline.h"
#include "core/reduced/harmonics.h"
#include "core/reduced/laplacian.h"
#include "core/reduced/offset_field.h"
#include "judge/checks.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace massprops::testing {
namespace {

/// The mesh with a ring of `size` times the edges' length around vertex 0, whose faces come last.
TriangleMesh withTinyFan(const TriangleMesh& mesh, double size) {
  TriangleMesh result = mesh;
  const int n = static_cast<int>(mesh.vertices.rows());
  std::vector<int> ringFor(static_cast<std::size_t>(n), -1);
  int ring = 0;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      if (mesh.faces(f, k) != 0) continue;
      for (const int v : {mesh.faces(f, (k + 1) % 3), mesh.faces(f, (k + 2) % 3)}) {
        int& number = ringFor[static_cast<std::size_t>(v)];
        if (number >= 0) continue;
        number = n + ring++;
        result.vertices.conservativeResize(n + ring, 3);
        result.vertices.row(number) =
            mesh.vertices.row(0) + size * (mesh.vertices.row(v) - mesh.vertices.row(0));
      }
    }
  }
  // Each face (0, v, w) becomes (0, v', w'), (v', v, w) and (v', w, w').
  const auto add = [&](int a, int b, int c) {
    result.faces.conservativeResize(result.faces.rows() + 1, 3);
    result.faces.bottomRows(1) << a, b, c;
  };
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      if (mesh.faces(f, k) != 0) continue;
      const int v = mesh.faces(f, (k + 1) % 3);
      const int w = mesh.faces(f, (k + 2) % 3);
      const int inV = ringFor[static_cast<std::size_t>(v)];
      const int inW = ringFor[static_cast<std::size_t>(w)];
      result.faces.row(f) << 0, inV, inW;
      add(inV, v, w);
      add(inV, w, inW);
    }
  }
  return result;
}

constexpr double kUnderTheGrid = 1e-11;

TEST(UnresolvedFan, StaysJoinedToTheSurface) {
  TriangleMesh mesh = withTinyFan(scaled(blob(6), 0.3), kUnderTheGrid);
  ASSERT_TRUE(isClosedAndOriented(mesh));
  mesh.vertices = snapped(mesh.vertices);
  const Vector area = vertexLumpedMass(mesh.vertices, mesh.faces);
  ASSERT_EQ(area[0], 0.0) << "the case is not there";
  const SparseMatrix L = cotanLaplacian(mesh.vertices, mesh.faces);
  EXPECT_LT((L * Vector::Ones(L.rows())).cwiseAbs().maxCoeff(), 1e-9);
  const HarmonicBasis basis = harmonicBasis(mesh.vertices, mesh.faces, L, area / area.sum(), 12);
  ASSERT_TRUE(basis.functions.allFinite());
  EXPECT_LT(basis.eigenvalues[0], 1e-6);
  EXPECT_GT(basis.eigenvalues[1], 1.0) << "the vertex has come off";
  // Smoothing moves a vertex without mass to the middle of its ring, whose edges count alike.
  const Points smooth = smoothedOverSurface(mesh.vertices, L, area, 0.02);
  const Eigen::Index ring = mesh.vertices.rows() - blob(6).vertices.rows();
  const Eigen::RowVector3d middle = smooth.bottomRows(ring).colwise().mean();
  EXPECT_LT((smooth.row(0) - middle).norm(), 1e-12);
}

TEST(UnresolvedFan, IsNoReasonToRefuseAModel) {
  Options options;
  options.goal = GoalKind::Mass;
  const Result result = optimizeMassProperties(withTinyFan(blob(12), kUnderTheGrid), options);
  EXPECT_GT(result.inner.faces.rows(), 0);
  EXPECT_EQ(intersectingPairs(result.inner), 0U);
}

} // namespace
} // namespace massprops::testing
