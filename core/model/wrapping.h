// Mending, the last resort: a new surface around the old one.
#pragma once

#include "core/model/mending_step.h"

namespace massprops {

/// A closed surface around the triangles, whatever they are, at most a quarter of the wall outside
/// of them; gaps narrower than a ball are closed, for which the holes are too narrow, or, where
/// that does not keep the volume, one of a twelfth of the diagonal. How far both surfaces are from
/// each other, where the old one shows, and by how much the volume changed is told; beyond one
/// wall or 3 % with a warning. [PRHCA22] Nothing is done where the triangles enclose nothing.
MendedMesh wrapped(const TriangleMesh& input, const MendingTask& task);

} // namespace massprops
