// No triangle with a very small angle, no vertex beside a crease.
#pragma once

#include "core/contour/dual_contour.h"

namespace massprops {

/// Collapses the short edges of triangles with angles below `angle`, degrees, and flips the long
/// ones, and moves what is beside a crease onto it, as far as creases, directions of faces and the
/// manifold allow. How many are left.
int removeSlivers(double angle, Contour& contour);

} // namespace massprops
