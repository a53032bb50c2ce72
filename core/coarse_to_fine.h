// Optimisation on a coarse surface that stands for a fine one.
#pragma once

#include "core/offset_problem.h"
#include "core/optimize.h"

namespace massprops {

/// Minimises over `fine` with few evaluations of it: the coarse cavity's moments, shifted to the
/// fine one's values at the present point, are minimised instead; at the point so found they are
/// shifted anew [BCD04]. What this converges to keeps the constraints of `fine` and is
/// optimal up to the difference of the derivatives. docs/math.md "Coarse to fine"
/// Both models have the same basis and no moving outer surface; smoothness has no weight.
OptimizeResult minimizeCoarseToFine(const OffsetModel& fine, const OffsetModel& coarse,
                                    const Goal& goal, const Weights& weights, const Vector& start,
                                    const OptimizeOptions& options = {});

} // namespace massprops
