#include "core/reduced/hollow_body.h"

#include "core/base/tolerances.h"

#include <algorithm>
#include <memory>

namespace massprops {

Body inputBody(const CavityTask& task) {
  Body body;
  body.mass = task.inputMoments;
  body.volume = task.inputMoments[0];
  const double share = body.volume / task.model.solidMoments[0];
  body.momentObjective = momentObjective(task.goal, task.weights, body.mass, share);
  body.objective = body.momentObjective;
  body.violation = largestViolation(task.goal, body.mass);
  body.measure = task.goal.measure(body.mass);
  return body;
}

Body hollowBody(const CavityTask& task, const CavityResult& cavity) {
  const Moments inner = moments(cavity.inner, cavity.cavity.faces);
  const Moments outer = outerMoments(task, cavity);
  Body body;
  body.mass = shellMoments(outer, inner, 1.0, task.model.fillDensity);
  body.volume = outer[0] - inner[0];
  const std::unique_ptr<Goal> moved = task.goalFor ? task.goalFor(cavity.outer) : nullptr;
  const Goal& goal = moved ? *moved : task.goal;
  const double share = body.volume / task.model.solidMoments[0];
  body.momentObjective = momentObjective(goal, task.weights, body.mass, share);
  body.objective = body.momentObjective + offsetObjective(*task.model.surface, task.weights,
                                                          cavity.innerOffsets, cavity.outerOffsets);
  body.violation = largestViolation(goal, body.mass);
  body.measure = goal.measure(body.mass);
  return body;
}

bool servesBetter(const CavityTask& task, const Body& a, const Body& b) {
  const bool constrained = task.weights.constraints > 0.0;
  if (constrained && std::max(a.violation, b.violation) > kFeasibility) {
    return a.violation < b.violation;
  }
  const Weights& w = task.weights;
  const bool isMeasureAlone = w.volume == 0.0 && w.smoothness == 0.0 && w.outer == 0.0;
  if (isMeasureAlone && a.measure && b.measure) return *a.measure > *b.measure;
  return a.objective < b.objective;
}

bool servesBetter(const CavityTask& task, const CavityResult& a, const CavityResult& b) {
  if (a.status != CavityStatus::Found) return false;
  return b.status != CavityStatus::Found ||
         servesBetter(task, hollowBody(task, a), hollowBody(task, b));
}

double gapToBound(const OptimalBound& bound, const Body& before, const Body& after) {
  const auto gap = [](double ours, double best, double solid) {
    return solid > best ? std::max(0.0, ours - best) / (solid - best) : 0.0;
  };
  if (bound.measure && before.measure && after.measure) {
    return gap(-*after.measure, -*bound.measure, -*before.measure);
  }
  const bool comparable = std::max(after.violation, bound.violation) <= kFeasibility &&
                          before.momentObjective > bound.objective;
  return comparable ? gap(after.momentObjective, bound.objective, before.momentObjective)
                    : gap(after.violation, bound.violation, before.violation);
}

} // namespace massprops
