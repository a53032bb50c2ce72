#include "core/answer/hollowing_report.h"

#include "core/base/tolerances.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace massprops {
namespace {

/// The body that a search ends with, measured on its triangles.
struct Body {
  Moments mass; ///< working frame, material of density 1
  double volume = 0.0;
  double objective = 0.0;
  double violation = 0.0;
};

/// The model as it came in, existing cavities and all.
Body inputBody(const CavityTask& task) {
  const double share = task.inputMoments[0] / task.solidMoments[0];
  return {
      task.inputMoments, task.inputMoments[0],
      objectiveValue(task.goal, task.weights, task.inputMoments, share, task.L, {}, task.mass, {}),
      largestViolation(task.goal, task.inputMoments)};
}

Body hollowBody(const CavityTask& task, const CavityResult& cavity) {
  const Moments inner = moments(cavity.inner, cavity.cavity.faces);
  const Moments outer = outerMoments(task, cavity);
  Body body;
  body.mass = shellMoments(outer, inner, 1.0, task.fillDensity);
  body.volume = outer[0] - inner[0];
  const std::unique_ptr<Goal> moved = task.goalFor ? task.goalFor(cavity.outer) : nullptr;
  const Goal& goal = moved ? *moved : task.goal;
  body.objective = objectiveValue(goal, task.weights, body.mass, body.volume / task.solidMoments[0],
                                  task.L, cavity.innerOffsets, task.mass, cavity.outerOffsets);
  body.violation = largestViolation(goal, body.mass);
  return body;
}

bool servesBetter(const CavityTask& task, const Body& a, const Body& b) {
  const bool constrained = task.weights.constraints > 0.0;
  if (constrained && std::max(a.violation, b.violation) > kFeasibility) {
    return a.violation < b.violation;
  }
  return a.objective < b.objective;
}

/// A body in the model's own coordinates and in grams.
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

/// Share of what a cavity could gain that is not gained: in the objective where it can be compared,
/// else in the violation of the constraints.
double gapToLimit(const OptimalBound& limit, const Body& before, const Body& after) {
  const auto gap = [](double ours, double best, double solid) {
    return solid > best ? std::max(0.0, ours - best) / (solid - best) : 0.0;
  };
  const bool comparable = std::max(after.violation, limit.violation) <= kFeasibility &&
                          before.objective > limit.objective;
  return comparable ? gap(after.objective, limit.objective, before.objective)
                    : gap(after.violation, limit.violation, before.violation);
}

/// What a cavity of any shape could do about a goal that is missed.
std::string outlook(const CavityTask& task) {
  if (!task.limit) return "";
  if (task.limit->violation <= OptimalBound::kReachable) {
    return " A cavity of another shape could reach it.";
  }
  return " No cavity of any shape that keeps this wall can reach it: " +
         task.goal.bestInWords(task.limit->bestVerdict.value_or(task.limit->massMoments)) + ".";
}

std::string message(const CavityTask& task, const Goal& goalAfter, const CavityResult& cavity,
                    const Body& before, const Body& after, double largestWall) {
  std::string sentence =
      goalAfter.isReached(after.mass) ? "The goal is reached" : "The goal is missed";
  if (cavity.status == CavityStatus::NoRoom) {
    return sentence +
           (task.open != nullptr
                ? " by the solid model; there is no room for an open shell with this wall: "
                : " by the solid model; nothing can be hollowed at this wall: ") +
           (largestWall > 0.0
                ? "lower inner_lower_bound to " + toString(largestWall) + " or less."
                : "lower inner_lower_bound, and refine the model with Remeshing > Isotropic "
                  "Explicit Remeshing, for no thinner wall was found to leave room either.");
  }
  if (cavity.status == CavityStatus::NoGain) {
    return sentence +
           " by the solid model, and no cavity with this wall was found to serve it "
           "better." +
           (before.violation > kFeasibility ? outlook(task) : "");
  }
  if (task.goal.isReached(before.mass)) sentence += " (by the solid model too)";
  if (cavity.inspection.components == 0) {
    sentence += " by moving the outer surface alone, for no cavity has room behind this wall";
  }
  return after.violation <= kFeasibility
             ? sentence + "; all constraints hold."
             : sentence + ": with the best cavity found " + goalAfter.worstViolation(after.mass) +
                   "." + outlook(task);
}

/// Vertices of what moves inwards, lids apart, that have no cavity behind them.
int solidVertices(const CavityTask& task, const CavityResult& cavity) {
  const Faces& skin = task.open != nullptr ? task.open->skin : task.faces;
  std::vector<char> mark(static_cast<std::size_t>(task.vertices.rows()), 0);
  for (Eigen::Index f = 0; f < skin.rows(); ++f) {
    for (const int v : skin.row(f)) {
      const auto i = static_cast<std::size_t>(v);
      mark[i] = cavity.status == CavityStatus::Found ? cavity.cavity.solid[i] : 1;
    }
  }
  return static_cast<int>(std::count(mark.begin(), mark.end(), 1));
}

} // namespace

