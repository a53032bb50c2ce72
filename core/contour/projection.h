// From near the border of a region onto it.
#pragma once

#include "core/contour/dual_contour.h"

namespace massprops {

/// Moves vertices to where what they lie on vanishes, by Newton's steps, none farther than
/// `farthest`; as far as triangles around them stay sound. A point of the cut that the walls do not
/// leave becomes one of the crease; one of the crease that cannot go there becomes one of a
/// chamfer.
void project(const Region& region, double farthest, Contour& contour);

} // namespace massprops
