// Functions on a decimated surface, carried over to the surface.
#pragma once

#include "core/base/types.h"
#include "core/mesh/decimation.h"

namespace massprops {

/// Values at a surface's n vertices as weighted means of values at p other points, at most three
/// each: the matrix P of n rows and p columns, whose rows are positive and sum to 1.
class Interpolation {
public:
  /// `corners`, `weights`: n×3
  Interpolation(Faces corners, Points weights, Eigen::Index coarseSize);
  /// P = 1.
  static Interpolation identity(Eigen::Index size);

  bool isIdentity() const { return corners_.rows() == 0; }

  Vector operator*(const Vector& values) const;
  Points operator*(const Points& values) const;
  /// PᵀY, p×m, for Y n×m with few columns.
  RowMatrix transposeTimes(const Eigen::Ref<const RowMatrix>& values) const;

private:
  Interpolation() = default;

  Eigen::Index rows_ = 0;
  Eigen::Index cols_ = 0;
  Faces corners_;
  Points weights_;
};

/// The surface's vertices by the decimated one's, at the points of that next to them.
/// `vertices`: those of the surface that was decimated.
Interpolation interpolationFrom(const DecimatedMesh& coarse, const Points& vertices);

} // namespace massprops
