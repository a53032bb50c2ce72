#include "core/laplacian.h"

#include <algorithm>
#include <vector>

namespace massprops {
namespace {

constexpr double kLargestCotangent = 1e4;

} // namespace

SparseMatrix cotanLaplacian(const Points& vertices, const Faces& faces) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(static_cast<std::size_t>(12 * faces.rows()));
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int apex = faces(f, k);
      const int i = faces(f, (k + 1) % 3);
      const int j = faces(f, (k + 2) % 3);
      const Vec3 u = (vertices.row(i) - vertices.row(apex)).transpose();
      const Vec3 v = (vertices.row(j) - vertices.row(apex)).transpose();
      const double sine = u.cross(v).norm();
      const double cosine = u.dot(v);
      const double bound = kLargestCotangent * sine;
      const double cotangent = std::abs(cosine) < bound ? cosine / sine
                               : cosine < 0.0           ? -kLargestCotangent
                                                        : kLargestCotangent;
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
    const Vec3 a = vertices.row(faces(f, 0)).transpose();
    const Vec3 b = vertices.row(faces(f, 1)).transpose();
    const Vec3 c = vertices.row(faces(f, 2)).transpose();
    const double third = (b - a).cross(c - a).norm() / 6.0;
    for (int k = 0; k < 3; ++k) mass[faces(f, k)] += third;
  }
  return mass;
}

} // namespace massprops
