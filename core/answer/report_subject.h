// What a report is about.
#pragma once

#include "core/answer/hollowing_report.h"
#include "core/base/options.h"
#include "core/reduced/hollow_body.h"

#include <vector>

namespace massprops {

struct Subject {
  const PosedModel& posed;
  const CavityTask& task;
  const Verdicts& verdicts;
  const CavityResult& cavity;
  const Options& options;
  const Stages& stages;
  Body before, after;

  bool isHollow() const { return cavity.status == CavityStatus::Found; }
  bool hasCavity() const { return isHollow() && cavity.inspection.components > 0; }
};

/// A body in the model's own coordinates and in grams.
MassProperties inModel(const Moments& massMoments, const Frame& frame, double density);

/// With the holes open; the mass moments that the verdict sees are those with the plugs in.
/// \pre holes were asked for
Moments openBody(const Subject& subject);

/// Whether the ceiling prints without support.
bool carriesItself(const Subject& subject);

/// Whether the print does what it shall, with its holes open, too.
bool isSolved(const Subject& subject);

/// In its states the body that comes nearest to a goal out of reach, of all that are known.
/// \pre there is a bound
std::vector<Moments> bestKnown(const Subject& subject);

} // namespace massprops
