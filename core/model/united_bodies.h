// Mending: bodies that overlap.
#pragma once

#include "core/model/mending_step.h"

namespace massprops {

/// Cuts all faces along the lines where they cross and keeps the pieces that have nothing in front
/// of them and material behind, by the winding number: the union of bodies that cross each other or
/// themselves; what is turned inside out goes. Components inside of a body that face the other way
/// are its cavities and stay; what lies in a cavity is left out, for the new one takes its place.
/// Where bodies lie on each other but for rounding, narrow gaps may be left.
/// \pre as many faces run along every edge as against it, otherwise nothing is done
MendedMesh unitedBodies(const TriangleMesh& input, const MendingTask& task);

} // namespace massprops
