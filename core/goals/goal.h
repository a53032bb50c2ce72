// What the hollowed body is to do, as mathematics: objective and constraints by mass moments.
#pragma once

#include "core/base/types.h"
#include "core/physics/mass_properties.h"

namespace massprops {

/// Row vectors of derivatives by the ten mass moments.
using MomentGradients = Eigen::Matrix<double, Eigen::Dynamic, 10, Eigen::RowMajor>;

struct GoalValue {
  double value = 0.0;
  Eigen::Matrix<double, 1, 10> gradient = Eigen::Matrix<double, 1, 10>::Zero();
};

/// r constraint values and their derivatives, r×10.
struct GoalConstraints {
  Vector values;
  MomentGradients gradients;
};

/// What a verdict that is one number t, the greater the better, asks of a body: it is at least t
/// exactly where all values are ≤ 0. `slopes`: the values' derivatives by t, r entries.
struct VerdictBounds {
  GoalConstraints constraints;
  Vector slopes;
};

/// A goal sees a body through its ten mass moments M in the working frame, the material's density
/// being 1: M = outer − (1 − f) inner with f the filling's density, so that any function of M is
/// one of the cavity's moments with dM/d(inner) = f − 1. f is the `fillDensity` of the task, see
/// `fillingSeenBy`. Everything is dimensionless; objective and constraints are smooth, but for the
/// kinks of a contact polygon with very many corners (stand.h).
class Goal {
public:
  virtual ~Goal() = default;

  virtual GoalValue objective(const Moments& massMoments) const = 0;
  /// Each must be 0. Scaled so that 1 is a violation as large as the body itself.
  virtual GoalConstraints equalities(const Moments& massMoments) const = 0;
  /// Each must be ≤ 0; scaled likewise.
  virtual GoalConstraints inequalities(const Moments& massMoments) const = 0;
  /// Whether second moments matter; if not, their derivatives are 0 and need not be computed.
  virtual bool usesInertia() const = 0;
  /// Bounds of the verdict at `level`; none where it is more than one number. Each times the mass
  /// is linear in the moments.
  virtual VerdictBounds verdictBounds(const Moments& massMoments, double level) const;
};

/// Largest |equality| or positive inequality.
double largestViolation(const Goal& goal, const Moments& massMoments);

} // namespace massprops
