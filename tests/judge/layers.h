// A printer's layers in small cubes: slow and simple, without any code of core/.
#pragma once

#include "core/base/types.h"

namespace massprops::testing {

/// What a cavity's ceilings ask of a printer.
struct Overhang {
  /// Largest horizontal distance of a cube above the cavity from material in the layer below it.
  double reach = 0.0;
  /// Pieces of a layer above the cavity with no material below or beside what is below.
  int islands = 0;
};

/// z is up in the printer. `cavity`: closed, outward; what is not in it is material. `side`: of the
/// cubes. A reach of more than ten of them counts as ten.
Overhang overhangOf(const TriangleMesh& cavity, double side);

} // namespace massprops::testing
