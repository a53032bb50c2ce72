// Whether a point or a surface lies inside of a closed surface.
#pragma once

#include "core/base/types.h"
#include "core/query/triangle_tree.h"

namespace massprops {

/// Whether p lies strictly inside of the closed surface. Exact: by the parity of crossings along a
/// few dozen ways out; a point from which none of them stays off the surface's edges counts as
/// outside.
bool isInside(const Vec3& p, const TriangleTree& surface);

/// The same, quicker, for a point whose nearest one of the closed, outward oriented surface is
/// known.
bool isInside(const Vec3& p, const TriangleTree::Hit& nearest, const TriangleTree& surface);

/// Whether a component that does not cross the closed, outward oriented surface lies inside of it;
/// decided by one of its vertices. Exact, too.
bool isInside(const Points& vertices, const Faces& component, const TriangleTree& surface);

} // namespace massprops
