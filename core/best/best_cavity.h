// The best possible cavity as a surface.
#pragma once

#include "core/optimum/admissible_cells.h"
#include "core/reduced/cavity_search.h"

#include <optional>

namespace massprops {

/// The part of the region on the positive side of the bound's quadric: its surface, adjusted so
/// that the body of these triangles keeps the constraints. Passed inspection, as with
/// `searchCavity`; status NoRoom: the ball reaches nothing; NoGain: the solid body serves the goal
/// at least as well, or what there is cannot be resolved. The outer surface rests. \pre there is a
/// bound, the surface is closed
CavityResult bestPossibleCavity(const CavityTask& task, const FeasibleSet& set,
                                const FeasibleRegion& region);

/// Where a mass is all that the goal wants: behind a wall as thick everywhere as that takes, in
/// cubes of this edge. `cells`: of the set. Empty: the goal wants something else, or there is less
/// room than that.
std::optional<CavityResult> uniformlyWalledCavity(const CavityTask& task, const FeasibleSet& set,
                                                  const AdmissibleCells& cells, double edge);

} // namespace massprops
