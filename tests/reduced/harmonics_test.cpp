// The harmonic basis solves its eigenproblem and knows the spectra of known surfaces.
#include "core/reduced/harmonics.h"

#include "shapes.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace massprops::testing {
namespace {

struct Problem {
  TriangleMesh mesh;
  SparseMatrix L;
  Vector mass; ///< scaled to total 1
  double area;
};

Problem problemOf(const TriangleMesh& mesh) {
  Problem problem{mesh, {}, {}, 0.0};
  problem.L = cotanLaplacian(mesh.vertices, mesh.faces);
  problem.mass = vertexLumpedMass(mesh.vertices, mesh.faces);
  problem.area = problem.mass.sum();
  problem.mass /= problem.area;
  return problem;
}

HarmonicBasis basisOf(const Problem& p, int k) {
  return harmonicBasis(p.mesh.vertices, p.mesh.faces, p.L, p.mass, k);
}

TEST(HarmonicBasis, IsOrthonormalInTheMassMatrix) {
  const Problem p = problemOf(blob(10));
  const HarmonicBasis basis = basisOf(p, 36);
  const Matrix H = basis.functions;
  const Matrix gram = H.transpose() * p.mass.asDiagonal() * H;
  // The eigensolver's tolerance is 1e-9 relative; orthogonality is kept to rounding.
  EXPECT_LT((gram - Matrix::Identity(36, 36)).cwiseAbs().maxCoeff(), 1e-10);
}

TEST(HarmonicBasis, SolvesTheGeneralisedEigenproblem) {
  const Problem p = problemOf(jittered(box({1, 2, 3}, 8), 0.02, 4));
  const HarmonicBasis basis = basisOf(p, 20);
  const Matrix H = basis.functions;
  const Matrix residual = p.L * H - p.mass.asDiagonal() * H * basis.eigenvalues.asDiagonal();
  // Against the size of both sides; tolerance 1e-9 of the shifted-inverted values, which lie
  // 1/0.1 above the eigenvalues, some hundred at most.
  const Matrix size = p.mass.asDiagonal() * H * basis.eigenvalues.asDiagonal();
  EXPECT_LT(residual.norm() / size.norm(), 1e-8);
}

TEST(HarmonicBasis, HasTheLowestEigenvaluesInAscendingOrder) {
  const Problem p = problemOf(blob(5));
  const int k = 12;
  const HarmonicBasis basis = basisOf(p, k);
  // A dense solver of the same problem as the second method.
  const Vector root = p.mass.cwiseSqrt().cwiseInverse();
  const Matrix A = root.asDiagonal() * Matrix(p.L) * root.asDiagonal();
  const Vector expected = Eigen::SelfAdjointEigenSolver<Matrix>(A).eigenvalues().head(k);
  EXPECT_LT((basis.eigenvalues - expected).cwiseAbs().maxCoeff(), 1e-8 * expected[k - 1]);
  for (int j = 1; j < k; ++j) EXPECT_LE(basis.eigenvalues[j - 1], basis.eigenvalues[j]);
}

TEST(HarmonicBasis, StartsWithTheConstantOne) {
  for (const double size : {1e-3, 1.0, 1e3}) {
    const Problem p = problemOf(scaled(blob(8), size));
    const HarmonicBasis basis = basisOf(p, 10);
    EXPECT_NEAR(basis.eigenvalues[0], 0.0, 1e-9);
    EXPECT_LT((basis.functions.col(0).array() - 1.0).abs().maxCoeff(), 1e-8) << "size " << size;
  }
}

TEST(HarmonicBasis, OfASphereHasTheEigenvaluesOfTheSphericalHarmonics) {
  // ℓ(ℓ+1)/R², 2ℓ+1 times each; with total mass 1 instead of 4πR² they come 4πR² times as large.
  // At frequency 24 (5,762 vertices) the edge length is h ≈ 0.045; the relative error of linear
  // elements is of the order λh²/4 ≤ 30·0.002/4 = 1.5 %.
  const double radius = 2.5;
  const Problem p = problemOf(scaled(sphere(24), radius));
  const HarmonicBasis basis = basisOf(p, 36);
  int j = 0;
  for (int degree = 0; degree <= 5; ++degree) {
    for (int order = -degree; order <= degree; ++order, ++j) {
      const double expected = degree * (degree + 1) / (radius * radius);
      EXPECT_NEAR(basis.eigenvalues[j] / p.area, expected, 0.015 * expected + 1e-10)
          << "degree " << degree;
    }
  }
}

TEST(HarmonicBasis, FindsEveryCopyOfAMultipleEigenvalue) {
  // Degree ℓ = 2 is exactly fivefold on this mesh by its icosahedral symmetry. The Lanczos method
  // sees a single copy in exact arithmetic; 6 (the fifth) was seen to be left out for 12 (ℓ = 3).
  for (const int frequency : {12, 16}) {
    const Problem p = problemOf(sphere(frequency));
    for (const int k : {4, 9, 16, 25}) {
      const Vector values = basisOf(p, k).eigenvalues / p.area;
      const int degree = static_cast<int>(std::lround(std::sqrt(k))) - 1;
      EXPECT_NEAR(values[k - 1], degree * (degree + 1), 0.03 * degree * (degree + 1))
          << "frequency " << frequency << ", k = " << k;
    }
  }
}

TEST(HarmonicBasis, OfASphereConvergesQuadratically) {
  // The eight eigenvalues 2 (3 times) and 6 (5 times) against the discrete ones, summed without
  // regard to sign.
  const auto error = [](int frequency) {
    const Problem p = problemOf(sphere(frequency));
    const Vector values = basisOf(p, 9).eigenvalues / p.area;
    return (values.segment(1, 3).array() - 2.0).abs().sum() +
           (values.segment(4, 5).array() - 6.0).abs().sum();
  };
  EXPECT_NEAR(error(8) / error(16), 4.0, 0.5); // half the edge length, a quarter of the error
}

TEST(HarmonicBasis, HasDimensionlessEigenvaluesThatDoNotChangeWithTheUnit) {
  const Problem small = problemOf(scaled(blob(8), 1e-3));
  const Problem large = problemOf(scaled(blob(8), 1e3));
  const Vector a = basisOf(small, 12).eigenvalues;
  const Vector b = basisOf(large, 12).eigenvalues;
  EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 1e-8 * b[11]);
}

