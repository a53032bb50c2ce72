// Mending: bodies that overlap.
#pragma once

#include "core/model/mending_step.h"

namespace massprops {

/// Unites components that cross each other, and leaves out those that lie within the material of
/// others. Components inside of a body that face the other way are its cavities and stay; what lies
/// in a cavity is left out, for the new one takes its place. \pre closed components; those that
/// cross themselves are left as they are, with all that they cross
MendedMesh unitedBodies(const TriangleMesh& mesh, const MendingTask& task);

} // namespace massprops
