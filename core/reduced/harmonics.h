// The smoothest functions on a surface: the basis in which the offsets are sought.
#pragma once

#include "core/base/types.h"
#include "core/reduced/laplacian.h"

namespace massprops {

struct HarmonicBasis {
  /// n×k, column j is the j-th harmonic γ_j; L γ = λ M γ and HᵀMH = 1. The first is constant.
  RowMatrix functions;
  /// The k lowest eigenvalues, ascending; the first is 0 up to rounding.
  Vector eigenvalues;
};

/// The k manifold harmonics of lowest frequency. With M scaled to total 1 the functions are of
/// order one and the eigenvalues dimensionless, whatever the unit of length. [VL08]
/// L: n×n, the surface's `cotanLaplacian`; mass: n entries, where those below a millionth of the
/// mean count as that. The sign of each function is such that its entry of largest magnitude is
/// positive. Each component is solved on its own, for an eigenvalue as often as there are
/// components is hard to find; the k lowest of all are kept.
/// \pre 1 ≤ k < n
/// \throw std::runtime_error when the eigensolver does not converge
HarmonicBasis harmonicBasis(const Points& vertices, const Faces& faces, const SparseMatrix& L,
                            const Vector& mass, int k);

} // namespace massprops
