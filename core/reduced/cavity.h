// The triangles that bound the cavity: the surface's own, without the parts too thin to hollow.
#pragma once

#include "core/base/types.h"
#include "core/mesh/connectivity.h"

#include <vector>

namespace massprops {

struct CavitySurface {
  /// Closed and manifold, outward, over the vertices of the input surface; a face either is one of
  /// the input or belongs to a cap that closes the cavity where a thin part begins. May fall into
  /// several components, and be empty.
  Faces faces;
  Eigen::Index firstCapFace = 0; ///< from here on they are those of caps, if any
  /// For every vertex whether it is solid: no cavity around it, no face uses it.
  std::vector<char> solid;
};

/// Leaves out all faces at vertices marked solid and closes the holes by triangles between their
/// border vertices, least in area at the given positions. Marks more vertices where that is needed
/// to keep the surface manifold or where only slivers would be left.
/// `vertices`: n×3 positions of the inner surface; `solid`: n marks.
/// `corners`: those of `faces`.
CavitySurface cavitySurface(const Points& vertices, const Faces& faces,
                            const VertexCorners& corners, std::vector<char> solid);

} // namespace massprops
