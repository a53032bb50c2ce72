// Mending, the first step: borders that belong together.
#pragma once

#include "core/model/mending_step.h"

namespace massprops {

/// Merges vertices of the borders that lie at nearly the same place, splits the faces along a
/// border at the border's vertices that lie on their edges (T-junctions), and takes out faces
/// without area by turning their longest edge.
MendedMesh joinedSeams(const TriangleMesh& input, const MendingTask& task);

} // namespace massprops
