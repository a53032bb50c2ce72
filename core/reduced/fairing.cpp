#include "core/reduced/fairing.h"

#include "core/mesh/components.h"

#include <algorithm>
#include <cstddef>

namespace massprops {
namespace {

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

Faces facesAt(const Faces& faces, const std::vector<char>& marks) {
  Faces result(faces.rows(), 3);
  Eigen::Index count = 0;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const auto corners = faces.row(f);
    if (std::any_of(corners.begin(), corners.end(), [&](int v) { return marks[at(v)] != 0; }))
      result.row(count++) = corners;
  }
  return result.topRows(count);
}

} // namespace

Skin::Skin(const Points& vertices, const Faces& faces, const std::vector<char>& isFree,
           double length)
    : vertices_(vertices) {
  std::vector<char> isNear = isFree;
  const Faces freeFaces = facesAt(faces, isFree);
  for (const int v : freeFaces.reshaped()) isNear[at(v)] = 1;
  const Submesh patch = submesh(vertices, facesAt(faces, isNear));
  const Points& x = patch.mesh.vertices;
  const SparseMatrix laplacian = cotanLaplacian(x, patch.mesh.faces);
  const Vector mass = vertexLumpedMass(x, patch.mesh.faces);
  // The patch ends beyond the neighbours, whose Laplacians are the last that are complete.
  Vector stiffness = Vector::Zero(x.rows());
  std::vector<int> unknownOf(at(x.rows()), -1);
  std::vector<double> freeMass;
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    const int v = patch.vertexOf[at(i)];
    if (isNear[at(v)] != 0 && mass[i] > 0.0) stiffness[i] = length * length / mass[i];
    if (isFree[at(v)] == 0) continue;
    unknownOf[at(i)] = static_cast<int>(free_.size());
    free_.push_back(v);
    freeMass.push_back(mass[i]);
  }
  const auto unknowns = static_cast<Eigen::Index>(free_.size());
  mass_ = Eigen::Map<const Vector>(freeMass.data(), unknowns);
  const SparseMatrix energy =
      laplacian + SparseMatrix(laplacian * stiffness.asDiagonal() * laplacian);
  std::vector<Eigen::Triplet<double>> entries;
  pull_ = Matrix::Zero(unknowns, 3);
  for (Eigen::Index j = 0; j < x.rows(); ++j) {
    const int column = unknownOf[at(j)];
    for (SparseMatrix::InnerIterator entry(energy, j); entry; ++entry) {
      const int row = unknownOf[at(entry.row())];
      if (row < 0) continue;
      if (column >= 0) {
        entries.emplace_back(row, column, entry.value());
      } else {
        pull_.row(row) -= entry.value() * x.row(j);
      }
    }
  }
  SparseMatrix system(unknowns, unknowns);
  system.setFromTriplets(entries.begin(), entries.end());
  solver_.compute(system);
}

Points Skin::atRest() const {
  const Matrix solution = solver_.solve(pull_);
  Points result = vertices_;
  for (std::size_t i = 0; i < free_.size(); ++i)
    result.row(free_[i]) = solution.row(static_cast<Eigen::Index>(i));
  return result;
}

RowMatrix Skin::deflections(const RowMatrix& pressures) const {
  Matrix loads(mass_.size(), pressures.cols());
  for (std::size_t i = 0; i < free_.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    loads.row(row) = mass_[row] * pressures.row(free_[i]);
  }
  const Matrix solution = solver_.solve(loads);
  RowMatrix result = RowMatrix::Zero(vertices_.rows(), pressures.cols());
  for (std::size_t i = 0; i < free_.size(); ++i)
    result.row(free_[i]) = solution.row(static_cast<Eigen::Index>(i));
  return result;
}

} // namespace massprops
