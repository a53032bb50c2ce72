// The greatest level of a goal's linear conditions that any cavity could reach.
#pragma once

#include "core/goals/goal.h"
#include "core/optimum/admissible_cells.h"

namespace massprops {

/// By weak duality: whatever the multipliers λ ≥ 0 with sum 1, a body that meets all conditions at
/// the level t meets their sum λ·(atZero + t slopes), and what meets that best is hollow on one
/// side of a plane or quadric. [docs/math.md "Out of reach"]
struct LevelBound {
  Moments body = Moments::Zero(); ///< the best that was found, working frame, density 1
  double reached = 0.0;           ///< its level
  double level = 0.0;             ///< no body that is hollow within the cells exceeds this
  Vector multipliers;             ///< a condition each
  /// λ·(atZero + level slopes), of (M, 1): the relaxation's best body is hollow where filling it
  /// with material would raise this.
  Eigen::Matrix<double, 11, 1> functional = Eigen::Matrix<double, 11, 1>::Zero();
};

/// `solid`: moments of the body without a cavity, density 1; `fillDensity`: as a multiple of the
/// material's. \pre there are cells and conditions
LevelBound greatestLevel(const LinearConditions& conditions, const Moments& solid,
                         double fillDensity, const AdmissibleCells& cells);

} // namespace massprops
