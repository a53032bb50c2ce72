// What the hollowed body is to do: one class a goal.
#pragma once

#include "core/base/options.h"
#include "core/base/report.h"
#include "core/mesh/annotations.h"
#include "core/model/contact.h"
#include "core/model/posed_model.h"
#include "core/physics/mass_properties.h"

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

/// What a verdict that is one number t, the greater the better, asks of a body: it is at least t
/// exactly where all values are ≤ 0. `slopes`: the values' derivatives by t, r entries.
struct VerdictBounds {
  GoalConstraints constraints;
  Vector slopes;
};

/// A goal sees a body through its ten mass moments M in the working frame, the material's density
/// being 1: M = outer − (1 − f) inner with f the filling's density, so that any function of M is
/// one of the cavity's moments with dM/d(inner) = f − 1. f is the `fillDensity` of the task, see
/// `fillingSeenBy`. Everything is dimensionless; objective and constraints are smooth.
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
  /// Whether the body does what the goal asks for, constraint margins aside.
  virtual bool isReached(const Moments& massMoments) const = 0;
  /// The constraint that is violated most, in words and in the model's units; of use only when
  /// `largestViolation` is not 0.
  virtual std::string worstViolation(const Moments& massMoments) const = 0;
  /// Adds the goal's own keys with `suffix` ("before", "after") to the report.
  virtual void describe(const Moments& massMoments, const std::string& suffix,
                        Report& report) const = 0;
  /// Bounds of the verdict at `level`; none where it is more than one number. Each times the mass
  /// is linear in the moments.
  virtual VerdictBounds verdictBounds(const Moments& massMoments, double level) const;
  /// What the best of all bodies reaches, in words, when no body holds all constraints.
  virtual std::string bestInWords(const Moments& massMoments) const;
  /// Draws, in the working frame, what the verdict goes by on the solid body `before` and on the
  /// answer `after`, and names it in plain words; nothing but "" where the numbers say it all.
  virtual std::string draw(const Moments& before, const Moments& after,
                           Annotations& annotations) const;
};

// One factory a goal. `lengthUnit`: model units per working unit, for the report. Formulas in
// docs/math.md under the goal's name.

/// Stands on its contact area: minimises c_x² + c_y² + c_z over the area's centre, the centre of
/// mass kept above the area, shrunk by a tenth. [PWLSH13, Sec. 4; MAB15, Sec. 5]
std::unique_ptr<Goal> makeStandGoal(const ContactArea& area, const Weights& weights,
                                    double lengthUnit);

/// Spins about the vertical through `pivot`: minimises (m/m_solid) c_z + (I_a² + I_b²)/I_zz², c_z
/// measured from the pivot, the centre of mass on the axis, the axis a principal one.
/// [BWBSH14, Sec. 4; MAB15, Sec. 5]
std::unique_ptr<Goal> makeSpinGoal(const Moments& solidMassMoments, const Weights& weights,
                                   double lengthUnit, const Vec3& pivot = Vec3::Zero());

/// Spins about the vertical axle whose middle is `pivot`: minimises (I_a² + I_b²)/I_zz², the centre
/// of mass at the pivot, the axle a principal axis. [BWBSH14, Sec. 4]
std::unique_ptr<Goal> makeYoYoGoal(const Moments& solidMassMoments, const Weights& weights,
                                   double lengthUnit, const Vec3& pivot);

/// Stands with the cavity empty and with the cavity filled: the sum of Stand's objective over both,
/// the constraints of both. A function of the moments of the *empty* body; the filled one has
/// (1 − f) empty + f outer, with f the filling's density as a multiple of the material's.
std::unique_ptr<Goal> makeStandEmptyAndFilledGoal(const ContactArea& area, const Moments& outer,
                                                  double filling, const Weights& weights,
                                                  double lengthUnit);

/// Comes back upright from every position: Stand's objective and constraints; the verdict counts
/// the stable resting poses of the convex hull of `outer` (n×3, working frame). An area that is a
/// point counts as a small disc.
std::unique_ptr<Goal> makeRollUprightGoal(const ContactArea& area, const Points& outer,
                                          const Weights& weights, double lengthUnit);

/// Floats upright at a waterline: minimises c_z; the body as heavy as the water it displaces
/// there, its centre of mass above or below the centre of buoyancy and under the metacentre; the
/// verdict finds the pose in which the body really floats. `waterLevel`: share of the height;
/// `waterDensity`: as a multiple of the material's. [WW16; docs/math.md "Float"]
std::unique_ptr<Goal> makeFloatGoal(const Points& outer, const Faces& faces, double waterLevel,
                                    double waterDensity, const Weights& weights, double lengthUnit);

/// Hangs upright from `suspension`: minimises c_z, the centre of mass plumb below the point.
/// [PWLSH13, Sec. 4]
std::unique_ptr<Goal> makeHangGoal(const Vec3& suspension, const Weights& weights,
                                   double lengthUnit);

/// Weighs `target` (working units, material of density 1): minimises ((m − target)/m_solid)² under
/// m = target; without a target as light as possible. `grams`: grams per working unit of mass.
std::unique_ptr<Goal> makeMassGoal(double solidMass, const std::optional<double>& target,
                                   const Weights& weights, double grams);

/// The goal that the user asks for, of a body with the outer surface `outer` (n×3, working frame;
/// the workpiece's own vertices unless they have moved).
/// \throw InvalidInput when there is no such goal
std::unique_ptr<Goal> makeGoal(const Options& options, const PosedModel& posed,
                               const Points& outer);

/// Density of what the goal takes for the cavity's filling, as a multiple of the material's: 0 for
/// Stand empty and filled, which adds the filling by itself.
double fillingSeenBy(const Options& options);

/// Largest |equality| or positive inequality.
double largestViolation(const Goal& goal, const Moments& massMoments);

} // namespace massprops
