// The report on a finished search: solid before, delivered body after.
#pragma once

#include "core/cavity_search.h"
#include "core/report.h"
#include "core/workpiece.h"

namespace massprops {

/// Seconds that the stages before the search took.
struct StageTimes {
  double skeleton = 0.0;
  double basis = 0.0;
};

/// Whether the cavity serves the goal better than leaving the body solid: it violates the
/// constraints less or, where both keep them, has the lower objective.
bool isBetterThanSolid(const CavityTask& task, const CavityResult& cavity);

/// All keys of docs/report.md but `seconds_total`. `density` in g/cm³. An empty cavity stands for
/// the solid body.
Report hollowingReport(const Workpiece& piece, const CavityTask& task, const CavityResult& cavity,
                       GoalKind kind, double density, const StageTimes& times);

} // namespace massprops
