// Smooth surfaces over vertices that may move.
#pragma once

#include "core/reduced/laplacian.h"

#include <Eigen/SparseCholesky>

#include <vector>

namespace massprops {

/// A skin under tension that is stiff over a length and held by vertices that rest: it makes
/// ∫|∇x|² + length² ∫|Δx|² least, so that it joins them without a crease and is as small as it can
/// be farther away (docs/math.md "Ends of the offset surface").
class Skin {
public:
  /// The faces around free vertices and around their neighbours count, no others. `length`: in the
  /// vertices' unit. \pre every free vertex is connected with one that rests
  Skin(const Points& vertices, const Faces& faces, const std::vector<char>& isFree, double length);

  bool isSolvable() const { return solver_.info() == Eigen::Success; }
  /// All vertices, with the free ones where nothing presses them. \pre solvable
  Points atRest() const;
  /// How far the vertices give way where they are pressed (n×r each), w in −Δw + length² Δ²w = p; 0
  /// for those that rest. \pre solvable
  RowMatrix deflections(const RowMatrix& pressures) const;

private:
  Points vertices_;
  std::vector<int> free_; ///< vertices, in the order of the unknowns
  Vector mass_;           ///< of these
  Matrix pull_;           ///< by those that rest
  Eigen::SimplicialLDLT<SparseMatrix> solver_;
};

} // namespace massprops
