// Whether triangles form what a printer can print, decided by exact predicates.
#pragma once

#include "core/triangle_tree.h"
#include "core/types.h"

#include <vector>

namespace massprops {

/// Faces that cross or overlap another face of the same surface, ascending; touching along a
/// shared edge or vertex is no crossing. Exact. Where the surface is smooth it proves by projection
/// that whole patches cannot cross themselves and compares no pairs: docs/math.md "Crossings".
/// `order`: of the faces. \pre every edge of the surface has one or two faces
std::vector<int> selfIntersectingFaces(const Points& vertices, const Faces& faces,
                                       TriangleTree::Order order = TriangleTree::Order::Any);
/// The same where there is a tree already.
std::vector<int> selfIntersectingFaces(const TriangleTree& surface);

/// Faces without area, ascending. Exact.
std::vector<int> facesWithoutArea(const Points& vertices, const Faces& faces);

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
