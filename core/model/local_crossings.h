// Mending: a few places where the surface crosses itself.
#pragma once

#include "core/model/mending_step.h"

namespace massprops {

/// Takes out the faces that cross others of the same component, with a few rings of those around
/// them, and closes the holes; only where that is little of the surface and leaves the volume as it
/// was, within half a per cent, and the surface where it was, within a wall. What cannot be mended
/// so stays. \pre a closed, coherently oriented 2-manifold
MendedMesh withoutLocalCrossings(const TriangleMesh& input, const MendingTask& task);

/// Likewise, but where not all of it can be mended so, as many places as can. For what a union
/// leaves, whose crossings are slivers; elsewhere they may be parts that overlap.
MendedMesh withFewerCrossings(const TriangleMesh& input, const MendingTask& task);

} // namespace massprops
