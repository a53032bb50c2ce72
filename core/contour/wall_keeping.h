// A cavity's surface as far from the outer one as is asked for, edges and insides of faces
// included.
#pragma once

#include "core/base/types.h"
#include "core/query/triangle_tree.h"

#include <vector>

namespace massprops {

/// Moves vertices away from the outer surface until no triangle is nearer to it than `wall`, as far
/// as triangles stay sound. The vertices of those for which that did not do.
std::vector<int> keepWall(const TriangleTree& surface, double wall, TriangleMesh& cavity);

} // namespace massprops
