#include "core/goals/goals.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <utility>

namespace massprops {
namespace {

constexpr double kDegrees = 180.0 / 3.14159265358979323846;
/// Verdict: wobble that a hand-spun top does not show.
constexpr double kSteadyTilt = 0.5;    // degrees
constexpr double kSteadyOffset = 1e-3; // of the diagonal
constexpr double kStableRatio = 1.0;

class SpinGoal final : public Goal {
public:
  SpinGoal(const Moments& solidMassMoments, const Weights& weights, double lengthUnit, Vec3 pivot)
      : solidMass_(solidMassMoments[0]),
        solidInertia_(massProperties(solidMassMoments).inertiaTensor(2, 2)), weights_(weights),
        lengthUnit_(lengthUnit), pivot_(std::move(pivot)) {}

  GoalValue objective(const Moments& massMoments) const override {
    const MassProperties body = massProperties(massMoments);
    const MassPropertyGradients gradients = massPropertyGradients(body);
    const Mat3& I = body.inertiaTensor;
    GoalValue f;
    // (m/m_solid) (c_z − p_z) = (S_z − m p_z)/m_solid
    const double weight = weights_.centerOfMass / solidMass_;
    f.value = weight * (massMoments[3] - massMoments[0] * pivot_.z());
    f.gradient[0] = -weight * pivot_.z();
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
    h.values << (body.centerOfMass - pivot_).head<2>(), body.inertiaTensor(0, 2) / solidInertia_,
        body.inertiaTensor(1, 2) / solidInertia_;
    h.gradients.topRows<2>() = gradients.centerOfMass.topRows<2>();
    h.gradients.row(2) = gradients.inertiaTensor.row(5) / solidInertia_;
    h.gradients.row(3) = gradients.inertiaTensor.row(4) / solidInertia_;
    return h;
  }

  GoalConstraints inequalities(const Moments& massMoments) const override {
    const MassProperties body = massProperties(massMoments);
    GoalConstraints g;
    g.values = Vector::Constant(1, pivot_.z() - body.centerOfMass.z());
    g.gradients = -massPropertyGradients(body).centerOfMass.row(2);
    return g;
  }

  bool usesInertia() const override { return true; }

  bool isReached(const Moments& massMoments) const override {
    const Verdict v = verdict(massMoments);
    const bool largest = std::min(v.ratioA, v.ratioB) > kStableRatio;
    const bool smallest = std::max(v.ratioA, v.ratioB) < kStableRatio;
    return v.offset < kSteadyOffset && v.tilt < kSteadyTilt && (largest || smallest);
  }

  std::string worstViolation(const Moments& massMoments) const override {
    const Vector values = equalities(massMoments).values;
    const double offAxis = values.head<2>().norm();
    const double product = values.tail<2>().norm();
    return offAxis >= product
               ? "the centre of mass lies " + toString(offAxis * lengthUnit_) + " off the axis"
               : "the products of inertia I_xz, I_yz reach " + toString(product) +
                     " of the solid's I_zz";
  }

  void describe(const Moments& massMoments, const std::string& suffix,
                Report& report) const override {
    const Verdict v = verdict(massMoments);
    report.add("axis_offset_" + suffix, v.offset * lengthUnit_);
    report.add("axis_tilt_" + suffix, v.tilt);
    report.add("moment_ratio_a_" + suffix, v.ratioA);
    report.add("moment_ratio_b_" + suffix, v.ratioB);
    report.add("spins_" + suffix, isReached(massMoments));
  }

  std::string draw(const Moments& /*before*/, const Moments& /*after*/,
                   Annotations& annotations) const override {
    const double over = 0.1 * annotations.box().diagonal().norm();
    annotations.addLine({pivot_.x(), pivot_.y(), annotations.box().min().z() - over},
                        {pivot_.x(), pivot_.y(), annotations.box().max().z() + over},
                        kGroundColour);
    return "axis";
  }

private:
  struct Verdict {
    double offset;         ///< of the centre of mass from the axis, working length
    double tilt;           ///< of the principal axis nearest to the vertical, degrees
    double ratioA, ratioB; ///< I_zz/I_a ≤ I_zz/I_b of the horizontal moments I_a ≥ I_b
  };

  Verdict verdict(const Moments& massMoments) const {
    const MassProperties body = massProperties(massMoments);
    const Eigen::SelfAdjointEigenSolver<Mat3> principal(body.inertiaTensor);
    double upright = 0.0;
    for (int i = 0; i < 3; ++i) {
      upright = std::max(upright, std::abs(principal.eigenvectors()(2, i)));
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> horizontal(
        body.inertiaTensor.topLeftCorner<2, 2>());
    const double axial = body.inertiaTensor(2, 2);
    return {(body.centerOfMass - pivot_).head<2>().norm(),
            std::acos(std::min(1.0, upright)) * kDegrees, axial / horizontal.eigenvalues()[1],
            axial / horizontal.eigenvalues()[0]};
  }

  double solidMass_;
  double solidInertia_;
  Weights weights_;
  double lengthUnit_;
  Vec3 pivot_;
};

} // namespace

std::unique_ptr<Goal> makeSpinGoal(const Moments& solidMassMoments, const Weights& weights,
                                   double lengthUnit, const Vec3& pivot) {
  return std::make_unique<SpinGoal>(solidMassMoments, weights, lengthUnit, pivot);
}

} // namespace massprops
