// The wall as the cavity's layer carries it, vertex by vertex.
#pragma once

#include "core/query/triangle_tree.h"

namespace massprops {

/// For each of n points (n×3) its distance from the outer surface, exact; n entries, same unit.
Vector wallAtVertices(const Points& points, const TriangleTree& outer);

} // namespace massprops
