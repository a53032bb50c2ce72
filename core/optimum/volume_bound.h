// How well a cavity could serve a goal that takes no more than a given volume.
#pragma once

#include "core/goals/goal.h"
#include "core/optimum/admissible_cells.h"
#include "core/optimum/optimal_bound.h"
#include "core/physics/filling.h"

#include <optional>

namespace massprops {

/// The goal's measure that no body exceeds whose cavity within the cells has at most this volume.
/// By the bathtub principle no such cavity lowers a functional of the moments by more than the one
/// that takes the points where hollowing is worth most until the volume is reached. [LL01, Thm.
/// 1.14; docs/math.md "Offset surfaces that are not looked for"]
/// Empty: the goal has no measure, or one that says nothing about conditions that are linear, or
/// the body is to serve in more than one state. `bound`: of the same goal, whose multipliers are
/// taken; `solid`, `filling`: as in `optimalBound`.
std::optional<double> greatestMeasure(const Goal& goal, const OptimalBound& bound,
                                      const Moments& solid, const Fillings& fillings,
                                      const AdmissibleCells& cells, double volume);

} // namespace massprops