bool isBetterThanSolid(const CavityTask& task, const CavityResult& cavity) {
  return servesBetter(task, hollowBody(task, cavity), inputBody(task));
}

bool isBetter(const CavityTask& task, const CavityResult& cavity, const CavityResult& other) {
  if (cavity.status != CavityStatus::Found) return false;
  return other.status != CavityStatus::Found ||
         servesBetter(task, hollowBody(task, cavity), hollowBody(task, other));
}

double gapToLimit(const CavityTask& task, const CavityResult& cavity) {
  if (!task.limit || cavity.status != CavityStatus::Found) return 0.0;
  return gapToLimit(*task.limit, inputBody(task), hollowBody(task, cavity));
}

Report hollowingReport(const PosedModel& posed, const CavityTask& task, const Goal& goalAfter,
                       const CavityResult& cavity, const Options& options, const Stages& stages) {
  const Body before = inputBody(task);
  const bool hollow = cavity.status == CavityStatus::Found;
  const bool hasCavity = hollow && cavity.inspection.components > 0;
  const Body after = hollow ? hollowBody(task, cavity) : before;
  const MassProperties modelBefore = inModel(before.mass, posed.frame, options.density);
  const MassProperties modelAfter = inModel(after.mass, posed.frame, options.density);
  const double unitVolume = std::pow(posed.frame.length, 3);

  Report report;
  report.add("goal", goalNames()[static_cast<std::size_t>(options.goal)]);
  report.add("solved", after.violation <= kFeasibility && goalAfter.isReached(after.mass));
  report.add("message", message(task, goalAfter, cavity, before, after,
                                stages.largestWall * posed.frame.length));
  report.add("objective_before", before.objective);
  report.add("objective_after", after.objective);
  report.add("max_constraint_violation", after.violation);
  report.add("volume_before", before.volume * unitVolume);
  report.add("volume_after", after.volume * unitVolume);
  report.add("mass_before", modelBefore.mass);
  report.add("mass_after", modelAfter.mass);
  report.add("center_of_mass_before", modelBefore.centerOfMass);
  report.add("center_of_mass_after", modelAfter.centerOfMass);
  report.add("inertia_tensor_before", modelBefore.inertiaTensor);
  report.add("inertia_tensor_after", modelAfter.inertiaTensor);
  task.goal.describe(before.mass, "before", report);
  goalAfter.describe(after.mass, "after", report);
  if (task.limit) {
    report.add("objective_limit", task.limit->objective);
    report.add("gap_to_limit", gapToLimit(*task.limit, before, after));
    task.goal.describe(task.limit->massMoments, "limit", report);
    if (task.limit->bestVerdict) task.goal.describe(*task.limit->bestVerdict, "best", report);
  }
  report.add("min_wall", hasCavity ? cavity.inspection.leastWall * posed.frame.length : 0.0);
  report.add("cavity_components", hollow ? cavity.inspection.components : 0);
  if (cavity.status == CavityStatus::NoRoom) {
    report.add("largest_wall", stages.largestWall * posed.frame.length);
  }
  report.add("repairs", stages.repairs);
  report.add("skeleton_failures", stages.skeletonFailures);
  if (posed.open) report.add("openings", posed.open->openings);
  report.add("solid_vertices", solidVertices(task, cavity));
  report.add("stop_reason", cavity.stopReason);
  report.add("rounds", cavity.rounds);
  report.add("evaluations", cavity.evaluations);
  report.add("seconds_check", stages.secondsCheck);
  report.add("seconds_copy", stages.secondsCopy);
  report.add("seconds_skeleton", stages.secondsSkeleton);
  report.add("seconds_basis", stages.secondsBasis);
  report.add("seconds_limit", stages.secondsLimit);
  report.add("seconds_optimization", cavity.secondsOptimization);
  report.add("seconds_inspection", cavity.secondsInspection);
  return report;
}

} // namespace massprops
