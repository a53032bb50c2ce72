#include "core/coarse_to_fine.h"

#include "core/moments.h"

#include <algorithm>

namespace massprops {
namespace {

/// Corrections that may be tried; three suffice most often.
constexpr int kMostCorrections = 8;
/// A step that makes things worse is shortened to this.
constexpr double kShorten = 0.3;
/// What a step may leave a constraint by on the way: the next correction leads back.
constexpr double kLooseViolation = 0.02;
/// Outside of that the violation must shrink to this.
constexpr double kNearer = 0.7;

struct Point {
  Vector x;
  Moments cavity;
  double objective = 0.0;
  double violation = 0.0;
};

Moments cavityOf(const OffsetModel& model, const Vector& x) {
  return moments(offsetSurfaces(model, x).inner, model.innerFaces);
}

} // namespace

OptimizeResult minimizeCoarseToFine(const OffsetModel& fine, const OffsetModel& coarse,
                                    const Goal& goal, const Weights& weights, const Vector& start,
                                    const OptimizeOptions& options) {
  OptimizeResult result;
  const auto finePoint = [&](const Vector& x) {
    ++result.evaluations;
    Point p{x, cavityOf(fine, x)};
    const double volume = fine.solidMoments[0];
    const Moments body = shellMoments(fine.solidMoments, p.cavity, 1.0, fine.fillDensity);
    p.objective = momentObjective(goal, weights, body, (volume - p.cavity[0]) / volume);
    p.violation = weights.constraints != 0.0 ? largestViolation(goal, body) : 0.0;
    return p;
  };
  // Between two corrections the constraints need only be as exact as the corrections are.
  const double tolerance = std::max(options.feasibility, 1e-6);
  const auto isBetter = [&](const Point& p, const Point& q) {
    const double ofP = std::max(p.violation, tolerance);
    const double ofQ = std::max(q.violation, tolerance);
    return ofP < ofQ || (ofP == ofQ && p.objective < q.objective);
  };
  const auto isProgress = [&](const Point& p, const Point& from) {
    if (p.violation > kLooseViolation) return p.violation < kNearer * from.violation;
    return p.objective < from.objective || std::max(p.violation, tolerance) < from.violation;
  };

  OptimizeOptions inner = options;
  Point current = finePoint(start);
  Point best = current;
  bool isReachable = true;
  result.stopReason = "evaluation limit";
  for (int correction = 0; correction < kMostCorrections; ++correction) {
    const Moments shift = current.cavity - cavityOf(coarse, current.x);
    const auto corrected = [&](const Vector& x) {
      CavityMoments cavity = cavityMoments(coarse, x, goal.usesInertia());
      cavity.value += shift;
      return evaluateMoments(fine, goal, weights, cavity);
    };
    const OptimizeResult step = minimize(corrected, current.x, inner);
    inner.objectiveScale = step.objectiveScale;
    isReachable = step.violation <= tolerance;
    Point next = finePoint(step.x);
    constexpr int kMostShortenings = 2;
    for (int i = 0; i < kMostShortenings && !isProgress(next, current); ++i) {
      next = finePoint(current.x + kShorten * (next.x - current.x));
    }
    if (!isProgress(next, current)) {
      result.stopReason = "coefficients converged";
      break;
    }
    const double gain = current.objective - next.objective;
    const bool areFeasible = std::max(current.violation, next.violation) <= tolerance;
    current = std::move(next);
    if (isBetter(current, best)) best = current;
    // A hundredth of the range that the objective is scaled to would be seen in print; SLSQP's own
    // tolerance is far below what one more correction changes.
    constexpr double kWorthACorrection = 10.0;
    if (areFeasible &&
        gain * step.objectiveScale < kWorthACorrection * options.objectiveTolerance) {
      result.stopReason = "objective converged";
      break;
    }
  }

  result.x = best.x;
  result.objective = best.objective;
  result.violation = best.violation;
  result.objectiveScale = inner.objectiveScale.value_or(1.0);
  const bool isFeasible = best.violation <= options.feasibility;
  if (isReachable && (!isFeasible || current.objective < best.objective)) {
    const auto problem = [&](const Vector& x) { return evaluate(fine, goal, weights, x); };
    const OptimizeResult restored = restoreFeasibility(problem, current.x, options);
    result.evaluations += restored.evaluations;
    if (isFeasible
            ? restored.violation <= options.feasibility && restored.objective < best.objective
            : restored.violation < best.violation) {
      result.x = restored.x;
      result.objective = restored.objective;
      result.violation = restored.violation;
    }
  }
  return result;
}

} // namespace massprops
