// An offset surface's cavity without its pleats.
#pragma once

#include "core/contour/opened_set.h"
#include "core/optimum/admissible_cells.h"
#include "core/reduced/cavity_search.h"

namespace massprops {

/// Where cavities may be. Working frame.
struct CavityRoom {
  const OpenedSet& set;
  const RegionParts& behindWalls; ///< before it was opened
  const Fillings& states;         ///< that the task's bound was found for
};

/// The best possible cavity within an offset surface's, of which near its pleated ends only that
/// counts which a ball reaches: so these become round. (docs/math.md "Ends of the offset surface")
/// The widest ball that costs the goal little; as it was found where all cost it much, or leave
/// nothing. `found`: an offset surface, found or of no gain; what is returned has its outer
/// surface. \pre there is a bound; the surface is closed and rests
CavityResult withRoundedEnds(const CavityTask& task, const CavityRoom& room,
                             const CavityResult& found);

} // namespace massprops
