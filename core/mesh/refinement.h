// A surface with other triangles, none of them long.
#pragma once

#include "core/base/types.h"

namespace massprops {

/// The same shape without edges that are longer than `edge`, a length in the vertices' unit: edges
/// are split in the middle, and where the surface is flat its triangles become Delaunay's
/// [dBCvKO08, Ch. 9], so that the needles of CAD models go. Vertices of the surface keep their
/// numbers; new ones lie on it. \pre closed manifold components
TriangleMesh refined(const Points& vertices, const Faces& faces, double edge);

/// Length of the longest edge.
double longestEdge(const Points& vertices, const Faces& faces);

} // namespace massprops
