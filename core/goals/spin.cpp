#include "core/goals/spin.h"

#include "core/base/angles.h"
#include "core/base/symmetric_eigen.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace massprops {
namespace {

/// Verdict: wobble that a hand-spun top does not show.
constexpr double kSteadyTilt = 0.5;    // degrees
constexpr double kSteadyOffset = 1e-3; // of the diagonal
constexpr double kStableRatio = 1.0;

class SpinGoal final : public Goal {
public:
  SpinGoal(const Moments& solidMassMoments, const Weights& weights, Vec2 axis)
      : solidMass_(solidMassMoments[0]),
        solidInertia_(massProperties(solidMassMoments).inertiaTensor(2, 2)), weights_(weights),
        axis_(std::move(axis)) {}

  GoalValue objective(const Moments& massMoments) const override {
    const MassProperties body = massProperties(massMoments);
    const MassPropertyGradients gradients = massPropertyGradients(body);
    const Mat3& I = body.inertiaTensor;
    GoalValue f;
    // (m/m_solid) c_z = S_z/m_solid
    const double weight = weights_.centerOfMass / solidMass_;
    f.value = weight * massMoments[3];
    f.gradient[3] = weight;
    // The moments in the horizontal plane: I_a² + I_b² = I_xx² + I_yy² + 2 I_xy²
    const double plane = I(0, 0) * I(0, 0) + I(1, 1) * I(1, 1) + 2.0 * I(0, 1) * I(0, 1);
    const double axial = I(2, 2);
    f.value += weights_.inertia * plane / (axial * axial);
    f.gradient +=
        weights_.inertia * ((2.0 * I(0, 0) * gradients.inertiaTensor.row(0) +
                             2.0 * I(1, 1) * gradients.inertiaTensor.row(1) +
                             4.0 * I(0, 1) * gradients.inertiaTensor.row(3)) /
                                (axial * axial) -
                            2.0 * plane / (axial * axial * axial) * gradients.inertiaTensor.row(2));
    return f;
  }

  GoalConstraints equalities(const Moments& massMoments) const override {
    const MassProperties body = massProperties(massMoments);
    const MassPropertyGradients gradients = massPropertyGradients(body);
    GoalConstraints h;
    h.values.resize(4);
    h.gradients.resize(4, 10);
    h.values << body.centerOfMass.head<2>() - axis_, body.inertiaTensor(0, 2) / solidInertia_,
        body.inertiaTensor(1, 2) / solidInertia_;
    h.gradients.topRows<2>() = gradients.centerOfMass.topRows<2>();
    h.gradients.row(2) = gradients.inertiaTensor.row(5) / solidInertia_;
    h.gradients.row(3) = gradients.inertiaTensor.row(4) / solidInertia_;
    return h;
  }

  GoalConstraints inequalities(const Moments& massMoments) const override {
    const MassProperties body = massProperties(massMoments);
    GoalConstraints g;
    g.values = Vector::Constant(1, -body.centerOfMass.z());
    g.gradients = -massPropertyGradients(body).centerOfMass.row(2);
    return g;
  }

  bool usesInertia() const override { return true; }

private:
  double solidMass_;
  double solidInertia_;
  Weights weights_;
  Vec2 axis_;
};

class SpinVerdict final : public Verdict {
public:
  SpinVerdict(const Moments& solidMassMoments, const Vec2& axis, double lengthUnit)
      : goal_(solidMassMoments, {}, axis), axis_(axis), lengthUnit_(lengthUnit) {}

  bool isReached(const Moments& massMoments) const override {
    const Motion v = motion(massMoments);
    return v.offset < kSteadyOffset && v.tilt < kSteadyTilt && v.isStable();
  }

  std::string worstViolation(const Moments& massMoments) const override {
    const Vector values = goal_.equalities(massMoments).values;
    const double below = goal_.inequalities(massMoments).values[0];
    return below > values.cwiseAbs().maxCoeff()
               ? "the centre of mass lies " + toString(below * lengthUnit_) +
                     " below the end of the axis on the ground"
               : axisViolation(values, lengthUnit_);
  }

