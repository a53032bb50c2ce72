// How a search closes in on what it found wrong.
#pragma once

#include "core/mesh/vertex_adjacency.h"
#include "core/reduced/cavity_search.h"

#include <optional>
#include <vector>

namespace massprops {

/// What later rounds of a search keep to.
struct SearchLimits {
  OffsetBounds inner; ///< past each other where there is no room
  std::optional<OffsetBounds> outer;
  std::vector<char> solid;     ///< marks of the cavity's positions, where it has no surface
  std::vector<int> thinRounds; ///< how often each vertex had too thin a wall
};

/// Moves the limits so that what the inspection of `result` found cannot happen again in the same
/// way: vertices that cross something become solid, those with too thin a wall get the missing
/// length, twice as much each time, and a moved outer surface goes half as far. Without patience
/// all that failed becomes solid with what is next to it, and the outer surface stays where it was.
void closeIn(const CavityTask& task, const CavityResult& result, const VertexAdjacency& neighbours,
             bool isPatient, SearchLimits& limits);

/// Marks vertices where the cavity is narrower than a wall, which cannot be printed and folds
/// first, and those of threads that the optimisation would rather close, their offsets being near
/// the greatest. Whether they are enough for another round. `faces`: of the cavity, without an open
/// surface's strips and lids.
bool fillNarrowParts(const CavityTask& task, const OffsetSurfaces& surfaces,
                     const OffsetBounds& bounds, const Faces& faces, std::vector<char>& solid);

} // namespace massprops
