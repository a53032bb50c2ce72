// The wall as the cavity's layer carries it, vertex by vertex.
#pragma once

#include "core/query/triangle_tree.h"

#include <vector>

namespace massprops {

/// For each of n points (n×3) its distance from the outer surface, exact; n entries, same unit.
/// `near`: for each a face that may be near, which makes it quicker, or −1.
Vector wallAtVertices(const Points& points, const TriangleTree& outer,
                      const std::vector<int>& near);

} // namespace massprops
