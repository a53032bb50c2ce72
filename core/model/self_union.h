// Mending: bodies that cross themselves.
#pragma once

#include "core/model/mending_step.h"

namespace massprops {

/// Cuts all faces along the lines where they cross and keeps the pieces that have nothing in front
/// of them and material behind, by the winding number: the union of bodies that cross each other or
/// themselves. Cavities, which face the other way, stay; what is turned inside out goes.
/// \pre a closed, coherently oriented 2-manifold
MendedMesh selfUnited(const TriangleMesh& mesh, const MendingTask& task);

} // namespace massprops
