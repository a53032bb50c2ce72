// Which searches are worth their time, one after the other.
#pragma once

#include "core/reduced/cavity_search.h"

#include <functional>
#include <optional>

namespace massprops {

/// The same task with other offset directions.
using Redirected = std::function<CavityTask()>;

/// The best cavity of up to three searches: the second without a start near the bound's cavity,
/// where the first serves the goal no better than the solid; the third along `steeper` directions,
/// where much of what is possible is left. Where the body is to serve the goal with different
/// contents, and serves it worse with these up to a level between, that level becomes one of the
/// task's fillings and the searches are repeated, as long as that helps. Their effort is added up.
/// Status NoGain: there is a cavity, but the solid body serves the goal at least as well.
/// `progress` as for `searchCavity`.
CavityResult bestCavity(CavityTask& task, const Redirected& steeper,
                        const std::function<void(double)>& progress);

/// Whether the solid body serves the goal at least as well; never of an open surface, of which a
/// shell is asked for whatever a solid body could do.
bool isUseless(const CavityTask& task, const CavityResult& cavity);

/// The contents among levels all over the cavity's height with which the body serves the goal
/// least; empty where none of them is noticeably worse than the task's own fillings.
std::optional<Filling> weakestFilling(const CavityTask& task, const CavityResult& cavity);

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