TEST(HarmonicBasis, HasItsLargestEntryPositive) {
  const Problem p = problemOf(blob(6));
  const HarmonicBasis basis = basisOf(p, 15);
  for (Eigen::Index j = 0; j < 15; ++j) {
    EXPECT_EQ(basis.functions.col(j).maxCoeff(), basis.functions.col(j).cwiseAbs().maxCoeff());
  }
}

TEST(HarmonicBasis, IsTheSameBitForBitTheSecondTime) {
  const Problem p = problemOf(blob(8));
  const HarmonicBasis first = basisOf(p, 20);
  const HarmonicBasis second = basisOf(p, 20);
  EXPECT_TRUE((first.functions.array() == second.functions.array()).all());
  EXPECT_TRUE((first.eigenvalues.array() == second.eigenvalues.array()).all());
}

TEST(HarmonicBasis, HasAnySizeFromOneToOneLessThanTheVertices) {
  const Problem p = problemOf(sphere(2)); // 42 vertices
  for (const int k : {1, 2, 20, 41}) {
    const HarmonicBasis basis = basisOf(p, k);
    EXPECT_EQ(basis.functions.cols(), k);
    EXPECT_EQ(basis.eigenvalues.size(), k);
  }
}

TEST(HarmonicBasis, IsOrderlyWhereAVertexHasNoMass) {
  // A small mesh is solved densely, a large one sparsely.
  for (const int frequency : {4, 8}) {
    Problem p = problemOf(blob(frequency));
    const Vector whole = basisOf(p, 10).eigenvalues;
    p.mass[7] = 0.0;
    const HarmonicBasis basis = basisOf(p, 10);
    ASSERT_TRUE(basis.functions.allFinite()) << frequency;
    // One vertex of n holds 1/n of the mass, and no mode lives on it.
    const double share = 1.0 / static_cast<double>(p.mass.size());
    EXPECT_LT((basis.eigenvalues - whole).cwiseAbs().maxCoeff(), 10 * share * whole[9]);
    EXPECT_LT(basis.functions.row(7).cwiseAbs().maxCoeff(), 10.0);
  }
}

TEST(HarmonicBasis, SaysWhereTheSolverFails) {
  for (const int frequency : {4, 8}) {
    Problem p = problemOf(blob(frequency));
    p.L.coeffRef(0, 0) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(basisOf(p, 10), std::runtime_error) << frequency;
  }
}

} // namespace
} // namespace massprops::testing
