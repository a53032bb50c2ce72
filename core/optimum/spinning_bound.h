// How low the objective of a body that spins can be at all.
#pragma once

#include "core/goals/spinning_axis.h"
#include "core/optimum/admissible_cells.h"

#include <optional>

namespace massprops {

struct SpinningBound {
  /// No body that is hollow within the cells, meets the task's equalities and has its moment about
  /// the axis not between the other two has a lower objective, terms 1 to 3.
  double objective;
  /// The dual problem's best body is hollow where filling it with material would raise this.
  AffineRow functional;
  int problems; ///< convex ones that were solved

  /// Whether that is near enough to what a body has.
  bool isNear(double known) const {
    constexpr double kNear = 5e-3;
    return known - objective <= kNear * known;
  }
};

/// By weak duality, and for Spin by branch and bound over the height of the centre of mass and the
/// part of the objective that is linear in the moments. `known`: the objective that a body has; the
/// bound is raised until it is near to that or the effort is not worth its time. `volumeWeight`: of
/// term 1. `solid`, `fillDensity`: as for `optimalBound`. Empty: with a filling as dense as the
/// material there is nothing to choose. [docs/math.md "How low Spin and Yo-yo can be"]
std::optional<SpinningBound> spinningBound(const SpinningTask& task, double volumeWeight,
                                           double known, const Moments& solid, double fillDensity,
                                           const AdmissibleCells& cells);

} // namespace massprops
