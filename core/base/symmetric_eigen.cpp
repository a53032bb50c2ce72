#include "core/base/symmetric_eigen.h"

#include <Eigen/Eigenvalues>

namespace massprops {
namespace {

template <class M>
SymmetricEigen<M> solve(const M& a) {
  const Eigen::SelfAdjointEigenSolver<M> solver(a);
  return {solver.eigenvalues(), solver.eigenvectors(), solver.info() == Eigen::Success};
}

} // namespace

SymmetricEigen<Eigen::Matrix2d> symmetricEigen(const Eigen::Matrix2d& a) {
  return solve(a);
}
SymmetricEigen<Mat3> symmetricEigen(const Mat3& a) {
  return solve(a);
}
SymmetricEigen<Matrix> symmetricEigen(const Matrix& a) {
  return solve(a);
}

} // namespace massprops
