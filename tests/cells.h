// What may be hollow behind the walls of a surface, for tests of what is made of it.
#pragma once

#include "core/optimum/admissible_cells.h"

#include <cmath>

namespace massprops::testing {

/// In the surface's bounding box, about as many as the library takes.
constexpr double kCellsInBox = 20000.0;

/// Behind the walls, in cubes half as wide as these cells; no ball is asked for.
inline FeasibleRegion regionBehind(const TriangleTree& surface, double wall,
                                   double cells = kCellsInBox) {
  const double volume = (surface.upper() - surface.lower()).prod();
  return feasibleRegion({surface, wall, 0.0}, 0.5 * std::cbrt(volume / cells));
}

inline AdmissibleCells cellsBehind(const TriangleTree& surface, double wall,
                                   double cells = kCellsInBox) {
  return admissibleCells(regionBehind(surface, wall, cells), Admissible::BehindWalls, cells);
}

} // namespace massprops::testing
