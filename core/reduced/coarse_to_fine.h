// Minimisation that begins on a coarse stand-in for the cavity.
#pragma once

#include "core/reduced/offset_problem.h"

namespace massprops {

/// As `minimize` on `evaluate`, but from the minimum of a cavity that has the carrier's vertices
/// alone: most evaluations take place there, and a few on the cavity remain. `evaluations`: of
/// both. \pre the carrier is coarser than what moves; the outer surface rests and is closed;
/// smoothness has no weight
MinimizeResult minimizeCoarseToFine(const OffsetModel& model, const Goal& goal,
                                    const Weights& weights, const Vector& start,
                                    const MinimizeOptions& options);

} // namespace massprops
