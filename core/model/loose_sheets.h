// Mending: sheets that bound no material.
#pragma once

#include "core/model/mending_step.h"

namespace massprops {

/// Where more than two faces meet at edges: leaves out connected sheets that end there with
/// material on both sides, as walls within a body have it, or on none, as fins have it; only where
/// what they end on stays closed. \pre neighbours agree in orientation, as far as they can
MendedMesh withoutLooseSheets(const TriangleMesh& input, const MendingTask& task);

} // namespace massprops
