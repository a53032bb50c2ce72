// What a print stands on while it is printed.
#pragma once

#include "core/base/types.h"

namespace massprops {

/// Of a plane region, lengths in millimetres.
struct FirstLayer {
  double area = 0.0;
  /// Least section modulus over all directions, mm³: the moment that tears the layer off the bed
  /// is this times the strength of the bond.
  double sectionModulus = 0.0;
};

/// Where the plane z = height cuts a body. `vertices`, `faces`: closed, outward, inner surfaces
/// with the opposite orientation.
FirstLayer firstLayer(const Points& vertices, const Faces& faces, double height);

/// Whether PLA on a bed holds a body of this height against a nozzle that catches its top, by the
/// figures of PrusaSlicer's own check [Pru23].
bool holds(const FirstLayer& layer, double height);

} // namespace massprops
