// A cavity's surface as far from the outer one as is asked for, edges and insides of faces
// included.
#pragma once

#include "core/base/types.h"
#include "core/query/triangle_tree.h"

#include <vector>

namespace massprops {

/// Moves vertices away from the outer surface until no triangle is nearer to it than `wall`, a
/// length in their unit, as far as triangles stay sound. The vertices of triangles that are still
/// nearer, ascending. `kept`: positions of the vertices where every triangle is known to keep the
/// wall, if any are. \pre closed outward surfaces, the cavity inside of the other
std::vector<int> keepWall(const TriangleTree& surface, double wall, TriangleMesh& cavity,
                          const Points* kept = nullptr);

} // namespace massprops
