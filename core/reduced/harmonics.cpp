#include "core/reduced/harmonics.h"

#include "core/base/symmetric_eigen.h"
#include "core/mesh/components.h"

#include <Eigen/SparseCholesky>
#include <Spectra/SymEigsShiftSolver.h>

#include <algorithm>
#include <stdexcept>
#include <utility>
#include <vector>

namespace massprops {
namespace {

constexpr Eigen::Index kDenseSize = 256;
/// Of the mean: a vertex around which there is no area would make the problem singular.
constexpr double kLeastMass = 1e-6;

[[noreturn]] void throwUnconverged() {
  throw std::runtime_error("the harmonic basis did not converge: lower basis_k, or use "
                           "Remeshing > Isotropic Explicit Remeshing, then run again");
}

/// The generalised problem as a standard one, A = M^{-1/2} L M^{-1/2}; Spectra asks for
/// y = (A − σ)⁻¹ x = M^{1/2} (L − σM)⁻¹ M^{1/2} x.
class ShiftInvertedLaplacian {
public:
  using Scalar = double;

  ShiftInvertedLaplacian(const SparseMatrix& L, const Vector& mass)
      : L_(L), mass_(mass), rootMass_(mass.cwiseSqrt()) {}

  Eigen::Index rows() const { return L_.rows(); }
  Eigen::Index cols() const { return L_.cols(); }

  /// Spectra calls this for every solve; the factorisation serves all with the same shift.
  void set_shift(double sigma) {
    if (sigma == shift_) return;
    shift_ = sigma;
    solver_.analyzePattern(L_);
    solver_.factorize(shifted(sigma));
    if (solver_.info() != Eigen::Success) {
      throw std::runtime_error("the Laplacian of this mesh cannot be factorised: use Remeshing: "
                               "Isotropic Explicit Remeshing, then run again");
    }
  }

  void perform_op(const double* x, double* y) const {
    const Eigen::Map<const Vector> in(x, rows());
    Eigen::Map<Vector> out(y, rows());
    const Vector rhs = rootMass_.cwiseProduct(outside(in));
    out = outside(rootMass_.cwiseProduct(solver_.solve(rhs)));
  }

  /// Whether so many eigenvalues, counted with their multiplicity, lie below `value`: as many as
  /// pivots of L − value·M are negative, by Sylvester's law of inertia. False, too, where a pivot
  /// is too small for its sign to be known. The shift is to be set anew before the next solve.
  bool hasBelow(Eigen::Index count, double value) {
    constexpr double kKnownSign = 1e-10;
    shift_ = value;
    solver_.factorize(shifted(value));
    if (solver_.info() != Eigen::Success) return false;
    const Vector pivots = solver_.vectorD();
    return pivots.cwiseAbs().minCoeff() > kKnownSign * pivots.cwiseAbs().maxCoeff() &&
           (pivots.array() < 0.0).count() == count;
  }

  /// From now on works in the complement of the orthonormal columns of `found` (n×m).
  void deflate(const Matrix& found) { found_ = found; }

private:
  SparseMatrix shifted(double sigma) const {
    SparseMatrix result = L_;
    result.diagonal() -= sigma * mass_;
    return result;
  }

  Vector outside(const Vector& x) const {
    return found_.cols() == 0 ? x : Vector(x - found_ * (found_.transpose() * x));
  }

