// Functions on a mesh that change no faster than its edges are long.
#pragma once

#include "core/base/types.h"
#include "core/mesh/vertex_adjacency.h"

namespace massprops {

/// The greatest function below `values` that changes by at most the length along any edge.
Vector lipschitzBelow(const Points& vertices, const VertexAdjacency& neighbours,
                      const Vector& values);

/// The least function above `values` that changes by at most the length along any edge.
Vector lipschitzAbove(const Points& vertices, const VertexAdjacency& neighbours,
                      const Vector& values);

} // namespace massprops
