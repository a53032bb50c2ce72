// A body that spins about a vertical axis: what Spin and Yo-yo have in common.
#pragma once

#include "core/base/report.h"
#include "core/goals/goal.h"
#include "core/mesh/annotations.h"

#include <string>
#include <vector>

namespace massprops {

/// (I_a² + I_b²)/I_zz² of the moments about the centre of mass, I_a and I_b the horizontal
/// principal ones. [BWBSH14, Sec. 4]
GoalValue inertiaRatios(const Moments& massMoments);

/// Four: the centre of mass on the vertical through `axis`, working lengths, and I_xz and I_yz in
/// shares of `solidInertia`, the solid's I_zz.
GoalConstraints axisConstraints(const Moments& massMoments, const Vec2& axis, double solidInertia);

/// What the body turns about: its centre of mass, or the tip on the ground below that.
enum class TurnsAbout { Centre, Tip };

/// What the product of the differences between the moment about the vertical and the two across it
/// shall exceed, in squares of the solid's I_zz: with a product of 0 rounding decides what spins.
constexpr double kOffTheMiddle = 1e-4;

/// One, ≤ 0: the moment about the vertical is not between the two across, nor next to one of them,
/// in squares of `solidInertia`. docs/math.md "Spin"
GoalConstraints notTheMiddleMoment(const Moments& massMoments, TurnsAbout point,
                                   double solidInertia);

/// A body is to turn about the vertical through a point, at a low objective
/// staticWeight S_z/solidMass + inertiaWeight (I_a² + I_b²)/I_zz².
struct SpinningTask {
  Vec3 point;     ///< of the axis, about which the body turns: the tip, or the middle of an axle
  bool isCentred; ///< whether the centre of mass must be there, too, besides on the axis
  double solidMass, solidInertia; ///< the latter about the vertical
  double staticWeight, inertiaWeight;
};

/// Functionals of the moments that are 0, in shares of the solid's mass and I_zz, exactly if the
/// centre of mass is where it must be and the axis a principal one: 4, or 5 where it is centred.
AffineRows axisEqualities(const SpinningTask& task);

/// What `axisConstraints` and `notTheMiddleMoment` ask for, in shares of the solid's mass and I_zz,
/// with the centre of mass on the axis: linear then, but in two branches, the moment about the
/// vertical being the greatest or the least. docs/math.md "Spin"
std::vector<LinearConditions> spinningConditions(const SpinningTask& task);

/// How a body lies about its axis.
struct SpinningAxis {
  double offset;         ///< of the centre of mass from the axis, working length
  double tilt;           ///< of the principal axis nearest to the vertical, degrees
  double ratioA, ratioB; ///< I_zz/I_a ≤ I_zz/I_b of the horizontal moments I_a ≥ I_b

  bool isCentred() const;
  bool isUpright() const;
  void describe(double lengthUnit, const std::string& suffix, Report& report) const;
};

SpinningAxis spinningAxis(const Moments& massMoments, const Vec2& axis);

/// The greater one of the four `axisConstraints`: the centre's offset, or the length of the two
/// products of inertia.
double axisViolation(const Eigen::Vector4d& axisConstraints);

/// The same in words.
std::string axisViolation(const Eigen::Vector4d& axisConstraints, double lengthUnit);

/// `distance`: in the model's units.
std::string offAxis(double distance);

/// `tilt`: in degrees.
std::string leaningAxis(double tilt);

void drawAxis(const Vec2& axis, Annotations& annotations);

} // namespace massprops
