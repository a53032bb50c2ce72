// Roll upright: the body comes back upright from every position, like a tumbler.
#pragma once

#include "core/base/options.h"
#include "core/goals/goal.h"
#include "core/goals/verdict.h"
#include "core/model/contact.h"

#include <memory>

namespace massprops {

/// Minimises how high the centre of mass lies above the lowest metacentre of the rolling hull, a
/// convex function of it: below 0 there is one resting face. docs/math.md "Roll upright"
/// `outer`: n×3, working frame, here and below. \throw InvalidInput when all points lie in one
/// plane
std::unique_ptr<Goal> makeRollUprightGoal(const Points& outer, const Weights& weights);

/// Counts the stable resting poses of the convex hull. `area`: what it stands on, for the drawing.
std::unique_ptr<Verdict> makeRollUprightVerdict(const ContactArea& area, const Points& outer);

} // namespace massprops
