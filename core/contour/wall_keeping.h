// A cavity's surface as far from the outer one as is asked for, edges and insides of faces
// included.
#pragma once

#include "core/base/types.h"
#include "core/query/surface_distance.h"

#include <vector>

namespace massprops {

/// Once, by what the corners of triangles are next to: that is quick and as a rule nearly enough.
void keepWallNearly(ClearanceQuery& clearance, double wall, const Faces& faces, Points& vertices);

/// Moves vertices away from the outer surface until no triangle is nearer to it than `wall`, a
/// length in their unit, as far as triangles stay sound. The vertices of triangles that are still
/// nearer, ascending. `clearance`: from the outer surface; may know the cavity from before.
/// `rests`: whether a vertex stays where it is, or empty; triangles between such are not looked at.
/// \pre closed outward surfaces, the cavity inside of the other
std::vector<int> keepWall(ClearanceQuery& clearance, double wall, const Faces& faces,
                          Points& vertices, const std::vector<char>& rests = {});

} // namespace massprops
