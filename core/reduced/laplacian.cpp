#include "core/reduced/laplacian.h"

#include "core/base/triangle.h"

#include <algorithm>
#include <vector>

namespace massprops {
namespace {

/// Twice the least area that a triangle counts with, as a share of its longest edge squared.
constexpr double kLeastArea = 1e-4;
/// Cotangent of 60°, for triangles whose corners are one point: what they join stays joined.
constexpr double kOfEqualSides = 0.57735026918962576;

} // namespace

SparseMatrix cotanLaplacian(const Points& vertices, const Faces& faces) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(12 * faces.rows()));
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const Vec3 corner[3] = {vertices.row(faces(f, 0)).transpose(),
                            vertices.row(faces(f, 1)).transpose(),
                            vertices.row(faces(f, 2)).transpose()};
    const double longest =
        std::max({(corner[1] - corner[0]).squaredNorm(), (corner[2] - corner[1]).squaredNorm(),
                  (corner[0] - corner[2]).squaredNorm()});
    // The cotangents of a triangle share the denominator; a greater one scales the triangle's whole
    // part of L, which stays positive semidefinite.
    const double doubleArea = areaNormal(corner[0], corner[1], corner[2]).norm();
    const double denominator = std::max(doubleArea, kLeastArea * longest);
    const bool isPoint = !(denominator > 0.0);
    for (int k = 0; k < 3; ++k) {
      const int i = faces(f, (k + 1) % 3);
      const int j = faces(f, (k + 2) % 3);
      const double cotangent =
          isPoint ? kOfEqualSides
                  : (corner[(k + 1) % 3] - corner[k]).dot(corner[(k + 2) % 3] - corner[k]) /
                        denominator;
      const double weight = 0.5 * cotangent;
      entries.emplace_back(i, j, -weight);
      entries.emplace_back(j, i, -weight);
      entries.emplace_back(i, i, weight);
      entries.emplace_back(j, j, weight);
    }
  }
  SparseMatrix L(vertices.rows(), vertices.rows());
  L.setFromTriplets(entries.begin(), entries.end());
  return L;
}

Vector vertexLumpedMass(const Points& vertices, const Faces& faces) {
  Vector mass = Vector::Zero(vertices.rows());
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const double third = areaNormal(vertices, faces, f).norm() / 6.0;
    for (int k = 0; k < 3; ++k) mass[faces(f, k)] += third;
  }
  return mass;
}

} // namespace massprops
