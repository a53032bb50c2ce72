// Convex hulls of what meets the ground.
#pragma once

#include "simulation/body.h"

#include <vector>

namespace simulation {

/// Corners of the convex hull.
std::vector<Vector3d> hullCorners(const Mesh& mesh);

/// The convex hull of the vertices that lie on the ground, no more than 1e-4 diagonals above the
/// lowest; counterclockwise, without corners on its sides. The mesh is in diagonals.
std::vector<Vector3d> contactPolygon(const Mesh& mesh);

/// Its centroid, or the mean of these vertices where it has next to no area, at ground level.
Vector3d middleOfContact(const Mesh& mesh);

/// The same of the mesh upside down: where it hangs from.
Vector3d topPoint(const Mesh& mesh);

} // namespace simulation
