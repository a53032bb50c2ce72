// A proof that no cavity can do what is asked for.
#pragma once

#include "core/goals/goal.h"
#include "core/optimum/layered_quadric.h"
#include "core/optimum/level_bound.h"
#include "core/physics/filling.h"
#include "core/physics/half_spaces.h"
#include "core/query/triangle_tree.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace massprops {

/// Functionals w of (M, 1), one for each state, working frame, density 1, whose sum is at least
/// `margin` > 0 for every body that is hollow where the wall allows it; and yet ≤ 0 for every one
/// that meets some conditions, for they are their sums with the multipliers. [docs/math.md "Out of
/// reach"]
struct Certificate {
  Fillings fillings;                                     ///< those that count
  Eigen::Matrix<double, 11, Eigen::Dynamic> functionals; ///< a column a state
  /// ≥ 0, a row a condition, a column a state; none: w itself says where centres of mass are.
  Matrix multipliers;
  AffineRows rows; ///< the conditions at the wanted level
  double margin = 0.0;
};

/// The proof with the multipliers of the bound, for bodies that keep the wall from a closed outward
/// surface. What the surface's cells contribute is bounded from above: distances bound how much of
/// a cube may be hollow, values at its corners how much that is worth; cubes are divided until the
/// sum is small enough. Empty: not proved with the effort that is worth its time.
/// `solid`, `fillings`: as in `greatestLevel`. `wall`: working length.
std::optional<Certificate> certificate(const LinearConditions& conditions, double wantedLevel,
                                       const LevelBound& bound, const Moments& solid,
                                       const Fillings& fillings, const TriangleTree& surface,
                                       double wall);

/// A level that no body exceeds, proved for the multipliers of the bound and hardly above the least
/// one that this effort proves, which is that of two proofs as a rule. It may lie below the
/// bound's, which takes the border of what may be hollow for planes. Empty: not proved.
/// `mostCubes`: as in `PositivePartBounds`.
std::optional<double> provedLevel(const LinearConditions& conditions, const LevelBound& bound,
                                  const Moments& solid, const Fillings& fillings,
                                  const TriangleTree& surface, double wall, std::size_t mostCubes);

/// The proofs that no centre of mass is outside of any of the half-spaces, w being limit m −
/// normal·S for each; none where one of them is not found. What a proof learns of the surface
/// serves the next.
std::vector<Certificate> certificates(const HalfSpaces& set, const Moments& solid,
                                      const Filling& filling, const TriangleTree& surface,
                                      double wall);

} // namespace massprops
