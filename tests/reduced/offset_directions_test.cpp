// Offset directions leave every face around their vertex, as far as any direction does. With those
// outside of the cones kept, the toy dinosaur's gap to the limit at a wall of 1 % is 13.4 % instead
// of 5.2 %, the toy dog's 6.5 % instead of 4.6 %.
#include "core/reduced/offset_field.h"

#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ostream>
#include <string>

namespace massprops::testing {
namespace {

struct Shape {
  const char* name;
  TriangleMesh mesh;
};

void PrintTo(const Shape& shape, std::ostream* os) {
  *os << shape.name;
}

class OffsetDirections : public ::testing::TestWithParam<Shape> {};
INSTANTIATE_TEST_SUITE_P(Shapes, OffsetDirections,
                         ::testing::Values(Shape{"Figure", figure(4)},
                                           Shape{"Torus", torus(1.0, 0.3, 40, 20)}),
                         [](const auto& test) { return std::string(test.param.name); });

/// Least n_f·d_v over the faces f around each vertex v.
Vector clearances(const TriangleMesh& mesh, const Points& directions) {
  Vector least = Vector::Ones(mesh.vertices.rows());
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    const Vec3 a = mesh.vertices.row(mesh.faces(f, 0)).transpose();
    const Vec3 b = mesh.vertices.row(mesh.faces(f, 1)).transpose();
    const Vec3 c = mesh.vertices.row(mesh.faces(f, 2)).transpose();
    const Vec3 normal = (b - a).cross(c - a).normalized();
    for (const int v : mesh.faces.row(f)) {
      least[v] = std::min(least[v], normal.dot(directions.row(v).transpose()));
    }
  }
  return least;
}

TEST_P(OffsetDirections, LieInTheConeOfTheFacesAroundTheirVertex) {
  const TriangleMesh& mesh = GetParam().mesh;
  // From one point in the middle most directions are far from the normals, and many outside.
  const Vec3 middle = mesh.vertices.colwise().mean().transpose() + Vec3(0.1, 0.05, 0.0);
  const Points axis = Points::Zero(mesh.vertices.rows(), 3).rowwise() + middle.transpose();
  const Points straight = (mesh.vertices - axis).rowwise().normalized();
  const Vector before = clearances(mesh, straight);
  ASSERT_LT(before.minCoeff(), 0.0);
  for (const double wanted : {kSlantedClearance, kSteepClearance}) {
    const OffsetField field = offsetField(mesh.vertices, mesh.faces, axis, wanted);
    const Vector clearance = clearances(mesh, field.directions);
    EXPECT_LT((clearance - field.clearance).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_GE(clearance.minCoeff(), wanted - 1e-12);
    // Those that lie inside stay as they are.
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
      if (before[v] < wanted) continue;
      EXPECT_LT((field.directions.row(v) - straight.row(v)).norm(), 1e-12);
    }
  }
}

} // namespace
} // namespace massprops::testing
