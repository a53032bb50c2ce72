// Mending: components that enclose nothing.
#pragma once

#include "core/model/mending_step.h"

namespace massprops {

/// Leaves out closed components thinner on average than can be told from nothing, where others are
/// left, and open ones that no patch makes a body of, where they are little of the surface.
MendedMesh withoutEmptyShells(const TriangleMesh& input, const MendingTask& task);

} // namespace massprops
