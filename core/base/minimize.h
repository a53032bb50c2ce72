// Smooth constrained minimisation in a few dozen variables.
#pragma once

#include "core/base/types.h"

#include <functional>
#include <optional>
#include <string>

namespace massprops {

/// Everything about one point x: objective, equality constraints h(x) = 0 and inequality
/// constraints g(x) ≤ 0, with derivatives (one row a constraint).
struct Evaluation {
  double objective = 0.0;
  Vector objectiveGradient;
  Vector equalities;
  Matrix equalityJacobian;
  Vector inequalities;
  Matrix inequalityJacobian;
};

using Problem = std::function<Evaluation(const Vector&)>;

struct MinimizeOptions {
  /// One evaluation costs a pass over the mesh; SLSQP gains little past this.
  int maxEvaluations = 60;
  /// Stop when a step changes the objective by less than this share of the range it is scaled to.
  double objectiveTolerance = 1e-5;
  /// A constraint holds when it is violated by no more than this.
  double feasibility = 1e-7;
  /// Factor on the objective. Empty: such that its gradient at the start has length 10.
  std::optional<double> objectiveScale;
  /// Box |x_j| ≤ range: past it the bound map is saturated.
  double range = 20.0;
  /// Whether constraints that are out of reach are met as nearly as can be, by the largest of their
  /// violations, whatever the objective becomes. As many evaluations again.
  bool comesNearest = false;
};

struct MinimizeResult {
  Vector x; ///< the best point seen: least violation first, then least objective
  /// There; infinite where no evaluation was finite, x being the start.
  double objective = 0.0;
  double violation = 0.0; ///< largest constraint violation at x, likewise
  int evaluations = 0;
  double objectiveScale = 1.0; ///< that was used
  std::string stopReason;
};

/// Sequential least-squares quadratic programming (NLopt's LD_SLSQP), on a problem scaled so that
/// objective and constraints have gradients of about the same length at the start. Keeps the best
/// of all points evaluated, for SLSQP may end on a worse or infeasible one. Where the constraints
/// do not hold there, damped Gauss–Newton steps take the shortest way to where they do, or to the
/// least squared violation when the goal is out of reach; see `violation` and `comesNearest`.
/// [Kra88]
MinimizeResult minimize(const Problem& problem, const Vector& start,
                        const MinimizeOptions& options = {});

} // namespace massprops
