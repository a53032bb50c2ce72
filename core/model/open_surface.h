// An open surface as a shell: the material between the surface and its offset.
#pragma once

#include "core/base/types.h"

#include <vector>

namespace massprops {

/// A surface with n vertices whose openings are closed by lids, taken apart. The cavity of its
/// shell reaches out through the openings: it is bounded by the offset surface, a strip along each
/// boundary loop, and the lids, so that material = body with lids − cavity as for closed surfaces.
/// It is described over 2n positions, n of the offset surface and then n of the surface.
struct OpenSurface {
  Faces skin; ///< the surface without its lids, in the same order
  /// Closed, outward, over 2n positions. The offset surface has corners below n only, the lids have
  /// n and above only, the strips both.
  Faces cavity;
  std::vector<int> rim; ///< vertices on the boundary loops, ascending
  int openings = 0;     ///< boundary loops
};

/// `isLid`: for each of the closed surface's faces whether it is one of a lid.
OpenSurface openSurface(Eigen::Index vertexCount, const Faces& faces,
                        const std::vector<char>& isLid);

/// The offset surface alone, with what closes it where a part is solid.
Faces withoutStrips(const Faces& cavity, Eigen::Index vertexCount);

/// The part of a cavity that is printed: offset surface, strips, and what closes the offset surface
/// where a part is solid. Without the lids.
Faces withoutLids(const Faces& cavity, Eigen::Index vertexCount);

/// The boundary of the material, closed and outward: skin, offset surface and strips. Over 2n
/// positions.
Faces shellOf(const Faces& skin, const Faces& cavity, Eigen::Index vertexCount);

/// 2n positions.
Points stacked(const Points& inner, const Points& outer);

/// Moves the points of the axis that belong to the rim to its height over the lid, so that the
/// strip lies in the lid's plane and the rim of a vase comes out level. Where the skin meets the
/// lid at a small angle they stay, for such a rim would be a knife's edge. `axis`: n×3.
Points levelAtRim(const Points& vertices, const Faces& faces, const std::vector<char>& isLid,
                  const OpenSurface& open, Points axis);

} // namespace massprops
