// What hollowing could do for standing, counted in cubes without any code of core/.
#pragma once

#include "core/base/types.h"

namespace massprops::wild {

/// By how many degrees the tipping angle about the hull of the lowest vertices grows when that of
/// the cubes deeper than `wall` which is best on one side of a plane is taken away; of 2,000
/// directions and all distances of the plane. The best of all cavities is of this kind.
/// `model`: closed, +z is up.
double standingGain(const TriangleMesh& model, double wall);

} // namespace massprops::wild
