// What the hollowed body is to do: one class a goal.
#pragma once

#include "core/contact.h"
#include "core/mass_properties.h"
#include "core/options.h"
#include "core/report.h"

#include <memory>
#include <string>

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

/// Everything is dimensionless, in the working frame, of the body whose ten mass moments are given
/// relative to the goal's reference point (the centre of the contact area).
class Goal {
public:
  virtual ~Goal() = default;

  virtual GoalValue objective(const Moments& massMoments) const = 0;
  /// Each must be 0. Scaled so that 1 is a violation as large as the body itself.
  virtual GoalConstraints equalities(const Moments& massMoments) const = 0;
  /// Each must be ≤ 0; scaled likewise.
  virtual GoalConstraints inequalities(const Moments& massMoments) const = 0;
  /// Whether second moments matter; if not, their derivatives need not be computed.
  virtual bool usesInertia() const = 0;
  /// Whether the body does what the goal asks for, constraint margins aside.
  virtual bool isReached(const Moments& massMoments) const = 0;
  /// The constraint that is violated most, in words and in the model's units; of use only when
  /// `largestViolation` is not 0.
  virtual std::string worstViolation(const Moments& massMoments) const = 0;
  /// Adds the goal's own keys with `suffix` ("before", "after") to the report.
  virtual void describe(const Moments& massMoments, const std::string& suffix,
                        Report& report) const = 0;
};

/// Stands on its contact area: minimises c_x² + c_y² + c_z over the area's centre, the centre of
/// mass kept above the area, shrunk by a tenth. `lengthUnit`: model units per working unit, for the
/// report. [PWLSH13, Sec. 4; MAB15, Sec. 5]
std::unique_ptr<Goal> makeStandGoal(const ContactArea& area, const Weights& weights,
                                    double lengthUnit);

/// Spins about the vertical through its contact point: minimises (m/m_solid) c_z +
/// (I_a² + I_b²)/I_zz², centre of mass on the axis, the axis a principal one.
/// [BWBSH14, Sec. 4; MAB15, Sec. 5]
std::unique_ptr<Goal> makeSpinGoal(const Moments& solidMassMoments, const Weights& weights,
                                   double lengthUnit);

/// Largest |equality| or positive inequality.
double largestViolation(const Goal& goal, const Moments& massMoments);

} // namespace massprops
