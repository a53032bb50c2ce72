// Faces cut along the lines where they cross.
#pragma once

#include "core/base/types.h"

#include <vector>

namespace massprops {

/// The same surface in pieces that meet in common edges and corners only: the crossing faces are
/// cut along their intersections, which are exact before they are rounded to doubles. Equal points
/// are one vertex. Where faces of one orientation lie on each other the pieces of one of them stay.
/// `crossing`: all faces that cross or touch others elsewhere than in common edges and corners.
/// Empty where that would be very many pieces.
TriangleMesh cutAlongCrossings(const TriangleMesh& mesh, const std::vector<int>& crossing);

} // namespace massprops
