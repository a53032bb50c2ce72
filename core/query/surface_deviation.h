// How far one surface is from another at most.
#pragma once

#include "core/base/types.h"
#include "core/query/triangle_tree.h"

namespace massprops {

/// The greatest distance of the faces' corners and middles from the other surface; 0 without faces.
double greatestDistance(const Points& vertices, const Faces& faces, const TriangleTree& other);

} // namespace massprops
