// Roll upright: the body comes back upright from every position, like a tumbler.
#pragma once

#include "core/base/options.h"
#include "core/goals/goal.h"
#include "core/goals/verdict.h"
#include "core/model/contact.h"

#include <memory>

namespace massprops {

/// Stand's objective and constraints. An area that is a point counts as a small disc.
std::unique_ptr<Goal> makeRollUprightGoal(const ContactArea& area, const Weights& weights);

/// Counts the stable resting poses of the convex hull of `outer` (n×3, working frame).
std::unique_ptr<Verdict> makeRollUprightVerdict(const ContactArea& area, const Points& outer,
                                                double lengthUnit);

} // namespace massprops
