// Takes off parts of what may be hollow.
#pragma once

#include "core/optimum/admissible_cells.h"
#include "core/query/grid_function.h"

#include <functional>
#include <optional>

namespace massprops {

/// About the signed distance of a cube's middle, a length, and its slope, as far as it is less than
/// `half` the cube's diagonal; empty where it is on the negative side. It may remember the last
/// cube.
using SideOfPart = std::function<std::optional<Sample>(const RegionPart& part, double half)>;

/// What lies on the positive side of something; what its border passes through is divided down to
/// level `finest` ≤ 0, and cut by a plane: by the nearer one of two where another border is next to
/// it. `makeSide`: called for each run of parts anew.
RegionParts partsLeft(const RegionParts& all, const std::function<SideOfPart()>& makeSide,
                      int finest = 0);

/// What lies outside of a closed surface and at least `depth`, a length, away from it. \pre
/// outward orientation
RegionParts partsOutside(const TriangleTree& closed, double depth, const RegionParts& all);

} // namespace massprops
