// A surface with other triangles: none of them long, or all of about one size.
#pragma once

#include "core/base/types.h"

namespace massprops {

/// The same shape without edges that are longer than `edge`, a length in the vertices' unit: edges
/// are split in the middle, and where the surface is flat its triangles become Delaunay's
/// [dBCvKO08, Ch. 9], so that the needles of CAD models go. Vertices of the surface keep their
/// numbers; new ones lie on it. \pre closed manifold components
TriangleMesh refined(const Points& vertices, const Faces& faces, double edge);

/// A part of a surface with triangles of one size, that of its border's edges, near where it was
/// [BK04]. `patch`: the faces around the part, every vertex used, and from row `first` on its own.
/// The vertices of the patch come first and unchanged, those inside of the part without a use; the
/// faces are those of the part; none where the patch is no manifold or they would be more than
/// 20,000.
TriangleMesh remeshedPart(const TriangleMesh& patch, Eigen::Index first);

/// Length of the longest edge.
double longestEdge(const Points& vertices, const Faces& faces);

} // namespace massprops
