#include "core/harmonics.h"

#include <Eigen/SparseCholesky>
#include <Spectra/SymEigsShiftSolver.h>

#include <algorithm>
#include <stdexcept>

namespace massprops {
namespace {

/// The generalised problem as a standard one, A = M^{-1/2} L M^{-1/2}; Spectra asks for
/// y = (A − σ)⁻¹ x = M^{1/2} (L − σM)⁻¹ M^{1/2} x.
class ShiftInvertedLaplacian {
public:
  using Scalar = double;

  ShiftInvertedLaplacian(const SparseMatrix& L, const Vector& mass)
      : L_(L), mass_(mass), rootMass_(mass.cwiseSqrt()) {}

  Eigen::Index rows() const { return L_.rows(); }
  Eigen::Index cols() const { return L_.cols(); }

  void set_shift(double sigma) {
    SparseMatrix shifted = L_;
    shifted.diagonal() -= sigma * mass_;
    solver_.compute(shifted);
    if (solver_.info() != Eigen::Success) {
      throw std::runtime_error("the Laplacian of this mesh cannot be factorised: use Remeshing: "
                               "Isotropic Explicit Remeshing, then run again");
    }
  }

  void perform_op(const double* x, double* y) const {
    const Eigen::Map<const Vector> in(x, rows());
    Eigen::Map<Vector> out(y, rows());
    const Vector rhs = rootMass_.cwiseProduct(in);
    out = rootMass_.cwiseProduct(solver_.solve(rhs));
  }

private:
  const SparseMatrix& L_;
  const Vector& mass_;
  Vector rootMass_;
  Eigen::SimplicialLDLT<SparseMatrix> solver_;
};

} // namespace

HarmonicBasis harmonicBasis(const SparseMatrix& L, const Vector& mass, int k) {
  // L is singular; a shift of a tenth of the smallest possible eigenvalue scale 1/total mass keeps
  // the factorisation regular without costing accuracy.
  const double shift = -0.1 / mass.sum();
  const auto n = static_cast<int>(L.rows());
  const int krylovSize = std::min(n, std::max(2 * k + 1, k + 20));
  ShiftInvertedLaplacian op(L, mass);
  Spectra::SymEigsShiftSolver<ShiftInvertedLaplacian> solver(op, k, krylovSize, shift);
  solver.init();
  solver.compute(Spectra::SortRule::LargestMagn, 1000, 1e-12, Spectra::SortRule::SmallestAlge);
  if (solver.info() != Spectra::CompInfo::Successful) {
    throw std::runtime_error("the harmonic basis did not converge: lower basis_k, or use "
                             "Remeshing: Isotropic Explicit Remeshing, then run again");
  }
  HarmonicBasis basis;
  basis.eigenvalues = solver.eigenvalues();
  basis.functions = mass.cwiseSqrt().cwiseInverse().asDiagonal() * solver.eigenvectors();
  for (Eigen::Index j = 0; j < basis.functions.cols(); ++j) {
    Eigen::Index largest = 0;
    basis.functions.col(j).cwiseAbs().maxCoeff(&largest);
    if (basis.functions(largest, j) < 0.0) basis.functions.col(j) *= -1.0;
  }
  return basis;
}

} // namespace massprops
