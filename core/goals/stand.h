// Stand: the body stands on its contact area, as hard to tip over as possible.
#pragma once

#include "core/base/options.h"
#include "core/goals/goal.h"
#include "core/goals/verdict.h"
#include "core/model/contact.h"

#include <memory>

namespace massprops {

/// Maximises the tipping angle or, where `wantedAngle` > 0 (degrees), minimises the material of a
/// body that tips over at that angle at the earliest. `solidMass`: of the body without a cavity,
/// density 1. [PWLSH13, Sec. 4; docs/math.md "Stand"]
std::unique_ptr<Goal> makeStandGoal(const ContactArea& area, const Weights& weights,
                                    double wantedAngle = 0.0, double solidMass = 1.0);

/// The tipping angle, more than 0 and at least `wantedAngle`. `lengthUnit`: model units per working
/// unit, here and for the other goals.
std::unique_ptr<Verdict> makeStandVerdict(const ContactArea& area, double lengthUnit,
                                          double wantedAngle = 0.0);

} // namespace massprops
