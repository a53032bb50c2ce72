// What the simulation itself is worth: bodies whose behaviour is known in closed form.
#pragma once

#include "simulation/comparison.h"

namespace simulation {

void checkMethod(Comparison& comparison);

} // namespace simulation