  const SparseMatrix& L_;
  const Vector& mass_;
  Vector rootMass_;
  Matrix found_;
  double shift_ = 0.0;
  Eigen::SimplicialLDLT<SparseMatrix> solver_;
};

/// Eigenvalues ascending, n×k orthonormal eigenvectors of the standard problem.
struct Modes {
  Vector values;
  Matrix vectors;
};

Modes lowestModes(ShiftInvertedLaplacian& op, int k, double shift) {
  const int n = static_cast<int>(op.rows());
  const int krylovSize = std::min(n, std::max(3 * k / 2 + 1, k + 20));
  Spectra::SymEigsShiftSolver<ShiftInvertedLaplacian> solver(op, k, krylovSize, shift);
  solver.init();
  constexpr double kTolerance = 1e-9;
  solver.compute(Spectra::SortRule::LargestMagn, 1000, kTolerance, Spectra::SortRule::SmallestAlge);
  if (solver.info() != Spectra::CompInfo::Successful) throwUnconverged();
  return {solver.eigenvalues(), solver.eigenvectors()};
}

/// For small meshes, whose Krylov spaces would be nearly the whole space.
Modes lowestModesDense(const SparseMatrix& L, const Vector& mass, int k) {
  const Vector scale = mass.cwiseSqrt().cwiseInverse();
  const SymmetricEigen<Matrix> all =
      symmetricEigen(Matrix(scale.asDiagonal() * Matrix(L) * scale.asDiagonal()));
  if (!all.converged) throwUnconverged();
  return {all.values.head(k), all.vectors.leftCols(k)};
}

/// The k lowest of both.
Modes merged(const Modes& a, const Modes& b, int k) {
  std::vector<std::pair<double, Vector>> all;
  for (const Modes* modes : {&a, &b}) {
    for (Eigen::Index j = 0; j < modes->values.size(); ++j) {
      all.emplace_back(modes->values[j], modes->vectors.col(j));
    }
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const auto& p, const auto& q) { return p.first < q.first; });
  Modes result{Vector(k), Matrix(a.vectors.rows(), k)};
  for (int j = 0; j < k; ++j) {
    result.values[j] = all[static_cast<std::size_t>(j)].first;
    result.vectors.col(j) = all[static_cast<std::size_t>(j)].second;
  }
  return result;
}

/// A Krylov space holds one direction of every eigenspace, so that copies of a multiple eigenvalue
/// may be missing: looks again in the complement of what was found until nothing lower is left.
Modes lowestModesWithCopies(const SparseMatrix& L, const Vector& mass, int k, double shift) {
  ShiftInvertedLaplacian op(L, mass);
  Modes modes = lowestModes(op, k, shift);
  constexpr double kBelowLast = 1.0 - 1e-6;
  const double last = kBelowLast * modes.values[k - 1];
  if (op.hasBelow((modes.values.array() < last).count(), last)) return modes;
  for (int round = 0; round < k; ++round) {
    op.deflate(modes.vectors);
    const Modes next = lowestModes(op, 1, shift);
    if (next.values[0] > modes.values[k - 1] * (1.0 + 1e-9)) break;
    modes = merged(modes, next, k);
  }
  return modes;
}

/// Of one component.
HarmonicBasis basisOf(const SparseMatrix& L, const Vector& area, int k) {
  const Vector mass = area.cwiseMax(kLeastMass * area.mean());
  // L is singular; a shift of a tenth of the smallest possible eigenvalue scale 1/total mass keeps
  // the factorisation regular without costing accuracy.
  const double shift = -0.1 / mass.sum();
  const Modes modes = L.rows() <= kDenseSize ? lowestModesDense(L, mass, k)
                                             : lowestModesWithCopies(L, mass, k, shift);
  HarmonicBasis basis;
  basis.eigenvalues = modes.values;
  basis.functions = mass.cwiseSqrt().cwiseInverse().asDiagonal() * modes.vectors;
  for (Eigen::Index j = 0; j < basis.functions.cols(); ++j) {
    Eigen::Index largest = 0;
    basis.functions.col(j).cwiseAbs().maxCoeff(&largest);
    if (basis.functions(largest, j) < 0.0) basis.functions.col(j) *= -1.0;
  }
  return basis;
}

} // namespace

HarmonicBasis harmonicBasis(const Points& vertices, const Faces& faces, const SparseMatrix& L,
                            const Vector& mass, int k) {
  const std::vector<Submesh> parts = componentMeshes(vertices, faces);
  if (parts.size() == 1) return basisOf(L, mass, k);
  struct Mode {
    double eigenvalue;
    std::size_t component;
    Eigen::Index column;
  };
  std::vector<Mode> modes;
  std::vector<HarmonicBasis> bases;
  for (const Submesh& part : parts) {
    Vector partMass(part.mesh.vertices.rows());
    for (std::size_t i = 0; i < part.vertexOf.size(); ++i) {
      partMass[static_cast<Eigen::Index>(i)] = mass[part.vertexOf[i]];
    }
    const int most = static_cast<int>(part.mesh.vertices.rows()) - 1;
    bases.push_back(
        basisOf(cotanLaplacian(part.mesh.vertices, part.mesh.faces), partMass, std::min(k, most)));
    for (Eigen::Index j = 0; j < bases.back().eigenvalues.size(); ++j) {
      modes.push_back({bases.back().eigenvalues[j], bases.size() - 1, j});
    }
  }
  std::stable_sort(modes.begin(), modes.end(),
                   [](const Mode& a, const Mode& b) { return a.eigenvalue < b.eigenvalue; });
  modes.resize(std::min(modes.size(), static_cast<std::size_t>(k)));
  HarmonicBasis basis;
  const auto columns = static_cast<Eigen::Index>(modes.size());
  basis.eigenvalues.resize(columns);
  basis.functions.setZero(vertices.rows(), columns);
  for (Eigen::Index j = 0; j < columns; ++j) {
    const Mode& mode = modes[static_cast<std::size_t>(j)];
    basis.eigenvalues[j] = mode.eigenvalue;
    const std::vector<int>& vertexOf = parts[mode.component].vertexOf;
    for (std::size_t i = 0; i < vertexOf.size(); ++i) {
      basis.functions(vertexOf[i], j) =
          bases[mode.component].functions(static_cast<Eigen::Index>(i), mode.column);
    }
  }
  return basis;
}

} // namespace massprops
