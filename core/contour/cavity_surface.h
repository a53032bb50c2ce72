// From a contour in its cubes to a surface that keeps the wall.
#pragma once

#include "core/contour/dual_contour.h"
#include "core/query/surface_distance.h"

#include <vector>

namespace massprops {

/// Without the faces of components that are smaller than a ball of this diameter: where the quadric
/// cuts off a corner of a room.
void removeSmallComponents(double ball, Contour& contour);

/// Moves a vertex on what the wall leaves to where the depth is `wall`, others only inwards and
/// only where it is less, by one Newton step no longer than half an edge: chords over what bulges
/// into the cavity come nearer than their ends. `moves`: for every vertex whether it may.
void moveOntoWalls(const TriangleTree& surface, double wall, double edge,
                   const std::vector<char>& moves, Contour& contour);

/// Moves vertices inwards until no triangle is nearer to the outer surface than `wall`, as far as
/// triangles stay sound. The vertices of triangles that still are, ascending. `clearance`: from the
/// outer surface; may know the cavity from before. \pre closed outward surfaces, the cavity inside
std::vector<int> keepWall(ClearanceQuery& clearance, double wall, const Faces& faces,
                          Points& vertices);

} // namespace massprops
