// The greatest level of a goal's linear conditions that any cavity could reach.
#pragma once

#include "core/goals/goal.h"
#include "core/optimum/admissible_cells.h"
#include "core/optimum/layered_quadric.h"
#include "core/physics/filling.h"

#include <vector>

namespace massprops {

/// By weak duality: whatever the multipliers λ ≥ 0 with sum 1, a body that meets all conditions in
/// all its states at the level t meets their sum λ·(atZero + t slopes), and what meets that best is
/// hollow on one side of a plane or quadric, between the levels of contents of one each.
/// [docs/math.md "Out of reach"]
struct LevelBound {
  /// The best body that was found, in each of its states: working frame, density 1.
  std::vector<Moments> states;
  double reached = 0.0; ///< its level
  double level = 0.0;   ///< no body that is hollow within the cells exceeds this
  Matrix multipliers;   ///< a row a condition, a column a state
  /// What hollowing out a point lowers λ·(atZero + level slopes) by, for multipliers λ whose best
  /// body, hollow where this is positive, is the best that was found; those above, where that is
  /// the solid one.
  LayeredQuadric worth;
};

/// σ of Σ w_s·(M_s, 1) = constant − ∫_cavity σ, for functionals w_s of the states of one body, a
/// column of 11 each.
LayeredQuadric worthOfHollowing(const Eigen::Matrix<double, 11, Eigen::Dynamic>& functionals,
                                const Fillings& fillings);

/// `solid`: moments of the body without a cavity, density 1. A level of contents that cuts cells
/// counts those with their centroid below it. \pre there are cells and conditions
LevelBound greatestLevel(const LinearConditions& conditions, const Moments& solid,
                         const Fillings& fillings, const AdmissibleCells& cells);

} // namespace massprops
