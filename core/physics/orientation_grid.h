// Orientations of a body, evenly spread.
#pragma once

#include "core/base/types.h"

#include <array>
#include <cstddef>
#include <vector>

namespace massprops {

/// Unit vectors of the body that may look up, and which of them are neighbours: corners and edges
/// of an icosahedron whose faces are cut in four, four times.
struct OrientationGrid {
  double spacing = 0.0;  ///< between neighbours, at most
  std::vector<Vec3> ups; ///< 2562
  std::vector<std::array<std::size_t, 2>> edges;
};

const OrientationGrid& orientationGrid();

} // namespace massprops
