// The report on a finished search: solid before, delivered body after.
#pragma once

#include "core/answer/print_margins.h"
#include "core/base/report.h"
#include "core/drill/drainage.h"
#include "core/goals/verdict.h"
#include "core/model/posed_model.h"
#include "core/model/repair.h"
#include "core/optimum/certificate.h"
#include "core/overhang/ceiling.h"
#include "core/reduced/cavity_search.h"

#include <optional>
#include <string>
#include <vector>

namespace massprops {

/// What happened before and beside the search.
struct Stages {
  Repairs repairs;          ///< of the input
  int skeletonFailures = 0; ///< components on which the mean curvature flow failed
  std::string shapeReason;  ///< why the cavity has the shape that it has
  /// Least working distances of the cavity from the outer surface and from what stays solid; empty
  /// where nothing must, and the inspection knows the first.
  std::optional<double> leastWall, solidDepth;
  double largestWall = 0.0;           ///< working length; of use when there is no room for a cavity
  const Drainage* drainage = nullptr; ///< null: no holes are asked for, or there is no cavity
  /// Of the cavity, working lengths; empty where ceilings need not carry themselves.
  std::optional<Ceiling> ceiling;
  double rounding = 0.0; ///< length: the step between coordinates that the caller can store
  std::optional<PrintMargins> margins; ///< where the goal is reached
  /// Of all the goal's conditions, where it is missed and that no cavity can reach it was proved.
  std::vector<Certificate> certificates;
  double secondsCheck = 0.0; ///< of the input, and making it ready
  double secondsCopy = 0.0;
  double secondsSkeleton = 0.0;
  double secondsBasis = 0.0;
  double secondsLimit = 0.0;
  double secondsLargestWall = 0.0; ///< looking for it
  double secondsCertificate = 0.0; ///< proving, or trying to
  double secondsMargins = 0.0;     ///< how far the print may be off
};

/// A verdict may depend on the outer surface: of the model, and as it has become.
struct Verdicts {
  const Verdict& before;
  const Verdict& after;
};

/// All keys of docs/report.md but `seconds_total`. An empty cavity stands for the solid body.
Report hollowingReport(const PosedModel& posed, const CavityTask& task, const Verdicts& verdicts,
                       const CavityResult& cavity, const Options& options, const Stages& stages);

} // namespace massprops
