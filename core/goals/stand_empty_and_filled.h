// Stand empty and filled: the body stands with its cavity empty and with it filled.
#pragma once

#include "core/base/options.h"
#include "core/goals/goal.h"
#include "core/goals/verdict.h"
#include "core/model/contact.h"

#include <memory>

namespace massprops {

/// The sum of Stand's objective over both bodies, the constraints of both. A function of the
/// moments of the *empty* body; the filled one has (1 − f) empty + f outer, with f the filling's
/// density as a multiple of the material's.
std::unique_ptr<Goal> makeStandEmptyAndFilledGoal(const ContactArea& area, const Moments& outer,
                                                  double filling, const Weights& weights);

/// Stand's, of both bodies.
std::unique_ptr<Verdict> makeStandEmptyAndFilledVerdict(const ContactArea& area,
                                                        const Moments& outer, double filling,
                                                        double lengthUnit);

} // namespace massprops
