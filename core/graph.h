// Which vertices of a mesh are joined by edges, and functions limited by them.
#pragma once

#include "core/types.h"

#include <vector>

namespace massprops {

/// For every vertex its neighbours, ascending.
using Neighbours = std::vector<std::vector<int>>;

Neighbours vertexNeighbours(Eigen::Index vertexCount, const Faces& faces);

/// The greatest function below `values` that changes by at most `slope` × length along any edge.
Vector lipschitzBelow(const Points& vertices, const Neighbours& neighbours, const Vector& values,
                      double slope);

/// The least function above `values` that changes by at most `slope` × length along any edge.
Vector lipschitzAbove(const Points& vertices, const Neighbours& neighbours, const Vector& values,
                      double slope);

} // namespace massprops
