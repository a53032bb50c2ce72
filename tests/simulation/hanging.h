// How a body hangs from a point.
#pragma once

#include "simulation/world.h"

namespace simulation {

/// Degrees off upright at which it comes to rest when it is let go 10 degrees off. Damped, to
/// settle.
double hangingAngle(const Body& body, const Vector3d& suspension);

} // namespace simulation
