// The best that a cavity can do whose ceilings carry themselves.
#pragma once

#include "core/goals/goal.h"
#include "core/optimum/optimal_bound.h"
#include "core/overhang/supporting_fill.h"

namespace massprops {

/// A body whose cavity prints without support inside.
struct Printable {
  OptimalBound bound; ///< the proofs are those of all cavities
  OpenedSet set;      ///< what it may take
};

/// What carries the ceilings of the best body's cavity is filled and the best body found anew in
/// what is left, until it needs no more: a local optimum, not a bound. The best of several spacings
/// between pillars. `possible`: the best body in the set; `behindWalls`: what it was found in,
/// before the set was opened. `within`: null, or a closed outward surface that the cavity does not
/// leave.
Printable printable(const Goal& goal, const Weights& weights, const Moments& solid,
                    const Fillings& fillings, const RegionParts& behindWalls, const OpenedSet& set,
                    const OptimalBound& possible, const OverhangWishes& wishes,
                    const TriangleMesh* within = nullptr);

} // namespace massprops
