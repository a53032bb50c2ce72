#include "core/goals/spinning_axis.h"

#include "core/base/circle.h"
#include "core/base/symmetric_eigen.h"
#include "core/goals/upright.h"

#include <algorithm>
#include <cmath>

namespace massprops {

GoalValue inertiaRatios(const Moments& massMoments) {
  const MassProperties body = massProperties(massMoments);
  const auto gradient = massPropertyGradients(body).inertiaTensor;
  const Mat3& I = body.inertiaTensor;
  // I_a² + I_b² = I_xx² + I_yy² + 2 I_xy²
  const double plane = I(0, 0) * I(0, 0) + I(1, 1) * I(1, 1) + 2.0 * I(0, 1) * I(0, 1);
  const double axial = I(2, 2);
  GoalValue f;
  f.value = plane / (axial * axial);
  f.gradient = (2.0 * I(0, 0) * gradient.row(0) + 2.0 * I(1, 1) * gradient.row(1) +
                4.0 * I(0, 1) * gradient.row(3)) /
                   (axial * axial) -
               2.0 * plane / (axial * axial * axial) * gradient.row(2);
  return f;
}

GoalConstraints axisConstraints(const Moments& massMoments, const Vec2& axis, double solidInertia) {
  const MassProperties body = massProperties(massMoments);
  const MassPropertyGradients gradients = massPropertyGradients(body);
  GoalConstraints h{Vector(4), MomentGradients(4, 10)};
  h.values << body.centerOfMass.head<2>() - axis, body.inertiaTensor(0, 2) / solidInertia,
      body.inertiaTensor(1, 2) / solidInertia;
  h.gradients.topRows<2>() = gradients.centerOfMass.topRows<2>();
  h.gradients.row(2) = gradients.inertiaTensor.row(5) / solidInertia;
  h.gradients.row(3) = gradients.inertiaTensor.row(4) / solidInertia;
  return h;
}

GoalConstraints notTheMiddleMoment(const Moments& massMoments, TurnsAbout point,
                                   double solidInertia) {
  // −(C − A)(C − B) with A, B the eigenvalues of the tensor's horizontal block: a determinant.
  const MassProperties body = massProperties(massMoments);
  const MassPropertyGradients gradients = massPropertyGradients(body);
  const auto dI = gradients.inertiaTensor;
  const Mat3& I = body.inertiaTensor;
  double shift = 0.0; // m h² = S_z²/m
  Eigen::Matrix<double, 1, 10> dShift = Eigen::Matrix<double, 1, 10>::Zero();
  if (point == TurnsAbout::Tip) {
    const double height = body.centerOfMass.z();
    shift = body.mass * height * height;
    dShift[0] = -height * height;
    dShift[3] = 2.0 * height;
  }
  const double xx = I(2, 2) - I(0, 0) - shift;
  const double yy = I(2, 2) - I(1, 1) - shift;
  const double xy = I(0, 1);
  const double unit = solidInertia * solidInertia;
  GoalConstraints g{Vector(1), MomentGradients(1, 10)};
  g.values[0] = kOffTheMiddle + (xy * xy - xx * yy) / unit;
  g.gradients.row(0) = (2.0 * xy * dI.row(3) - yy * (dI.row(2) - dI.row(0) - dShift) -
                        xx * (dI.row(2) - dI.row(1) - dShift)) /
                       unit;
  return g;
}

bool SpinningAxis::isCentred() const {
  return offset < kExact;
}

bool SpinningAxis::isUpright() const {
  return tilt < kUpright;
}

void SpinningAxis::describe(double lengthUnit, const std::string& suffix, Report& report) const {
  report.add("axis_offset_" + suffix, offset * lengthUnit);
  report.add("axis_tilt_" + suffix, tilt);
  report.add("moment_ratio_a_" + suffix, ratioA);
  report.add("moment_ratio_b_" + suffix, ratioB);
}

AffineRows axisEqualities(const SpinningTask& task) {
  const Vec3& point = task.point;
  // S_x − p_x m, S_y − p_y m, S_z − p_z m; Q_xz − p_x S_z, Q_yz − p_y S_z.
  AffineRows equal = AffineRows::Zero(task.isCentred ? 5 : 4, 11);
  equal.topRows<2>() << -point.x(), 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, //
      -point.y(), 0, 1, 0, 0, 0, 0, 0, 0, 0, 0;
  equal.topRows<2>() /= task.solidMass;
  equal(2, 9) = equal(3, 8) = 1.0 / task.solidInertia;
  equal(2, 3) = -point.x() / task.solidInertia;
  equal(3, 3) = -point.y() / task.solidInertia;
  if (task.isCentred) {
    equal(4, 0) = -point.z() / task.solidMass;
    equal(4, 3) = 1.0 / task.solidMass;
  }
  return equal;
}

std::vector<LinearConditions> spinningConditions(const SpinningTask& task) {
  const Vec3& point = task.point;
  const AffineRows equal = axisEqualities(task);
  // I_zz − I_uu = ∫(x − p)² along u − ∫(z − p_z)² for horizontal directions u.
  AffineRows less = AffineRows::Zero(kAround / 2, 11); // half a turn
  for (int i = 0; i < less.rows(); ++i) {
    const Vec2 u = onCircle(i);
    const double along = u.dot(point.head<2>());
    less.row(i) << along * along - point.z() * point.z(), -2.0 * along * u.x(),
        -2.0 * along * u.y(), 2.0 * point.z(), u.x() * u.x(), u.y() * u.y(), -1.0,
        2.0 * u.x() * u.y(), 0.0, 0.0, 0.0;
  }
  less /= task.solidInertia;
  const AffineRow perLevel = AffineRow::Unit(10);
  return {linearConditions(equal, -less, perLevel), linearConditions(equal, less, perLevel)};
}

SpinningAxis spinningAxis(const Moments& massMoments, const Vec2& axis) {
  const MassProperties body = massProperties(massMoments);
  const SymmetricEigen<Mat3> principal = symmetricEigen(body.inertiaTensor);
  double upright = 0.0;
  for (int i = 0; i < 3; ++i) upright = std::max(upright, std::abs(principal.vectors(2, i)));
  const Eigen::Matrix2d horizontalPart = body.inertiaTensor.topLeftCorner<2, 2>();
  const Vec2 horizontal = symmetricEigen(horizontalPart).values;
  const double axial = body.inertiaTensor(2, 2);
  return {(body.centerOfMass.head<2>() - axis).norm(), std::acos(std::min(1.0, upright)) * kDegrees,
          axial / horizontal[1], axial / horizontal[0]};
}

double axisViolation(const Eigen::Vector4d& axisConstraints) {
  return std::max(axisConstraints.head<2>().norm(), axisConstraints.tail<2>().norm());
}

std::string axisViolation(const Eigen::Vector4d& axisConstraints, double lengthUnit) {
  const double offset = axisConstraints.head<2>().norm();
  const double products = axisConstraints.tail<2>().norm();
  return offset >= products ? offAxis(offset * lengthUnit)
                            : "the products of inertia I_xz, I_yz reach " + toString(products) +
                                  " of the solid's I_zz";
}

std::string offAxis(double distance) {
  return "the centre of mass lies " + toString(distance) + " off the axis";
}

std::string leaningAxis(double tilt) {
  return "the principal axis of inertia leans by " + toString(tilt) + "\u00b0";
}

void drawAxis(const Vec2& axis, Annotations& annotations) {
  const double over = 0.1 * annotations.box().diagonal().norm();
  annotations.addLine({axis.x(), axis.y(), annotations.box().min().z() - over},
                      {axis.x(), axis.y(), annotations.box().max().z() + over}, kGroundColour);
}

} // namespace massprops
