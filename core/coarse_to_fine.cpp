#include "core/coarse_to_fine.h"

#include <algorithm>
#include <cmath>

namespace massprops {
namespace {

/// Corrections that may be tried; three suffice most often.
constexpr int kMostCorrections = 8;
/// A step that makes things worse is shortened to this.
constexpr double kShorten = 0.3;

struct Point {
  Vector x;
  CavityMoments cavity;
  Evaluation evaluation;
  double violation = 0.0;
};

double violationOf(const Evaluation& e) {
  double violation = 0.0;
  if (e.equalities.size() > 0) violation = e.equalities.cwiseAbs().maxCoeff();
  if (e.inequalities.size() > 0) violation = std::max(violation, e.inequalities.maxCoeff());
  return violation;
}

} // namespace

OptimizeResult minimizeCoarseToFine(const OffsetModel& fine, const OffsetModel& coarse,
                                    const Goal& goal, const Weights& weights, const Vector& start,
                                    const OptimizeOptions& options) {
  const bool inertia = goal.usesInertia();
  int evaluations = 0;
  const auto finePoint = [&](const Vector& x) {
    ++evaluations;
    Point p{x, cavityMoments(fine, x, inertia), {}, 0.0};
    p.evaluation = evaluateMoments(fine, goal, weights, p.cavity);
    p.violation = violationOf(p.evaluation);
    return p;
  };
  OptimizeOptions inner = options;
  // Between two corrections the constraints need only be as exact as the corrections are.
  const double tolerance = std::max(options.feasibility, 1e-6);
  const auto isBetter = [&](const Point& p, const Point& q) {
    const double ofP = std::max(p.violation, tolerance);
    const double ofQ = std::max(q.violation, tolerance);
    return ofP < ofQ || (ofP == ofQ && p.evaluation.objective < q.evaluation.objective);
  };

  Point best = finePoint(start);
  std::string stopReason = "evaluation limit";
  for (int correction = 0; correction < kMostCorrections; ++correction) {
    const CavityMoments there = cavityMoments(coarse, best.x, inertia);
    const Moments shift = best.cavity.value - there.value;
    const MomentJacobian tilt = best.cavity.jacobian - there.jacobian;
    const auto corrected = [&](const Vector& x) {
      CavityMoments cavity = cavityMoments(coarse, x, inertia);
      cavity.value += shift + tilt * (x - best.x);
      cavity.jacobian += tilt;
      return evaluateMoments(fine, goal, weights, cavity);
    };
    const OptimizeResult step = minimize(corrected, best.x, inner);
    inner.objectiveScale = step.objectiveScale;
    Point next = finePoint(step.x);
    bool better = isBetter(next, best);
    constexpr int kMostShortenings = 2;
    for (int i = 0; i < kMostShortenings && !better; ++i) {
      next = finePoint(best.x + kShorten * (next.x - best.x));
      better = isBetter(next, best);
    }
    if (!better) {
      stopReason = "coefficients converged";
      break;
    }
    const double gain = best.evaluation.objective - next.evaluation.objective;
    const bool wasFeasible = best.violation <= tolerance;
    best = std::move(next);
    // A hundredth of the range that the objective is scaled to would be seen in print; SLSQP's own
    // tolerance is far below what one more correction changes.
    constexpr double kWorthACorrection = 10.0;
    if (wasFeasible && best.violation <= tolerance &&
        gain * step.objectiveScale < kWorthACorrection * options.objectiveTolerance) {
      stopReason = "objective converged";
      break;
    }
  }

  OptimizeResult result;
  result.x = best.x;
  result.objective = best.evaluation.objective;
  result.violation = std::max(0.0, best.violation);
  result.objectiveScale = inner.objectiveScale.value_or(1.0);
  if (best.violation > options.feasibility) {
    const auto problem = [&](const Vector& x) { return finePoint(x).evaluation; };
    const OptimizeResult restored = restoreFeasibility(problem, best.x, options);
    if (restored.violation < result.violation) {
      result.x = restored.x;
      result.objective = restored.objective;
      result.violation = restored.violation;
    }
  }
  result.evaluations = evaluations;
  result.stopReason = stopReason;
  return result;
}

} // namespace massprops
