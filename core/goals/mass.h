// Mass: the body weighs what is asked for.
#pragma once

#include "core/base/options.h"
#include "core/goals/goal.h"
#include "core/goals/verdict.h"

#include <memory>
#include <optional>

namespace massprops {

/// Minimises ((m − target)/m_solid)² under m = target (working units, material of density 1);
/// without a target as light as possible.
std::unique_ptr<Goal> makeMassGoal(double solidMass, const std::optional<double>& target,
                                   const Weights& weights);

/// `grams`: grams per working unit of mass.
std::unique_ptr<Verdict> makeMassVerdict(const std::optional<double>& target, double grams);

} // namespace massprops
