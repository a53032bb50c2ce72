// What a search is asked for, and which wall would leave room where the wanted one does not.
#pragma once

#include "core/reduced/cavity_search.h"

#include <functional>

namespace massprops {

/// The cavity that a search finds. Where the body is to serve the goal with contents at any level,
/// those that the bound's proof rests on become the task's fillings. Status NoGain: there is a
/// cavity, but the solid body serves the goal at least as well. `progress` as for `searchCavity`.
CavityResult bestCavity(CavityTask& task, const std::function<void(double)>& progress);

/// Whether the solid body serves the goal at least as well; never of an open surface, of which a
/// shell is asked for whatever a solid body could do.
bool isUseless(const CavityTask& task, const CavityResult& cavity);

/// The greatest wall below one that is too thick at which there is room, and at slightly less, too,
/// within an eighth of it; 0 when none was found down to a thousandth. `progress` as below.
double greatestWall(double tooThick, const std::function<bool(double)>& hasRoom,
                    const std::function<void(double)>& progress);

/// The greatest wall below the wanted one that `leavesRoom` for a cavity, within an eighth of it,
/// working length; 0 when none was found down to a thousandth. `boundsFor`: the offsets' bounds
/// that keep a wall. `progress`: called with the share of the work that is done, 0…1; may be empty.
double largestWall(CavityTask task, const std::function<OffsetBounds(double)>& boundsFor,
                   const std::function<void(double)>& progress);

} // namespace massprops
