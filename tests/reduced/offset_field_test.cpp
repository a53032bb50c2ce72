// Offset directions lead inwards and end within the body.
#include "core/reduced/offset_field.h"

#include "core/model/frame.h"
#include "core/reduced/skeleton.h"
#include "judge/checks.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace massprops::testing {
namespace {

TriangleMesh working(const TriangleMesh& mesh) {
  const double size =
      (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).norm();
  TriangleMesh result = scaled(mesh, 1 / size);
  result.vertices = snapped(result.vertices);
  return result;
}

TEST(OffsetField, LeadsInwardsFromAllFacesAndEndsWithinTheBody) {
  const TriangleMesh mesh = working(figure(3));
  const SparseMatrix L = cotanLaplacian(mesh.vertices, mesh.faces);
  const Vector mass = vertexLumpedMass(mesh.vertices, mesh.faces);
  const Points skeleton = meanCurvatureSkeleton(mesh.vertices, mesh.faces).points;
  const OffsetField field =
      offsetField(mesh.vertices, mesh.faces, smoothedOverSurface(skeleton, L, mass, 0.02));
  EXPECT_LT((field.directions.rowwise().norm().array() - 1.0).abs().maxCoeff(), 1e-12);
  EXPECT_GT(field.reach.minCoeff(), 0.0);

  // The clearance is what it says.
  Vector clearance = Vector::Ones(mesh.vertices.rows());
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    const Vec3 a = mesh.vertices.row(mesh.faces(f, 0)).transpose();
    const Vec3 b = mesh.vertices.row(mesh.faces(f, 1)).transpose();
    const Vec3 c = mesh.vertices.row(mesh.faces(f, 2)).transpose();
    const Vec3 normal = (b - a).cross(c - a).normalized();
    for (int k = 0; k < 3; ++k) {
      const int v = mesh.faces(f, k);
      clearance[v] = std::min(clearance[v], normal.dot(field.directions.row(v).transpose()));
    }
  }
  EXPECT_LT((clearance - field.clearance).cwiseAbs().maxCoeff(), 1e-12);

  // All ends of the offsets lie inside of the body where there is a way inwards.
  int outside = 0;
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    if (field.clearance[v] <= 0.0) continue;
    const Vec3 end =
        (mesh.vertices.row(v) - 0.9 * field.reach[v] * field.directions.row(v)).transpose();
    if (windingNumber(mesh, end) < 0.5) ++outside;
  }
  EXPECT_EQ(outside, 0);
}

TEST(OffsetField, OfABallPointsAwayFromItsCentre) {
  const TriangleMesh mesh = working(sphere(8));
  const SparseMatrix L = cotanLaplacian(mesh.vertices, mesh.faces);
  const Vector mass = vertexLumpedMass(mesh.vertices, mesh.faces);
  const Points centre = Points::Zero(mesh.vertices.rows(), 3);
  const OffsetField field =
      offsetField(mesh.vertices, mesh.faces, smoothedOverSurface(centre, L, mass, 0.02));
  const double radius = mesh.vertices.row(0).norm();
  EXPECT_LT((field.directions - mesh.vertices / radius).rowwise().norm().maxCoeff(), 1e-7);
  // Half of the chord through a polyhedron is up to 1 % short of the radius here.
  EXPECT_NEAR(field.reach.maxCoeff(), radius, 1e-7);
  EXPECT_GT(field.reach.minCoeff(), 0.98 * radius);
}

} // namespace
} // namespace massprops::testing
