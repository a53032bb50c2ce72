// What tests of the offsets share: models as the working frame has them, and clearances by the
// definition.
#pragma once

#include "core/model/frame.h"
#include "shapes.h"

#include <algorithm>

namespace massprops::testing {

/// With a diagonal of 1, on the grid of the working frame.
inline TriangleMesh working(const TriangleMesh& mesh) {
  const double size =
      (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).norm();
  TriangleMesh result = scaled(mesh, 1 / size);
  result.vertices = snapped(result.vertices);
  return result;
}

/// Least n_f·d_v over the faces f around each vertex v, at most 1.
inline Vector clearances(const TriangleMesh& mesh, const Points& directions) {
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

} // namespace massprops::testing
