// Whether a surface crosses itself, decided by exact predicates.
#pragma once

#include "core/base/types.h"
#include "core/query/triangle_tree.h"

#include <vector>

namespace massprops {

/// Faces that cross or overlap another face of the same surface, ascending; touching along a
/// shared edge or vertex is no crossing. Exact. Where the surface is smooth it proves by projection
/// that whole patches cannot cross themselves and compares no pairs: docs/math.md "Crossings".
/// Takes 0.44 µs a triangle on one core, 2.5 times less than CGAL's `self_intersections` with the
/// mesh that it takes, and shares the work between cores, which that does not (204,336 triangles;
/// benchmarks/crossings). `order`: of the faces. \pre every edge of the surface has one or two
/// faces
std::vector<int> selfIntersectingFaces(const Points& vertices, const Faces& faces,
                                       TriangleTree::Order order = TriangleTree::Order::Any);
/// The same where there is a tree already.
std::vector<int> selfIntersectingFaces(const TriangleTree& surface);

/// The same surface elsewhere, turned and scaled.
struct SimilarSurface {
  const std::vector<int>& faceOf; ///< for each of its faces the one here
  double apart; ///< not less than, there, the distance of two points that are one here
};
/// The same with the tree of a similar surface.
std::vector<int> selfIntersectingFaces(const Points& vertices, const Faces& faces,
                                       const TriangleTree& tree, const SimilarSurface& similar);

} // namespace massprops
