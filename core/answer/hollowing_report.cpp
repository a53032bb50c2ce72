#include "core/answer/hollowing_report.h"

#include "core/base/tolerances.h"
#include "core/base/triangle.h"
#include "core/goals/objective.h"
#include "core/goals/registry.h"
#include "core/reduced/hollow_body.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <sstream>
#include <vector>

namespace massprops {
namespace {

/// All is calculated for walls of one density; sparse infill lets them have another one inside
/// than at their skins.
std::string printAs(double cavityInfill, bool hasMargins) {
  std::string words = "dense: 100 % infill, or walls made of perimeters throughout";
  if (cavityInfill > 0.0) {
    words += "; the cavity as infill of " + toString(100.0 * cavityInfill) + " % without skins";
  }
  if (hasMargins) words += "; with less than infill_at_least the verdict does not hold";
  return words;
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

/// In its states the body that comes nearest to a goal out of reach, of all that are known: that of
/// the best level need not where constraints count that are not linear. Empty: it is the delivered
/// one.
std::vector<Moments> nearerToGoal(const CavityTask& task, const Verdict& verdict,
                                  const Body& delivered) {
  const OptimalBound& bound = *task.bound;
  const LevelBound* level = bound.bestLevel();
  if (level != nullptr && measure(task.goal, level->states)) return level->states;
  std::vector<std::vector<Moments>> bodies{{bound.massMomentsInAll}, {bound.massMoments}};
  if (level != nullptr) bodies.push_back(level->states);
  const auto isNearer = [&](const std::vector<Moments>& a, const std::vector<Moments>& b) {
    return verdict.violation(a.front()) < verdict.violation(b.front());
  };
  std::vector<Moments> nearest = *std::min_element(bodies.begin(), bodies.end(), isNearer);
  if (!isNearer(nearest, {delivered.mass})) return {};
  return nearest;
}

/// What a cavity of any shape could do about a goal that is missed.
std::string outlook(const CavityTask& task, const Verdict& verdict, const Body& delivered,
                    bool isProved) {
  if (!task.bound) return "";
  if (task.bound->outOfReach && isProved) {
    return " No cavity of any shape that keeps this wall can reach it.";
  }
  const std::string keeps = task.surface.keepsOut() && !isProved
                                ? "keeps this wall and the solid depth"
                                : "keeps this wall";
  if (task.bound->isReachable()) {
    if (verdict.isReached(task.bound->massMoments)) {
      return " A cavity of another shape could reach it.";
    }
    return verdict.isReached(task.bound->massMomentsInAll)
               ? " A cavity with channels narrower than the wall could reach it."
               : " No cavity of any other shape was found to reach it.";
  }
  const std::string none = " No cavity of any shape that " + keeps +
                           (isProved ? " can reach it" : " was found to reach it");
  std::vector<Moments> best = nearerToGoal(task, verdict, delivered);
  if (best.empty()) best = {delivered.mass};
  return none + ": " + verdict.bestInWords(best) + ".";
}

/// With the holes open; the mass moments that the verdict sees are those with the plugs in.
Moments openBody(const Body& plugged, const Drainage& drainage) {
  return plugged.mass - drainage.plugged + drainage.open;
}

/// In water the holes are closed, and what is to weigh so much is weighed with its plugs.
bool isForPluggedAlone(GoalKind goal) {
  return goal == GoalKind::Float || goal == GoalKind::Mass;
}

/// Whether the print does what it shall with its holes open, too.
bool servesDrained(const Verdict& verdict, const Body& plugged, const Stages& stages,
                   const Options& options) {
  if (stages.drainage == nullptr) return true;
  return stages.drainage->unreached == 0 &&
         (isForPluggedAlone(options.goal) ||
          verdict.isReached(openBody(plugged, *stages.drainage)));
}

/// After a space, what there is to say of drain holes.
std::string aboutDrainage(const PosedModel& posed, const Verdict& verdict, const Body& plugged,
                          const Stages& stages, const Options& options) {
  if (stages.drainage == nullptr) return "";
  const Drainage& drainage = *stages.drainage;
  if (drainage.unreached > 0) {
    return " Drain holes are missing: the cavity is too small to be worth them, or has no place "
           "for "
           "a drill: lower drain_diameter, or turn the print by build_axis.";
  }
  const Moments open = openBody(plugged, drainage);
  const std::string holes = std::to_string(drainage.holes.size()) +
                            (drainage.holes.size() == 1 ? " drain hole" : " drain holes");
  std::string text = " This is with plugs in its " + holes;
  if (options.goal == GoalKind::Float) {
    text += ", which keep the water out.";
  } else if (options.goal == GoalKind::Mass) {
    text += "; without them it weighs " +
            toString(inModel(open, posed.frame, options.density).mass) + " g.";
  } else if (verdict.isReached(open)) {
    text += "; with the holes open the goal is reached, too.";
  } else {
    text += "; with the holes open the goal is missed: " + verdict.whatIsMissed(open) + ".";
  }
  if (drainage.missing > 0) {
    text += " For " + std::to_string(drainage.missing) + " more there is no place.";
  }
  if (drainage.filled > 0) {
    text += drainage.filled == 1 ? " One cavity too small for a drain hole is filled."
                                 : " " + std::to_string(drainage.filled) +
                                       " cavities too small for a drain hole are filled.";
  }
  if (!drainage.pools.empty() && drainage.pools.front() > kToleratedPool) {
    constexpr double kMillilitre = 1000.0;
    const double sum = std::accumulate(drainage.pools.begin(), drainage.pools.end(), 0.0);
    text += " Held as it is built, it keeps " +
            toString(std::round(sum / kMillilitre * 100.0) / 100.0) +
            " ml of liquid below its lowest outlets: turn it to drain it.";
  }
  return text;
}

/// The holes, what stays in the cavities, and the body with its holes open.
void addDrainage(const PosedModel& posed, const Verdict& verdict, const Body& plugged,
                 const Drainage& drainage, double density, Report& report) {
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
  const Moments open = openBody(plugged, drainage);
  const MassProperties body = inModel(open, posed.frame, density);
  report.add("mass_open", body.mass);
  report.add("center_of_mass_open", body.centerOfMass);
  report.add("inertia_tensor_open", body.inertiaTensor);
  verdict.describe(open, "open", report);
}

/// Why there is no room, and what there would be room without, before what is said of the wall.
std::string whatLeavesNoRoom(const CavityTask& task, CavityShape shape, const Options& options) {
  if (task.open != nullptr) return "there is no room for an open shell with this wall: ";
  const bool isAngleGiven = options.overhangAngle > 0.0;
  const std::string nothing = "nothing can be hollowed at this wall";
  const std::string apart =
      shape == CavityShape::BestPossible ? ", channels narrower than the wall apart" : "";
  if (task.surface.keepsOut()) {
    return nothing + (isAngleGiven ? ", solid depth and overhang angle" : " and solid depth") +
           apart + ": select fewer faces, or lower solid_depth" +
           (isAngleGiven ? " or overhang_angle" : "") + "; without these, ";
  }
  return nothing + (isAngleGiven
                        ? " and overhang angle" + apart + ": lower overhang_angle; without it, "
                        : apart + ": ");
}

std::string message(const CavityTask& task, const Verdicts& verdicts, const CavityResult& cavity,
                    const Body& before, const Body& after, double largestWall, bool isProved,
                    const Options& options) {
  const bool isReached = verdicts.after.isReached(after.mass);
  const bool keepsConstraints = after.violation <= kFeasibility;
  const bool isSolved = isReached && keepsConstraints;
  const std::string missed = isSolved           ? ""
                             : keepsConstraints ? verdicts.after.whatIsMissed(after.mass)
                                                : verdicts.after.worstViolation(after.mass);
  std::string sentence = isReached ? "The goal is reached" : "The goal is missed";
  // Upright within the verdict's angle, say, but not on the plumb line to its last digits.
  const std::string notExactly = isReached && !isSolved ? ", but not exactly" : "";
  const std::string bySolid =
      " by the solid model" + (isSolved ? "" : notExactly + ", where " + missed);
  if (cavity.status == CavityStatus::NoRoom) {
    return sentence + bySolid + "; " + whatLeavesNoRoom(task, cavity.shape, options) +
           (largestWall > 0.0
                ? "lower inner_lower_bound to " + toString(largestWall) + " or less."
                : "lower inner_lower_bound, and refine the model with Remeshing > Isotropic "
                  "Explicit Remeshing, for no thinner wall was found to leave room either.");
  }
  if (cavity.status == CavityStatus::NoGain) {
    return sentence + bySolid + ", and no cavity with this wall was found to serve it better." +
           (isReached ? "" : outlook(task, verdicts.before, after, isProved));
  }
  if (verdicts.before.isReached(before.mass)) sentence += " (by the solid model too)";
  if (cavity.inspection.components == 0) {
    sentence += " by moving the outer surface alone, for no cavity has room behind this wall";
  }
  if (isSolved) return sentence + "; all constraints hold.";
  return sentence + notExactly + ": with the best cavity found " + missed + "." +
         (isReached ? "" : outlook(task, verdicts.before, after, isProved));
}

bool carriesItself(const PosedModel& posed, const Stages& stages) {
  return !stages.ceiling || (stages.ceiling->tips.empty() &&
                             stages.ceiling->widestSpan * posed.frame.length <= kBridge);
}

/// What of the ceiling does not carry itself, after a space.
std::string aboutCeiling(const PosedModel& posed, const Stages& stages) {
  if (carriesItself(posed, stages)) return "";
  std::string words = " The cavity does not print without support inside:";
  if (!stages.ceiling->tips.empty())
    words += " its ceiling hangs down into it in " + std::to_string(stages.ceiling->tips.size()) +
             (stages.ceiling->tips.size() > 1 ? " places" : " place");
  const double span = stages.ceiling->widestSpan * posed.frame.length;
  if (span > kBridge) {
    words += std::string(!stages.ceiling->tips.empty() ? ", and" : "") + " spans of " +
             toString(span) + " mm are flatter than overhang_angle, more than can be bridged";
  }
  return words + ": lower overhang_angle, or turn the print with build_axis.";
}

/// All digits, with spaces between.
std::string inDigits(const Vector& values) {
  std::ostringstream text;
  text.precision(17);
  for (Eigen::Index i = 0; i < values.size(); ++i) text << (i > 0 ? " " : "") << values[i];
  return text.str();
}

/// What goes with a goal that is reached, after a space.
std::string remark(const Verdict& verdict, const Moments& massMoments) {
  const std::string words = verdict.isReached(massMoments) ? verdict.remark(massMoments) : "";
  return words.empty() ? "" : " " + words;
}

/// What the model was cut flat for, after a space.
std::string footInWords(const PosedModel& posed, bool isSolved) {
  if (!posed.foot) return "";
  const double circle = inradius(posed.contact);
  std::string words = " The model has been cut flat, " + toString(posed.foot->depth) +
                      " above its lowest point, and stands on this foot: the outer surface comes "
                      "as a layer of its own.";
  if (circle < kFootInradius) {
    words += " The foot holds a circle of radius " + toString(circle * posed.frame.length) +
             " only, less than 1 % of the diagonal.";
  }
  if (!isSolved) words += " On a deeper one (foot, foot_depth) it may stand better.";
  return words;
}

/// Of the goals that ask for a contact area.
void addContact(const PosedModel& posed, const Options& options, Report& report) {
  if (!standsOnContacts(options.goal)) return;
  report.add("foot_depth", posed.foot ? posed.foot->depth : 0.0);
  report.add("contact_area", sizeOf(posed.contact) * posed.frame.length * posed.frame.length);
  report.add("contact_inradius", inradius(posed.contact) * posed.frame.length);
}

/// What a person should know about a model of such a size; "" where it is a usual one.
std::string unitsInWords(double diagonal) {
  constexpr double kSmall = 5.0;
  constexpr double kLarge = 2000.0;
  if (diagonal >= kSmall && diagonal <= kLarge) return "";
  return "Lengths are read as millimetres, and the model's diagonal is " + toString(diagonal) +
         (diagonal < kSmall ? ": if it is in inches scale it by 25.4, if in metres by 1000"
                            : ": if it is in micrometres scale it by 0.001, and if it is larger "
                              "than its print will be, to the print's size") +
         ", for grams and lengths to be those of the print.";
}

/// Where the caller's coordinates are too coarse for the wall, what to do about it, after a space.
std::string adviceOnRounding(double rounding, double wall) {
  constexpr double kCoarse = 0.01; // of the wall
  if (rounding <= kCoarse * wall) return "";
  return " Where the model lies, coordinates are stored in steps of " + toString(rounding) +
         ", more than a hundredth of the wall: move it to the origin with Normals, Curvatures and "
         "Orientation > Transform: Translate, Center, then run again.";
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
void addLimit(const CavityTask& task, const Verdicts& verdicts, const Body& before,
              const Body& after, Report& report) {
  const OptimalBound& bound = *task.bound;
  report.add("objective_limit", bound.objective);
  if (bound.objectiveAtLeast) report.add("objective_limit_at_least", *bound.objectiveAtLeast);
  report.add("gap_to_limit", gapToBound(bound, before, after));
  verdicts.before.describe(bound.massMoments, "limit", report);
  if (bound.measure) verdicts.before.describeWorst(*bound.measure, "limit", report);
  if (bound.bestLevel() == nullptr || bound.isReachable()) return;
  std::vector<Moments> best = nearerToGoal(task, verdicts.before, after);
  if (best.empty()) best = {after.mass};
  verdicts.before.describe(best.front(), "best", report);
  const std::optional<double> worst = measure(task.goal, best);
  if (worst) verdicts.before.describeWorst(*worst, "best", report);
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

} // namespace

Report hollowingReport(const PosedModel& posed, const CavityTask& task, const Verdicts& verdicts,
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
  const bool isSolved = after.violation <= kFeasibility && verdicts.after.isReached(after.mass) &&
                        servesDrained(verdicts.after, after, stages, options) &&
                        carriesItself(posed, stages);
  report.add("solved", isSolved);
  report.add("message", (stages.repairs.warning.empty() ? "" : stages.repairs.warning + " ") +
                            message(task, verdicts, cavity, before, after,
                                    stages.largestWall * posed.frame.length,
                                    !stages.certificates.empty(), options) +
                            aboutDrainage(posed, verdicts.after, after, stages, options) +
                            aboutCeiling(posed, stages) + remark(verdicts.after, after.mass) +
                            footInWords(posed, isSolved) +
                            adviceOnRounding(stages.rounding, task.wall * posed.frame.length));
  const std::string units = unitsInWords(posed.frame.length);
  if (!units.empty()) report.add("units", units);
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
  addContact(posed, options, report);
  if (stages.drainage != nullptr) {
    addDrainage(posed, verdicts.after, after, *stages.drainage, options.density, report);
  }
  if (task.bound) {
    addLimit(task, verdicts, before, after, report);
    addCertificates(posed.frame, stages, report);
  }
  report.add("print_as",
             printAs(hasCavity ? options.cavityInfill : 0.0, stages.margins.has_value()));
  if (stages.margins) {
    report.add("infill_at_least", stages.margins->infill);
    report.add("wall_error_at_most", stages.margins->wall * posed.frame.length);
    report.add("residue_at_most", stages.margins->residue * options.density * unitVolume / 1000.0);
  }
  const double leastWall = stages.leastWall.value_or(cavity.inspection.leastWall);
  report.add("min_wall", hasCavity ? leastWall * posed.frame.length : 0.0);
  if (hasCavity && stages.solidDepth) {
    report.add("solid_depth", *stages.solidDepth * posed.frame.length);
  }
  if (stages.ceiling) {
    report.add("ceiling_span", stages.ceiling->widestSpan * posed.frame.length);
    report.add("ceiling_tips", static_cast<int>(stages.ceiling->tips.size()));
  }
  report.add("rounding_step", stages.rounding);
  report.add("cavity_components", hollow ? cavity.inspection.components : 0);
  report.add("cavity_triangles", hollow ? static_cast<int>(trianglesOf(posed, cavity)) : 0);
  if (hollow && cavity.isContour) report.add("cavity_slivers", sliversOf(cavity));
  if (cavity.status == CavityStatus::NoRoom) {
    report.add("largest_wall", stages.largestWall * posed.frame.length);
    report.add("seconds_largest_wall", stages.secondsLargestWall);
  }
  addRepairs(stages.repairs, report);
  report.add("skeleton_failures", stages.skeletonFailures);
  if (posed.open) report.add("openings", posed.open->openings);
  if (hasCavity) report.add("cavity_shape", shapeOf(cavity) + stages.shapeReason);
  if (!cavity.isContour) report.add("solid_vertices", solidVertices(task, cavity));
  addEffort(cavity, stages, report);
  return report;
}

} // namespace massprops
