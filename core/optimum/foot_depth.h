// How deep a foot must be cut for a cavity to reach the goal on it.
#pragma once

#include "core/model/foot.h"
#include "core/model/posed_model.h"
#include "core/optimum/admissible_cells.h"
#include "core/optimum/optimal_bound.h"
#include "core/physics/filling.h"

#include <optional>

namespace massprops {

/// By how much the best of all bodies reaches the goal: the tangent of an angle, or a violation
/// with its sign turned.
double reserveOf(const OptimalBound& bound);

/// Whether that leaves half a degree to spare, for what is delivered falls short of the limit.
bool isAmple(double reserve);

/// Deeper than the foot that the model has: the least depth for which the best of all cavities
/// reaches the goal amply, or else the depth for which it comes nearest. Only the contact area
/// changes with the depth here, the body stays as it is. Empty where that foot is as good.
/// `lowest`: of the model before the cut; `cells`: none where nothing can be hollowed; `states`: as
/// for `optimalBound`. \pre a goal of standing, and a foot
std::optional<double> betterFootDepth(const LowestPart& lowest, const PosedModel& posed,
                                      const AdmissibleCells& cells, const Fillings& states,
                                      const Options& options);

} // namespace massprops
