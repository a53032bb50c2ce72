// An order of triangles in which parts of the list are parts in space.
#pragma once

#include "core/base/types.h"

#include <vector>

namespace massprops {

/// The triangles' numbers in an order in which parts of the list are parts in space, down to the
/// leaves of a tree: cut in two, and these again, along the longest side of the box around their
/// centres.
std::vector<int> spatialOrder(const Points& vertices, const Faces& faces);

/// Whether memory and time of a surface of so many triangles count before all else.
bool isLarge(Eigen::Index triangles);

/// Leaves of a tree over so many triangles, with at most four for each: a power of two. Of large
/// trees, whose memory counts, roots · 4^k, so that they are nearly full: for that searches begin
/// at up to fifteen roots.
Eigen::Index leafCount(Eigen::Index triangles);

/// Leaves below each of as few roots as can be.
Eigen::Index leavesOfRoot(Eigen::Index leaves);

} // namespace massprops
