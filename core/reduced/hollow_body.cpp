#include "core/reduced/hollow_body.h"

#include "core/base/tolerances.h"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

namespace massprops {

namespace {

/// Without offsets.
Body bodyOf(const CavityTask& task, const Goal& goal, const std::vector<Moments>& states,
            double volume) {
  Body body;
  body.mass = states.front();
  body.volume = volume;
  const double share = volume / task.model.solidMoments[0];
  body.momentObjective = momentObjective(goal, task.weights, states, share);
  body.objective = body.momentObjective;
  body.violation = largestViolation(goal, states);
  body.measure = measure(goal, states);
  return body;
}

Body hollowed(const CavityTask& task, const Goal& goal, const Moments& outer, const Points& inner,
              const Faces& faces) {
  return bodyOf(task, goal, filledMoments(outer, inner, faces, task.model.fillings),
                outer[0] - moments(inner, faces)[0]);
}

} // namespace

Body inputBody(const CavityTask& task) {
  // The cavities that it has are empty or full.
  const Moments cavities = task.model.solidMoments - task.inputMoments;
  std::vector<Moments> states{task.inputMoments};
  for (std::size_t s = 1; s < task.model.fillings.size(); ++s) {
    states.emplace_back(task.inputMoments + task.model.fillings[s].density * cavities);
  }
  return bodyOf(task, task.goal, states, task.inputMoments[0]);
}

Body hollowBody(const CavityTask& task, const CavityResult& cavity) {
  const std::unique_ptr<Goal> moved = task.goalFor ? task.goalFor(cavity.outer) : nullptr;
  Body body = hollowed(task, moved ? *moved : task.goal, outerMoments(task, cavity), cavity.inner,
                       cavity.cavity.faces);
  body.objective +=
      offsetObjective(*task.model.surface, task.weights, cavity.innerOffsets, cavity.outerOffsets);
  return body;
}

Body hollowBody(const CavityTask& task, const Points& inner, const Faces& faces) {
  return hollowed(task, task.goal, task.model.solidMoments + task.model.attached, inner, faces);
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

bool isUseless(const CavityTask& task, const CavityResult& cavity) {
  return task.open == nullptr && cavity.status == CavityStatus::Found &&
         !servesBetter(task, hollowBody(task, cavity), inputBody(task));
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

void raiseTo(const CavityTask& task, const Body& delivered, OptimalBound& bound) {
  Body ours = delivered;
  ours.objective = ours.momentObjective;
  Body best = ours;
  best.objective = bound.objective;
  best.violation = bound.violation;
  best.measure = bound.measure;
  if (!servesBetter(task, ours, best)) return;
  bound.massMoments = ours.mass;
  bound.objective = ours.objective;
  bound.violation = ours.violation;
  bound.measure = ours.measure;
}

} // namespace massprops
