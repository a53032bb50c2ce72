// Whether triangles form what a printer can print, decided by exact predicates.
#pragma once

#include "core/types.h"

#include <vector>

namespace massprops {

/// Faces that cross or overlap another face of the same surface, ascending; touching along a
/// shared edge or vertex is no crossing. Exact.
/// \pre every edge of the surface has one or two faces
std::vector<int> selfIntersectingFaces(const Points& vertices, const Faces& faces);

/// Faces of the inner surface that cross or touch the inner or the outer surface, or have no area,
/// ascending. Exact.
/// The outer surface's crossings with itself are not told.
std::vector<int> crossingFaces(const Points& inner, const Faces& innerFaces, const Points& outer,
                               const Faces& outerFaces);

/// Whether each point lies strictly inside of the closed surface. Exact.
std::vector<bool> insideOf(const Points& points, const Points& surface, const Faces& faces);

} // namespace massprops
