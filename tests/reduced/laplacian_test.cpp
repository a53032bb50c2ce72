// The cotangent Laplacian and the lumped mass: what makes them a Laplacian and a measure.
#include "core/reduced/laplacian.h"

#include "shapes.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>

namespace massprops::testing {
namespace {

SparseMatrix laplacianOf(const TriangleMesh& mesh) {
  return cotanLaplacian(mesh.vertices, mesh.faces);
}

Vec3 corner(const TriangleMesh& mesh, Eigen::Index face, int k) {
  return mesh.vertices.row(mesh.faces(face, k % 3)).transpose();
}

double area(const TriangleMesh& mesh) {
  double sum = 0.0;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    const Vec3 a = corner(mesh, f, 0);
    sum += 0.5 * (corner(mesh, f, 1) - a).cross(corner(mesh, f, 2) - a).norm();
  }
  return sum;
}

/// ∫|∇f|² with the gradient of each triangle from its two edges: no cotangents.
double dirichletEnergy(const TriangleMesh& mesh, const Vector& f) {
  double energy = 0.0;
  for (Eigen::Index t = 0; t < mesh.faces.rows(); ++t) {
    Eigen::Matrix<double, 3, 2> edges;
    edges << corner(mesh, t, 1) - corner(mesh, t, 0), corner(mesh, t, 2) - corner(mesh, t, 0);
    const Vec2 rise(f[mesh.faces(t, 1)] - f[mesh.faces(t, 0)],
                    f[mesh.faces(t, 2)] - f[mesh.faces(t, 0)]);
    const Eigen::Matrix2d gram = edges.transpose() * edges;
    const double doubleArea = std::sqrt(gram.determinant());
    energy += 0.5 * doubleArea * rise.dot(gram.inverse() * rise);
  }
  return energy;
}

TEST(CotanLaplacian, HasTheConstantsAsItsKernel) {
  const TriangleMesh mesh = blob(8);
  const SparseMatrix L = laplacianOf(mesh);
  const Vector ones = Vector::Ones(L.rows());
  EXPECT_LT((L * ones).cwiseAbs().maxCoeff(), 1e-13); // six cotangents of order one a row
  const Vector eigenvalues = Eigen::SelfAdjointEigenSolver<Matrix>(Matrix(L)).eigenvalues();
  EXPECT_NEAR(eigenvalues[0], 0.0, 1e-12);
  EXPECT_GT(eigenvalues[1], 1e-3); // nothing but the constants
}

TEST(CotanLaplacian, IsSymmetric) {
  const SparseMatrix L = laplacianOf(jittered(box({1, 1, 1}, 3), 0.05, 3));
  EXPECT_EQ((Matrix(L) - Matrix(L).transpose()).cwiseAbs().maxCoeff(), 0.0);
}

TEST(CotanLaplacian, IsTheDirichletEnergyOfPiecewiseLinearFunctions) {
  for (const TriangleMesh& mesh : {blob(6), jittered(box({1, 2, 0.5}, 3), 0.05, 3)}) {
    Random random(5);
    const Vector f = random.vector(mesh.vertices.rows());
    const double energy = dirichletEnergy(mesh, f);
    EXPECT_NEAR(f.dot(laplacianOf(mesh) * f) / energy, 1.0, 1e-12);
  }
}

TEST(CotanLaplacian, OfTheRegularTetrahedronHasTheKnownSpectrum) {
  // All angles 60°: L_ij = −1/√3, eigenvalues 0 and three times 4/√3.
  const TriangleMesh mesh = tetrahedron({1, 1, 1}, {-1, 1, -1}, {1, -1, -1}, {-1, -1, 1});
  const Vector eigenvalues =
      Eigen::SelfAdjointEigenSolver<Matrix>(Matrix(laplacianOf(mesh))).eigenvalues();
  EXPECT_NEAR(eigenvalues[0], 0.0, 1e-15);
  for (int i = 1; i < 4; ++i) EXPECT_NEAR(eigenvalues[i], 4 / std::sqrt(3.0), 1e-14);
}

TEST(CotanLaplacian, DoesNotChangeWithPositionAndScale) {
  const TriangleMesh mesh = blob(6);
  const Matrix before = laplacianOf(mesh);
  const Matrix after = laplacianOf(transformed(mesh, 1e3 * someRotation(), {5, 6, 7}));
  EXPECT_LT((before - after).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(CotanLaplacian, OfThePositionIsTheMeanCurvatureNormal) {
  // On the unit sphere Δx = −2x: L x ≈ 2 M x, up to the square of the edge length; the sum over all
  // vertices hides the dozen irregular ones.
  const auto error = [](int frequency) {
    const TriangleMesh mesh = sphere(frequency);
    const Vector mass = vertexLumpedMass(mesh.vertices, mesh.faces);
    const Points left = laplacianOf(mesh) * mesh.vertices;
    const Points right = 2 * (mass.asDiagonal() * mesh.vertices);
    return (left - right).rowwise().norm().sum() / mass.sum();
  };
  EXPECT_LT(error(8), 0.05);
  EXPECT_LT(error(16), 0.5 * error(8));
}

TEST(CotanLaplacian, StaysPositiveSemidefiniteWithNearlyDegenerateTriangles) {
  // A vertex moved along its edge onto the next but 1e-7: one cap with an angle near 180°, and
  // needles. Cotangents reach 1e7; the matrix must stay an energy, never negative.
  TriangleMesh mesh = box({1, 1, 1}, 4);
  const int i = mesh.faces(0, 0);
  const int j = mesh.faces(0, 1);
  const int k = mesh.faces(0, 2);
  mesh.vertices.row(i) = 0.5 * (mesh.vertices.row(j) + mesh.vertices.row(k)) +
                         1e-7 * (mesh.vertices.row(i) - mesh.vertices.row(j));
  const Matrix L = laplacianOf(mesh);
  const Vector eigenvalues = Eigen::SelfAdjointEigenSolver<Matrix>(L).eigenvalues();
  // Rounding of the eigensolver: 1e-15 of the largest entry, times the size.
  EXPECT_GT(eigenvalues[0], -1e-12 * L.cwiseAbs().maxCoeff());
}

TEST(VertexLumpedMass, AddsUpToTheArea) {
  for (const TriangleMesh& mesh : {blob(6), torus(2, 0.5, 12, 8)}) {
    const Vector mass = vertexLumpedMass(mesh.vertices, mesh.faces);
    EXPECT_NEAR(mass.sum() / area(mesh), 1.0, 1e-13);
    EXPECT_GT(mass.minCoeff(), 0.0);
  }
}

TEST(VertexLumpedMass, IntegratesLinearFunctionsExactly) {
  // ∫x over a closed box's surface, of area 2(ab + bc + ca), centred at `centre`.
  const Vec3 centre(0.3, -0.7, 1.1);
  const TriangleMesh mesh = transformed(box({1, 2, 3}, 3), Mat3::Identity(), centre);
  const Vector mass = vertexLumpedMass(mesh.vertices, mesh.faces);
  const Vec3 integral = mesh.vertices.transpose() * mass;
  EXPECT_LT((integral - 22.0 * centre).norm(), 1e-12);
}

TEST(VertexLumpedMass, GrowsWithTheSquareOfTheScale) {
  const TriangleMesh mesh = blob(4);
  const Vector before = vertexLumpedMass(mesh.vertices, mesh.faces);
  const Vector after = vertexLumpedMass(10 * mesh.vertices, mesh.faces);
  EXPECT_LT((after - 100 * before).cwiseAbs().maxCoeff(), 1e-12);
}

} // namespace
} // namespace massprops::testing
