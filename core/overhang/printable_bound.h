// The best that a cavity can do whose ceilings carry themselves.
#pragma once

#include "core/goals/goal.h"
#include "core/optimum/optimal_bound.h"
#include "core/overhang/supporting_fill.h"

#include <memory>
#include <vector>

namespace massprops {

/// A body whose cavity prints without support inside.
struct Printable {
  OptimalBound bound;                                ///< the proofs are those of all cavities
  FeasibleRegion region;                             ///< what it may take
  std::shared_ptr<const SupportingFill> filled = {}; ///< null: nothing
};

/// What a cavity is to do, and where.
struct PrintableTask {
  const Goal& goal;
  const Weights& weights;
  const Moments& solid;
  const Fillings& fillings;
  const FeasibleSet& set;
  const FeasibleRegion& region; ///< without what is filled
  double cells;                 ///< see `admissibleCells`
  const OverhangWishes& wishes;
};

/// What carries the ceilings of the best body's cavity is filled and the best body found anew in
/// what is left, until it needs no more: a local optimum, not a bound. The best of several spacings
/// between pillars; thicker where its ceilings hang down. `possible`: the best body in the region.
Printable printable(const PrintableTask& task, const OptimalBound& possible);

/// With columns below what hangs down. \pre something is filled
Printable withColumns(const PrintableTask& task, const Printable& printable,
                      const std::vector<Vec3>& tips);

} // namespace massprops
