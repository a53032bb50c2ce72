// Triangles that close the holes of a surface.
#pragma once

#include "core/base/types.h"

#include <vector>

namespace massprops {

/// The surface with every boundary loop closed by triangles about as large as those around it. The
/// vertices and faces given come first and unchanged, those of the lids after them.
/// \pre a coherently oriented 2-manifold, every vertex used, at most one fan of faces at each
/// \throw InvalidInput when a loop cannot be closed by triangles with an area
TriangleMesh withOpeningsFilled(const TriangleMesh& open);

/// Triangles between the vertices of one hole, least in area, over the vertices of `patch`; none
/// where it cannot be closed without making the patch non-manifold. `patch`: the faces around the
/// hole, every vertex used; `border`: the hole's vertices in the sense of the triangles that are
/// missing.
Faces holeFilling(const TriangleMesh& patch, const std::vector<int>& border);

} // namespace massprops
