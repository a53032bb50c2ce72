// Functions carried over from a decimated surface.
#include "core/mesh/interpolation.h"

#include "shapes.h"

#include <gtest/gtest.h>

namespace massprops::testing {
namespace {

TEST(Interpolation, ReproducesConstantsAndNearlyThePositions) {
  const TriangleMesh mesh = blob(40);
  const DecimatedMesh coarseMesh = decimated(mesh.vertices, mesh.faces, {1000, 1000, 0.0});
  const Interpolation interpolation = interpolationFrom(coarseMesh, mesh.vertices);
  const Vector ones = interpolation * Vector(Vector::Ones(1000));
  EXPECT_LT((ones.array() - 1.0).abs().maxCoeff(), 1e-14);
  const Points positions = interpolation * coarseMesh.mesh.vertices;
  // A few times the depth of an arc over an edge.
  EXPECT_LT((positions - mesh.vertices).rowwise().norm().maxCoeff(), 0.02);
}

TEST(Interpolation, HasTheTransposeOfItself) {
  const TriangleMesh mesh = blob(40);
  const DecimatedMesh coarseMesh = decimated(mesh.vertices, mesh.faces, {1000, 1000, 0.0});
  Random random(5);
  const Vector coarse = random.vector(1000);
  const Vector fine = random.vector(mesh.vertices.rows());
  const Interpolation interpolation = interpolationFrom(coarseMesh, mesh.vertices);
  const Matrix back = interpolation.transposeTimes(fine);
  // Rounding of 16,000 terms of order one.
  EXPECT_NEAR(fine.dot(interpolation * coarse), back.col(0).dot(coarse), 1e-10);
}

TEST(Interpolation, IsTheIdentityWhereNothingWasDecimated) {
  const TriangleMesh mesh = blob(4);
  const DecimatedMesh same = decimated(mesh.vertices, mesh.faces, {600, 600, 0.0});
  const Interpolation interpolation = interpolationFrom(same, mesh.vertices);
  ASSERT_TRUE(interpolation.isIdentity());
  EXPECT_EQ(interpolation * mesh.vertices, mesh.vertices);
}

} // namespace
} // namespace massprops::testing
