// Eigenvalues and eigenvectors of symmetric matrices, as Eigen's iterative solver gives them. Its
// templates are compiled here once, instead of for five to ten seconds wherever they are used.
#pragma once

#include "core/base/types.h"

namespace massprops {

/// A V = V diag(values): values ascending, a vector of unit length in each column of V, orthogonal
/// to the others; a vector's sign is arbitrary.
template <class M>
struct SymmetricEigen {
  Eigen::Matrix<double, M::RowsAtCompileTime, 1> values;
  M vectors;
  bool converged; ///< for finite entries always
};

/// Of symmetric A, of which only the lower triangle is read.
SymmetricEigen<Eigen::Matrix2d> symmetricEigen(const Eigen::Matrix2d& a);
SymmetricEigen<Mat3> symmetricEigen(const Mat3& a);
SymmetricEigen<Matrix> symmetricEigen(const Matrix& a);

} // namespace massprops
