// Lids on the openings of a surface, for what needs a closed one.
#pragma once

#include "core/base/types.h"

namespace massprops {

/// The surface with every boundary loop closed by triangles about as large as those around it. The
/// vertices and faces given come first and unchanged, those of the lids after them.
/// \pre a coherently oriented 2-manifold, every vertex used, at most one fan of faces at each
/// \throw InvalidInput when a loop cannot be closed by triangles with an area
TriangleMesh withOpeningsFilled(const TriangleMesh& open);

} // namespace massprops
