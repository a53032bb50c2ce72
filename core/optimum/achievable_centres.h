// Where hollowing can bring the centre of mass.
#pragma once

#include "core/optimum/admissible_cells.h"
#include "core/physics/half_spaces.h"
#include "core/physics/moments.h"

namespace massprops {

/// Half-spaces that hold the centre of mass of every body that is hollow within the cells, however
/// its cavity is shaped. `solid`, `fillDensity`: as for `optimalBound`. docs/math.md "The limit"
HalfSpaces achievableCentres(const Moments& solid, double fillDensity,
                             const AdmissibleCells& cells);

} // namespace massprops
