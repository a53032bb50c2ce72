#include "core/answer/report_subject.h"

#include "core/base/tolerances.h"
#include "core/goals/objective.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace massprops {
namespace {

/// In water the holes are closed, and what is to weigh so much is weighed with its plugs.
bool isForPluggedAlone(GoalKind goal) {
  return goal == GoalKind::Float || goal == GoalKind::Mass;
}

/// Whether the print does what it shall with its holes open, too.
bool servesDrained(const Subject& subject) {
  const Drainage* drainage = subject.stages.drainage;
  return drainage == nullptr ||
         (drainage->unreached == 0 && (isForPluggedAlone(subject.options.goal) ||
                                       subject.verdicts.after.isReached(openBody(subject))));
}

} // namespace

MassProperties inModel(const Moments& massMoments, const Frame& frame, double density) {
  const MassProperties working = massProperties(massMoments);
  const double grams = density * std::pow(frame.length, 3) / 1000.0;
  MassProperties body;
  body.mass = working.mass * grams;
  body.centerOfMass =
      frame.rotation.transpose() * working.centerOfMass * frame.length + frame.origin;
  body.inertiaTensor = frame.rotation.transpose() * working.inertiaTensor * frame.rotation * grams *
                       frame.length * frame.length;
  return body;
}

Moments openBody(const Subject& subject) {
  const Drainage& drainage = *subject.stages.drainage;
  return subject.after.mass - drainage.plugged + drainage.open;
}

bool carriesItself(const Subject& subject) {
  const std::optional<Ceiling>& ceiling = subject.stages.ceiling;
  return !ceiling ||
         (ceiling->tips.empty() && ceiling->widestSpan * subject.posed.frame.length <= kBridge);
}

bool isSolved(const Subject& subject) {
  const Body& after = subject.after;
  return after.violation <= kFeasibility && subject.verdicts.after.isReached(after.mass) &&
         servesDrained(subject) && carriesItself(subject);
}

std::vector<Moments> bestKnown(const Subject& subject) {
  const CavityTask& task = subject.task;
  const Verdict& verdict = subject.verdicts.before;
  const std::vector<Moments> delivered{subject.after.mass};
  const OptimalBound& bound = *task.bound;
  // That of the best level need not where constraints count that are not linear.
  const LevelBound* level = bound.bestLevel();
  if (level != nullptr && measure(task.goal, level->states)) return level->states;
  std::vector<std::vector<Moments>> bodies{{bound.massMomentsInAll}, {bound.massMoments}};
  if (level != nullptr) bodies.push_back(level->states);
  const auto isNearer = [&](const std::vector<Moments>& a, const std::vector<Moments>& b) {
    return verdict.violation(a.front()) < verdict.violation(b.front());
  };
  std::vector<Moments> nearest = *std::min_element(bodies.begin(), bodies.end(), isNearer);
  return isNearer(nearest, delivered) ? nearest : delivered;
}

} // namespace massprops
