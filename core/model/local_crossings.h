// Mending: a few places where the surface crosses itself.
#pragma once

#include "core/model/mending_step.h"

namespace massprops {

/// Takes out the faces that cross others of the same component, with as few rings of those around
/// them as it takes, and closes the holes: each place only where that leaves the volume as it was,
/// within half a per cent, and the surface where it was, within a wall. A component of which not
/// all places can be mended so stays. \pre a closed, coherently oriented 2-manifold
MendedMesh withoutLocalCrossings(const TriangleMesh& input, const MendingTask& task);

/// Likewise, as many places as can be. For what a union leaves, whose crossings are slivers;
/// elsewhere they may be parts that overlap.
MendedMesh withFewerCrossings(const TriangleMesh& input, const MendingTask& task);

} // namespace massprops
