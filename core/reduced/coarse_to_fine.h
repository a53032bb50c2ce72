// Minimisation that begins on a coarse stand-in for the cavity.
#pragma once

#include "core/mesh/decimation.h"
#include "core/reduced/offset_problem.h"

namespace massprops {

/// As `minimize` on `evaluate`, but from the minimum of a cavity that has the proxy's vertices
/// alone and whose moments are corrected such that they are the cavity's own at the start: most
/// evaluations take place there, and a few on the cavity remain. `evaluations`: of both.
/// `proxy`: of the model's vertices, that the model's basis lives on.
/// \pre the outer surface rests and is closed; smoothness has no weight
MinimizeResult minimizeCoarseToFine(const OffsetModel& model, const DecimatedMesh& proxy,
                                    const Goal& goal, const Weights& weights, const Vector& start,
                                    const MinimizeOptions& options);

} // namespace massprops
