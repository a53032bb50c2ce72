// The discrete Laplace–Beltrami operator of a triangle mesh.
#pragma once

#include "core/base/types.h"

#include <Eigen/SparseCore>

namespace massprops {

using SparseMatrix = Eigen::SparseMatrix<double>;

/// Cotangent stiffness matrix, n×n, symmetric, positive semidefinite, dimensionless:
/// L_ij = −½(cot φ_l + cot φ_r), L_ii = −Σ_j L_ij. Constants span its kernel on a connected
/// surface. A triangle flatter than 1e-4 counts with less than its weight, so that it cannot drown
/// the others; one whose corners coincide as one with equal sides. [PP93, Eq. 8]
SparseMatrix cotanLaplacian(const Points& vertices, const Faces& faces);

/// Diagonal of the lumped mass matrix: a third of the area around each vertex, length²; 0
/// where that has none.
Vector vertexLumpedMass(const Points& vertices, const Faces& faces);

} // namespace massprops
