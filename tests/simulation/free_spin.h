// A body that spins freely, as a yo-yo at the end of its string.
#pragma once

#include "simulation/world.h"

namespace simulation {

/// Greatest angle between the body's +z and where it was at first, degrees, in 200 turns about it
/// after a push across of 1 %.
double freeWobble(const Body& body);

/// What that angle is at most where +z is the principal axis of the largest or the smallest moment,
/// to first order in the push; infinite where it is that of the middle one.
double expectedFreeWobble(const Body& body);

} // namespace simulation
