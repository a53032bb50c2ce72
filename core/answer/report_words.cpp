#include "core/answer/report_words.h"

#include "core/base/tolerances.h"
#include "core/goals/registry.h"

#include <cmath>
#include <numeric>

namespace massprops {
namespace {

/// What a cavity of any shape could do about a goal that is missed.
std::string outlook(const Subject& subject) {
  const CavityTask& task = subject.task;
  const Verdict& verdict = subject.verdicts.before;
  const bool isProved = !subject.stages.certificates.empty();
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
  return none + ": " + verdict.bestInWords(bestKnown(subject)) + ".";
}

/// After a space, what there is to say of drain holes.
std::string aboutDrainage(const Subject& subject) {
  if (subject.stages.drainage == nullptr) return "";
  const Drainage& drainage = *subject.stages.drainage;
  const Verdict& verdict = subject.verdicts.after;
  const Options& options = subject.options;
  if (drainage.unreached > 0) {
    return " Drain holes are missing: the cavity is too small to be worth them, or has no place "
           "for a "
           "drill: lower drain_diameter, or turn the print by build_axis.";
  }
  const Moments open = openBody(subject);
  const std::string holes = std::to_string(drainage.holes.size()) +
                            (drainage.holes.size() == 1 ? " drain hole" : " drain holes");
  std::string text = " This is with plugs in its " + holes;
  if (options.goal == GoalKind::Float) {
    text += ", which keep the water out.";
  } else if (options.goal == GoalKind::Mass) {
    text += "; without them it weighs " +
            toString(inModel(open, subject.posed.frame, options.density).mass) + " g.";
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

/// Why there is no room, and what there would be room without, before what is said of the wall.
std::string whatLeavesNoRoom(const Subject& subject) {
  const CavityTask& task = subject.task;
  if (task.open != nullptr) return "there is no room for an open shell with this wall: ";
  const bool isAngleGiven = subject.options.overhangAngle > 0.0;
  const std::string nothing = "nothing can be hollowed at this wall";
  const std::string apart = subject.cavity.shape == CavityShape::BestPossible
                                ? ", channels narrower than the wall apart"
                                : "";
  if (task.surface.keepsOut()) {
    return nothing + (isAngleGiven ? ", solid depth and overhang angle" : " and solid depth") +
           apart + ": select fewer faces, or lower solid_depth" +
           (isAngleGiven ? " or overhang_angle" : "") + "; without these, ";
  }
  return nothing + (isAngleGiven
                        ? " and overhang angle" + apart + ": lower overhang_angle; without it, "
                        : apart + ": ");
}

/// What became of the goal.
std::string outcome(const Subject& subject) {
  const auto& [posed, task, verdicts, cavity, options, stages, before, after] = subject;
  const bool isReached = verdicts.after.isReached(after.mass);
  const bool keepsConstraints = after.violation <= kFeasibility;
  const bool isExact = isReached && keepsConstraints;
  const std::string missed = isExact            ? ""
                             : keepsConstraints ? verdicts.after.whatIsMissed(after.mass)
                                                : verdicts.after.worstViolation(after.mass);
  std::string sentence = isReached ? "The goal is reached" : "The goal is missed";
  // Upright within the verdict's angle, say, but not on the plumb line to its last digits.
  const std::string notExactly = isReached && !isExact ? ", but not exactly" : "";
  const std::string bySolid =
      " by the solid model" + (isExact ? "" : notExactly + ", where " + missed);
  if (cavity.status == CavityStatus::NoRoom) {
    const double largestWall = stages.largestWall * posed.frame.length;
    return sentence + bySolid + "; " + whatLeavesNoRoom(subject) +
           (largestWall > 0.0
                ? "lower inner_lower_bound to " + toString(largestWall) + " or less."
                : "lower inner_lower_bound, and refine the model with Remeshing > Isotropic "
                  "Explicit Remeshing, for no thinner wall was found to leave room either.");
  }
  if (cavity.status == CavityStatus::NoGain) {
    return sentence + bySolid + ", and no cavity with this wall was found to serve it better." +
           (isReached ? "" : outlook(subject));
  }
  if (verdicts.before.isReached(before.mass)) sentence += " (by the solid model too)";
  if (cavity.inspection.components == 0) {
    sentence += " by moving the outer surface alone, for no cavity has room behind this wall";
  }
  if (isExact) return sentence + "; all constraints hold.";
  return sentence + notExactly + ": with the best cavity found " + missed + "." +
         (isReached ? "" : outlook(subject));
}

/// What of the ceiling does not carry itself, after a space.
std::string aboutCeiling(const Subject& subject) {
  if (carriesItself(subject)) return "";
  const Ceiling& ceiling = *subject.stages.ceiling;
  std::string words = " The cavity does not print without support inside:";
  if (!ceiling.tips.empty())
    words += " its ceiling hangs down into it in " + std::to_string(ceiling.tips.size()) +
             (ceiling.tips.size() > 1 ? " places" : " place");
  const double span = ceiling.widestSpan * subject.posed.frame.length;
  if (span > kBridge) {
    words += std::string(!ceiling.tips.empty() ? ", and" : "") + " spans of " + toString(span) +
             " mm are flatter than overhang_angle, more than can be bridged";
  }
  return words + ": lower overhang_angle, or turn the print with build_axis.";
}

/// What goes with a goal that is reached, after a space.
std::string remark(const Subject& subject) {
  const Verdict& verdict = subject.verdicts.after;
  const Moments& mass = subject.after.mass;
  const std::string words = verdict.isReached(mass) ? verdict.remark(mass) : "";
  return words.empty() ? "" : " " + words;
}

/// What the model was cut flat for, after a space.
std::string footInWords(const Subject& subject) {
  const PosedModel& posed = subject.posed;
  if (!posed.foot) return "";
  const double circle = inradius(posed.contact);
  std::string words = " The model has been cut flat, " + toString(posed.foot->depth) +
                      " above its lowest point, and stands on this foot: the outer surface comes "
                      "as a layer of its own.";
  if (circle < kFootInradius) {
    words += " The foot holds a circle of radius " + toString(circle * posed.frame.length) +
             " only, less than 1 % of the diagonal.";
  }
  if (!isSolved(subject)) words += " On a deeper one (foot, foot_depth) it may stand better.";
  return words;
}

/// Where the caller's coordinates are too coarse for the wall, what to do about it, after a space.
std::string adviceOnRounding(const Subject& subject) {
  const double rounding = subject.stages.rounding;
  const double wall = subject.task.wall * subject.posed.frame.length;
  constexpr double kCoarse = 0.01; // of the wall
  if (rounding <= kCoarse * wall) return "";
  return " Where the model lies, coordinates are stored in steps of " + toString(rounding) +
         ", more than a hundredth of the wall: move it to the origin with Normals, Curvatures and "
         "Orientation > Transform: Translate, Center, then run again.";
}

} // namespace

std::string message(const Subject& subject) {
  const std::string& warning = subject.stages.repairs.warning;
  return (warning.empty() ? "" : warning + " ") + outcome(subject) + aboutDrainage(subject) +
         aboutCeiling(subject) + remark(subject) + footInWords(subject) + adviceOnRounding(subject);
}

std::string printAs(const Subject& subject) {
  const double cavityInfill = subject.hasCavity() ? subject.options.cavityInfill : 0.0;
  // All is calculated for walls of one density; sparse infill lets them have another one inside
  // than at their skins.
  std::string words = "dense: 100 % infill, or walls made of perimeters throughout";
  if (cavityInfill > 0.0) {
    words += "; the cavity as infill of " + toString(100.0 * cavityInfill) + " % without skins";
  }
  if (subject.stages.margins) words += "; with less than infill_at_least the verdict does not hold";
  return words;
}

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

} // namespace massprops
