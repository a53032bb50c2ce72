#include "core/goals/hang.h"

#include "core/base/angles.h"
#include "core/goals/upright.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace massprops {
namespace {

/// The centre of mass hangs at least this deep below the point, in diagonals: nearer to it the
/// smallest flaw of the print turns the body.
constexpr double kLeastDepth = 0.01;

class HangGoal final : public Goal {
public:
  HangGoal(Vec3 suspension, const Weights& weights)
      : suspension_(std::move(suspension)), weight_(weights.centerOfMass) {}

  GoalValue objective(const Moments& massMoments) const override {
    const MassProperties body = massProperties(massMoments);
    const Vec3 c = body.centerOfMass - suspension_;
    GoalValue f;
    f.value = weight_ * (c.x() * c.x() + c.y() * c.y() + c.z());
    f.gradient = weight_ * Eigen::RowVector3d(2.0 * c.x(), 2.0 * c.y(), 1.0) *
                 massPropertyGradients(body).centerOfMass;
    return f;
  }

  GoalConstraints equalities(const Moments& massMoments) const override {
    const MassProperties body = massProperties(massMoments);
    return {(body.centerOfMass - suspension_).head<2>(),
            massPropertyGradients(body).centerOfMass.topRows<2>()};
  }

  GoalConstraints inequalities(const Moments& massMoments) const override {
    const MassProperties body = massProperties(massMoments);
    return {Vector::Constant(1, body.centerOfMass.z() - suspension_.z() + kLeastDepth),
            massPropertyGradients(body).centerOfMass.row(2)};
  }

  bool usesInertia() const override { return false; }

  /// S_x − p_x m = 0, S_y − p_y m = 0, S_z − (p_z − depth) m ≤ 0; the level is a length times m.
  std::vector<LinearConditions> conditions() const override {
    AffineRows aside = AffineRows::Zero(2, 11);
    aside.middleCols(1, 2).setIdentity();
    aside.col(0) = -suspension_.head<2>();
    AffineRows tooHigh = AffineRows::Zero(1, 11);
    tooHigh(0, 3) = 1.0;
    tooHigh(0, 0) = kLeastDepth - suspension_.z();
    return {linearConditions(aside, tooHigh, Eigen::Matrix<double, 1, 11>::Unit(0))};
  }

private:
  Vec3 suspension_;
  double weight_;
};

class HangVerdict final : public Verdict {
public:
  HangVerdict(Vec3 suspension, double lengthUnit)
      : suspension_(std::move(suspension)), lengthUnit_(lengthUnit) {}

  bool isReached(const Moments& massMoments) const override {
    return angle(massMoments) < kUpright;
  }

  std::string worstViolation(const Moments& massMoments) const override {
    const Vec3 c = belowPoint(massMoments);
    const double tooHigh = c.z() + kLeastDepth;
    return tooHigh > c.head<2>().norm()
               ? "the centre of mass lies " + toString(tooHigh * lengthUnit_) +
                     " too high under the suspension point"
               : "the centre of mass lies " + toString(c.head<2>().norm() * lengthUnit_) +
                     " off the plumb line of the suspension point";
  }

  double violation(const Moments& massMoments) const override {
    const Vec3 c = belowPoint(massMoments);
    return std::max(c.z() + kLeastDepth, c.head<2>().norm());
  }

  void describe(const Moments& massMoments, const std::string& suffix,
                Report& report) const override {
    report.add("hanging_angle_" + suffix, angle(massMoments));
    report.add("hanging_depth_" + suffix, -belowPoint(massMoments).z() * lengthUnit_);
    report.add("hangs_upright_" + suffix, isReached(massMoments));
  }

  /// The thread from above the suspension point down to the height of the centres of mass.
  std::string draw(const Moments& before, const Moments& after,
                   Annotations& annotations) const override {
    const double over = 0.1 * annotations.box().diagonal().norm();
    const double lowest =
        std::min(massProperties(before).centerOfMass.z(), massProperties(after).centerOfMass.z());
    annotations.addBall(suspension_, kGroundColour);
    annotations.addLine({suspension_.x(), suspension_.y(), lowest},
                        suspension_ + over * Vec3::UnitZ(), kGroundColour);
    return "plumb line";
  }

private:
  /// The centre of mass as seen from the suspension point.
  Vec3 belowPoint(const Moments& massMoments) const {
    return massProperties(massMoments).centerOfMass - suspension_;
  }
  /// By which the body turns until its centre of mass is plumb below the point, degrees.
  double angle(const Moments& massMoments) const {
    const Vec3 c = belowPoint(massMoments);
    return std::atan2(c.head<2>().norm(), -c.z()) * kDegrees;
  }

  Vec3 suspension_;
  double lengthUnit_;
};

} // namespace

std::unique_ptr<Goal> makeHangGoal(const Vec3& suspension, const Weights& weights) {
  return std::make_unique<HangGoal>(suspension, weights);
}

std::unique_ptr<Verdict> makeHangVerdict(const Vec3& suspension, double lengthUnit) {
  return std::make_unique<HangVerdict>(suspension, lengthUnit);
}

} // namespace massprops
