#include "core/answer/hollowing_report.h"

#include "core/answer/report_subject.h"
#include "core/answer/report_words.h"
#include "core/base/triangle.h"
#include "core/goals/objective.h"
#include "core/goals/registry.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <sstream>
#include <vector>

namespace massprops {
namespace {

/// The holes, what stays in the cavities, and the body with its holes open.
void addDrainage(const Subject& subject, Report& report) {
  if (subject.stages.drainage == nullptr) return;
  const Drainage& drainage = *subject.stages.drainage;
  report.add("drain_holes", static_cast<int>(drainage.holes.size()));
  report.add("missing_drain_holes", drainage.missing);
  report.add("filled_cavities", drainage.filled);
  report.add("undrained_cavities", drainage.unreached);
  report.add("seconds_drainage", drainage.seconds);
  if (drainage.unreached > 0) return;
  for (Eigen::Index i = 0; i < drainage.openings.rows(); ++i) {
    report.add("drain_hole_" + std::to_string(i + 1), Vec3(drainage.openings.row(i).transpose()));
  }
  report.add("plug_clearance", kPlugClearance);
  const auto addPools = [&](const std::string& key, const std::vector<double>& pools) {
    report.add("trapped_volume" + key, std::accumulate(pools.begin(), pools.end(), 0.0));
    report.add("largest_pool" + key, pools.empty() ? 0.0 : pools.front());
  };
  addPools("", drainage.pools);
  addPools("_hanging", drainage.poolsHanging);
  const Moments open = openBody(subject);
  const MassProperties body = inModel(open, subject.posed.frame, subject.options.density);
  report.add("mass_open", body.mass);
  report.add("center_of_mass_open", body.centerOfMass);
  report.add("inertia_tensor_open", body.inertiaTensor);
  subject.verdicts.after.describe(open, "open", report);
}

/// All digits, with spaces between.
std::string inDigits(const Vector& values) {
  std::ostringstream text;
  text.precision(17);
  for (Eigen::Index i = 0; i < values.size(); ++i) text << (i > 0 ? " " : "") << values[i];
  return text.str();
}

/// Of the goals that ask for a contact area.
void addContact(const Subject& subject, Report& report) {
  const PosedModel& posed = subject.posed;
  if (!standsOnContacts(subject.options.goal)) return;
  report.add("foot_depth", posed.foot ? posed.foot->depth : 0.0);
  report.add("contact_area", sizeOf(posed.contact) * posed.frame.length * posed.frame.length);
  report.add("contact_inradius", inradius(posed.contact) * posed.frame.length);
}

/// In words, and as numbers for hosts that take no text from a filter.
void addRepairs(const Repairs& repairs, Report& report) {
  report.add("repairs", repairs.describe());
  report.add("merged_vertices", repairs.mergedVertices);
  report.add("unused_vertices", repairs.unusedVertices);
  report.add("zero_area_faces", repairs.zeroAreaFaces);
  report.add("duplicate_faces", repairs.duplicateFaces);
  report.add("flipped_components", repairs.flippedComponents);
  report.add("replaced_cavities", repairs.replacedCavities);
  report.add("mended", !repairs.mended.empty());
  report.add("repair_distance", repairs.distance);
}

/// What the limit's body would do and, where the goal is out of reach, the best body.
void addLimit(const Subject& subject, Report& report) {
  const Verdict& verdict = subject.verdicts.before;
  const OptimalBound& bound = *subject.task.bound;
  report.add("objective_limit", bound.objective);
  if (bound.objectiveAtLeast) report.add("objective_limit_at_least", *bound.objectiveAtLeast);
  report.add("gap_to_limit", gapToBound(bound, subject.before, subject.after));
  verdict.describe(bound.massMoments, "limit", report);
  if (bound.measure) verdict.describeWorst(*bound.measure, "limit", report);
  if (bound.bestLevel() == nullptr || bound.isReachable()) return;
  const std::vector<Moments> best = bestKnown(subject);
  verdict.describe(best.front(), "best", report);
  const std::optional<double> worst = measure(subject.task.goal, best);
  if (worst) verdict.describeWorst(*worst, "best", report);
}

/// The states that count, and what is said of the moments in each of them.
void addStates(const Certificate& proof, const std::string& number, Report& report) {
  std::string functionals;
  std::string conditions;
  std::string fillings;
  for (Eigen::Index s = 0; s < proof.functionals.cols(); ++s) {
    const Filling& filling = proof.fillings[static_cast<std::size_t>(s)];
    functionals += (s > 0 ? "; " : "") + inDigits(proof.functionals.col(s));
    fillings += (s > 0 ? "; " : "") + inDigits(Eigen::Vector2d(filling.density, filling.level));
    std::string sum;
    for (Eigen::Index r = 0; r < proof.rows.rows(); ++r) {
      if (proof.multipliers(r, s) <= 0.0) continue;
      sum += (sum.empty() ? "" : "; ") + inDigits(Vector::Constant(1, proof.multipliers(r, s))) +
             " x " + inDigits(proof.rows.row(r).transpose());
    }
    conditions += (s > 0 ? " | " : "") + sum;
  }
  report.add("certificate_functional" + number, functionals);
  if (proof.multipliers.size() == 0) return; // of a half-space, without conditions
  report.add("certificate_conditions" + number, conditions);
  report.add("certificate_fillings" + number, fillings);
}

/// All that a second program needs to check the proof, in the working frame.
void addCertificates(const Frame& frame, const Stages& stages, Report& report) {
  if (stages.secondsCertificate > 0.0) report.add("certified", !stages.certificates.empty());
  if (stages.certificates.empty()) return;
  report.add("certificate_origin", frame.origin);
  report.add("certificate_length", frame.length);
  for (std::size_t i = 0; i < stages.certificates.size(); ++i) {
    const Certificate& proof = stages.certificates[i];
    const std::string number = stages.certificates.size() > 1 ? "_" + std::to_string(i + 1) : "";
    addStates(proof, number, report);
    report.add("certificate_margin" + number, proof.margin);
  }
  report.add("seconds_certificate", stages.secondsCertificate);
}

/// Vertices of what moves inwards, lids apart, that have no cavity behind them.
int solidVertices(const CavityTask& task, const CavityResult& cavity) {
  const Faces& skin = task.open != nullptr ? task.open->skin : task.model.surface->faces;
  std::vector<char> mark(static_cast<std::size_t>(task.model.surface->vertices.rows()), 0);
  for (Eigen::Index f = 0; f < skin.rows(); ++f) {
    for (const int v : skin.row(f)) {
      const auto i = static_cast<std::size_t>(v);
      mark[i] = cavity.status == CavityStatus::Found ? cavity.cavity.solid[i] : 1;
    }
  }
  return static_cast<int>(std::count(mark.begin(), mark.end(), 1));
}

std::string shapeOf(const CavityResult& cavity) {
  return cavity.shape == CavityShape::Offset ? "offset surface: " : "best possible: ";
}

/// What the answer cost.
void addEffort(const CavityResult& cavity, const Stages& stages, Report& report) {
  report.add("stop_reason", cavity.stopReason);
  report.add("rounds", cavity.effort.rounds);
  report.add("evaluations", cavity.effort.evaluations);
  report.add("seconds_check", stages.secondsCheck);
  report.add("seconds_copy", stages.secondsCopy);
  report.add("seconds_skeleton", stages.secondsSkeleton);
  report.add("seconds_basis", stages.secondsBasis);
  report.add("seconds_limit", stages.secondsLimit);
  report.add("seconds_optimization", cavity.effort.secondsOptimization);
  report.add("seconds_inspection", cavity.effort.secondsInspection);
  if (stages.margins) report.add("seconds_margins", stages.secondsMargins);
}

/// Triangles with an angle below 5°.
int sliversOf(const CavityResult& cavity) {
  constexpr double kLeast = 5.0;
  int count = 0;
  for (Eigen::Index f = 0; f < cavity.cavity.faces.rows(); ++f) {
    const auto corner = [&](int k) {
      return cavity.inner.row(cavity.cavity.faces(f, k)).transpose();
    };
    if (leastAngle(corner(0), corner(1), corner(2)) < kLeast) ++count;
  }
  return count;
}

/// As delivered.
Eigen::Index trianglesOf(const PosedModel& posed, const CavityResult& cavity) {
  const Faces& faces = cavity.cavity.faces;
  return posed.open ? withoutLids(faces, posed.vertices.rows()).rows() : faces.rows();
}

/// Of the bodies before and after.
void addBodies(const Subject& subject, Report& report) {
  const auto& [posed, task, verdicts, cavity, options, stages, before, after] = subject;
  const MassProperties modelBefore = inModel(before.mass, posed.frame, options.density);
  const MassProperties modelAfter = inModel(after.mass, posed.frame, options.density);
  const double unitVolume = std::pow(posed.frame.length, 3);
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
  verdicts.before.describe(before.mass, "before", report);
  verdicts.after.describe(after.mass, "after", report);
  addContact(subject, report);
  addDrainage(subject, report);
  if (!task.bound) return;
  addLimit(subject, report);
  addCertificates(posed.frame, stages, report);
}

/// How to print it, and how far the print may be off.
void addPrint(const Subject& subject, Report& report) {
  report.add("print_as", printAs(subject));
  if (!subject.stages.margins) return;
  const PrintMargins& margins = *subject.stages.margins;
  const double length = subject.posed.frame.length;
  report.add("infill_at_least", margins.infill);
  report.add("wall_error_at_most", margins.wall * length);
  report.add("residue_at_most",
             margins.residue * subject.options.density * std::pow(length, 3) / 1000.0);
}

/// The cavity as a surface.
void addCavity(const Subject& subject, Report& report) {
  const auto& [posed, task, verdicts, cavity, options, stages, before, after] = subject;
  const double leastWall = stages.leastWall.value_or(cavity.inspection.leastWall);
  report.add("min_wall", subject.hasCavity() ? leastWall * posed.frame.length : 0.0);
  if (subject.hasCavity() && stages.solidDepth) {
    report.add("solid_depth", *stages.solidDepth * posed.frame.length);
  }
  if (stages.ceiling) {
    report.add("ceiling_span", stages.ceiling->widestSpan * posed.frame.length);
    report.add("ceiling_tips", static_cast<int>(stages.ceiling->tips.size()));
  }
  report.add("rounding_step", stages.rounding);
  report.add("cavity_components", subject.isHollow() ? cavity.inspection.components : 0);
  report.add("cavity_triangles",
             subject.isHollow() ? static_cast<int>(trianglesOf(posed, cavity)) : 0);
  if (subject.isHollow() && cavity.isContour) report.add("cavity_slivers", sliversOf(cavity));
  if (cavity.status == CavityStatus::NoRoom) {
    report.add("largest_wall", stages.largestWall * posed.frame.length);
    report.add("seconds_largest_wall", stages.secondsLargestWall);
  }
}

} // namespace

Report hollowingReport(const PosedModel& posed, const CavityTask& task, const Verdicts& verdicts,
                       const CavityResult& cavity, const Options& options, const Stages& stages) {
  const Body before = inputBody(task);
  const Body after = cavity.status == CavityStatus::Found ? hollowBody(task, cavity) : before;
  const Subject subject{posed, task, verdicts, cavity, options, stages, before, after};
  Report report;
  report.add("goal", goalNames()[static_cast<std::size_t>(options.goal)]);
  report.add("solved", isSolved(subject));
  report.add("message", message(subject));
  const std::string units = unitsInWords(posed.frame.length);
  if (!units.empty()) report.add("units", units);
  addBodies(subject, report);
  addPrint(subject, report);
  addCavity(subject, report);
  addRepairs(stages.repairs, report);
  report.add("skeleton_failures", stages.skeletonFailures);
  if (posed.open) report.add("openings", posed.open->openings);
  if (subject.hasCavity()) report.add("cavity_shape", shapeOf(cavity) + stages.shapeReason);
  if (!cavity.isContour) report.add("solid_vertices", solidVertices(task, cavity));
  addEffort(cavity, stages, report);
  return report;
}

} // namespace massprops
