// Stand empty and filled: the body stands with its cavity empty and with it filled.
#pragma once

#include "core/base/options.h"
#include "core/goals/goal.h"
#include "core/goals/verdict.h"
#include "core/model/contact.h"

#include <memory>

namespace massprops {

/// Maximises the smaller tipping angle of both bodies. A function of the moments of the *empty*
/// body; the filled one has (1 − f) empty + f outer, with f the filling's density as a multiple of
/// the material's.
std::unique_ptr<Goal> makeStandEmptyAndFilledGoal(const ContactArea& area, const Moments& outer,
                                                  double filling, const Weights& weights);

/// Stand's, of both bodies and, where the `cavity` (closed, outward, working frame) is given, at
/// every level of its contents.
std::unique_ptr<Verdict> makeStandEmptyAndFilledVerdict(const ContactArea& area,
                                                        const Moments& outer, double filling,
                                                        double lengthUnit,
                                                        const TriangleMesh* cavity = nullptr);

} // namespace massprops