  std::string whatIsMissed(const Moments& massMoments) const override {
    const Motion v = motion(massMoments);
    if (v.offset >= kSteadyOffset) return offAxis(v.offset * lengthUnit_);
    if (!v.isStable()) {
      return "it has its middle moment of inertia about the axis, about which no body spins "
             "steadily (I_zz/I_a = " +
             toString(v.ratioA) + ", I_zz/I_b = " + toString(v.ratioB) + ")";
    }
    return "the principal axis of inertia leans by " + toString(v.tilt) + "\u00b0";
  }

  void describe(const Moments& massMoments, const std::string& suffix,
                Report& report) const override {
    const Motion v = motion(massMoments);
    report.add("axis_offset_" + suffix, v.offset * lengthUnit_);
    report.add("axis_tilt_" + suffix, v.tilt);
    report.add("moment_ratio_a_" + suffix, v.ratioA);
    report.add("moment_ratio_b_" + suffix, v.ratioB);
    report.add("spins_" + suffix, isReached(massMoments));
  }

  std::string draw(const Moments& /*before*/, const Moments& /*after*/,
                   Annotations& annotations) const override {
    const double over = 0.1 * annotations.box().diagonal().norm();
    annotations.addLine({axis_.x(), axis_.y(), annotations.box().min().z() - over},
                        {axis_.x(), axis_.y(), annotations.box().max().z() + over}, kGroundColour);
    return "axis";
  }

  static std::string offAxis(double distance) {
    return "the centre of mass lies " + toString(distance) + " off the axis";
  }

private:
  struct Motion {
    double offset;         ///< of the centre of mass from the axis, working length
    double tilt;           ///< of the principal axis nearest to the vertical, degrees
    double ratioA, ratioB; ///< I_zz/I_a ≤ I_zz/I_b of the horizontal moments I_a ≥ I_b

    bool isStable() const {
      return std::min(ratioA, ratioB) > kStableRatio || std::max(ratioA, ratioB) < kStableRatio;
    }
  };

  Motion motion(const Moments& massMoments) const {
    const MassProperties body = massProperties(massMoments);
    const SymmetricEigen<Mat3> principal = symmetricEigen(body.inertiaTensor);
    double upright = 0.0;
    for (int i = 0; i < 3; ++i) {
      upright = std::max(upright, std::abs(principal.vectors(2, i)));
    }
    const Eigen::Matrix2d horizontalPart = body.inertiaTensor.topLeftCorner<2, 2>();
    const Vec2 horizontal = symmetricEigen(horizontalPart).values;
    const double axial = body.inertiaTensor(2, 2);
    return {(body.centerOfMass.head<2>() - axis_).norm(),
            std::acos(std::min(1.0, upright)) * kDegrees, axial / horizontal[1],
            axial / horizontal[0]};
  }

  SpinGoal goal_;
  Vec2 axis_;
  double lengthUnit_;
};

} // namespace

std::unique_ptr<Goal> makeSpinGoal(const Moments& solidMassMoments, const Weights& weights,
                                   const Vec2& axis) {
  return std::make_unique<SpinGoal>(solidMassMoments, weights, axis);
}

std::unique_ptr<Verdict> makeSpinVerdict(const Moments& solidMassMoments, const Vec2& axis,
                                         double lengthUnit) {
  return std::make_unique<SpinVerdict>(solidMassMoments, axis, lengthUnit);
}

std::string axisViolation(const Eigen::Vector4d& equalities, double lengthUnit) {
  const Vec2 offset = equalities.head<2>();
  const Vec2 products = equalities.tail<2>();
  return offset.cwiseAbs().maxCoeff() >= products.cwiseAbs().maxCoeff()
             ? SpinVerdict::offAxis(offset.norm() * lengthUnit)
             : "the products of inertia I_xz, I_yz reach " + toString(products.norm()) +
                   " of the solid's I_zz";
}

} // namespace massprops
