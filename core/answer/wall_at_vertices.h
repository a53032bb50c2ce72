// The wall as the cavity's layer carries it, vertex by vertex.
#pragma once

#include "core/check/inspection.h"
#include "core/query/triangle_tree.h"

namespace massprops {

/// For each of n points (n×3) its distance from the outer surface, to a billionth; n entries, same
/// unit. `inspection`: of a cavity with these vertices, which makes it quicker.
Vector wallAtVertices(const Points& points, const TriangleTree& outer,
                      const Inspection& inspection);

} // namespace massprops
