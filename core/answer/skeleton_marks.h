// The mean curvature skeleton as a mesh to look at.
#pragma once

#include "core/mesh/annotations.h"
#include "core/reduced/skeleton.h"

namespace massprops {

constexpr Colour kSkeletonColour{140, 20, 110};
constexpr Colour kCorrespondenceColour{70, 130, 140};

/// The skeleton's curves, and fine lines from the surface's vertices to the points that they shrink
/// to: of all vertices, or of so many, evenly spread, that one can see through the lines. In the
/// coordinates of `surface`. `skeleton`: of this surface.
ColouredMesh skeletonMarks(const TriangleMesh& surface, const Skeleton& skeleton);

} // namespace massprops
