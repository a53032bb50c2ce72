// Optimisation on a coarse surface that stands for a fine one.
#pragma once

#include "core/offset_problem.h"
#include "core/optimize.h"

namespace massprops {

/// Minimises over `fine` with few evaluations of it: the coarse cavity's moments, corrected so that
/// at the present point they have the fine one's values and derivatives, are minimised instead; at
/// the point so found they are corrected anew. What this converges to is optimal for `fine`
/// [AL01]. Then the constraints are restored on `fine`. docs/math.md "Coarse to fine"
/// Both models have the same basis and no moving outer surface; smoothness has no weight.
OptimizeResult minimizeCoarseToFine(const OffsetModel& fine, const OffsetModel& coarse,
                                    const Goal& goal, const Weights& weights, const Vector& start,
                                    const OptimizeOptions& options = {});

} // namespace massprops
