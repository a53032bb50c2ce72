#include "core/goals/spin.h"

#include "core/base/angles.h"
#include "core/base/symmetric_eigen.h"
#include "core/goals/spinning_axis.h"
#include "core/physics/sleeping_top.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace massprops {
namespace {

constexpr double kGravity = 9806.65; // mm/s²
constexpr double kTurnsPerMinute = 60.0 / (2.0 * kPi);

class SpinGoal final : public Goal {
public:
  SpinGoal(const Moments& solidMassMoments, const Weights& weights, const Vec2& axis)
      : task_{{axis.x(), axis.y(), 0.0}, false,
              solidMassMoments[0],       massProperties(solidMassMoments).inertiaTensor(2, 2),
              weights.centerOfMass,      weights.inertia} {}

  GoalValue objective(const Moments& massMoments) const override {
    const GoalValue ratios = inertiaRatios(massMoments);
    // (m/m_solid) c_z = S_z/m_solid
    const double weight = task_.staticWeight / task_.solidMass;
    GoalValue f{task_.inertiaWeight * ratios.value + weight * massMoments[3],
                task_.inertiaWeight * ratios.gradient};
    f.gradient[3] += weight;
    return f;
  }

  GoalConstraints equalities(const Moments& massMoments) const override {
    return axisConstraints(massMoments, task_.point.head<2>(), task_.solidInertia);
  }

  GoalConstraints inequalities(const Moments& massMoments) const override {
    const MassProperties body = massProperties(massMoments);
    GoalConstraints height{Vector::Constant(1, -body.centerOfMass.z()),
                           -massPropertyGradients(body).centerOfMass.row(2)};
    if (isRelaxed_) return height;
    const GoalConstraints moment =
        notTheMiddleMoment(massMoments, TurnsAbout::Tip, task_.solidInertia);
    GoalConstraints g{Vector(2), MomentGradients(2, 10)};
    g.values << height.values, moment.values;
    g.gradients << height.gradients, moment.gradients;
    return g;
  }

  std::unique_ptr<Goal> relaxed() const override {
    auto goal = std::make_unique<SpinGoal>(*this);
    goal->isRelaxed_ = true;
    return goal;
  }

  bool usesInertia() const override { return true; }

  std::vector<LinearConditions> conditions() const override { return spinningConditions(task_); }

  const SpinningTask* spinningTask() const override { return &task_; }

private:
  SpinningTask task_;
  bool isRelaxed_ = false; ///< any moment about the axis will do
};

/// The body on its tip, the axis taken as a principal one through the centre of mass. In working
/// units but for the second, gravity being that of millimetres.
Top topOf(const Moments& massMoments, double lengthUnit) {
  const MassProperties body = massProperties(massMoments);
  const double height = body.centerOfMass.z();
  const double shift = body.mass * height * height;
  const Eigen::Matrix2d horizontalPart = body.inertiaTensor.topLeftCorner<2, 2>();
  const Vec2 horizontal = symmetricEigen(horizontalPart).values;
  return {horizontal[1] + shift, horizontal[0] + shift, body.inertiaTensor(2, 2),
          body.mass * kGravity / lengthUnit * height};
}

class SpinVerdict final : public Verdict {
public:
  SpinVerdict(const Moments& solidMassMoments, const Vec2& axis, double lengthUnit,
              double handSpeed)
      : goal_(solidMassMoments, {}, axis), axis_(axis), lengthUnit_(lengthUnit),
        handSpeed_(handSpeed) {}

  bool isReached(const Moments& massMoments) const override {
    const SpinningAxis axis = spinningAxis(massMoments, axis_);
    const auto speed = turnsPerMinute(massMoments);
    return axis.isCentred() && axis.isUpright() && speed && *speed <= handSpeed_;
  }

  std::string worstViolation(const Moments& massMoments) const override {
    const Vector values = goal_.equalities(massMoments).values;
    const Vector beyond = goal_.inequalities(massMoments).values;
    if (beyond.maxCoeff() <= axisViolation(values)) {
      return axisViolation(values, lengthUnit_);
    }
    return beyond[1] > beyond[0] ? middleMoment(massMoments)
                                 : "the centre of mass lies " + toString(beyond[0] * lengthUnit_) +
                                       " below the end of the axis on the ground";
  }

  double violation(const Moments& massMoments) const override {
    return std::max(axisViolation(goal_.equalities(massMoments).values),
                    goal_.inequalities(massMoments).values.maxCoeff());
  }

  std::string whatIsMissed(const Moments& massMoments) const override {
    const SpinningAxis axis = spinningAxis(massMoments, axis_);
    if (!axis.isCentred()) return offAxis(axis.offset * lengthUnit_);
    const auto speed = turnsPerMinute(massMoments);
    if (!speed) return middleMoment(massMoments);
    if (!axis.isUpright()) return leaningAxis(axis.tilt);
    return "it stays upright only above " + wholeNumber(std::ceil(*speed)) +
           " rpm, and a hand gives it " + wholeNumber(handSpeed_) + " (spin_speed)";
  }

  void describe(const Moments& massMoments, const std::string& suffix,
                Report& report) const override {
    spinningAxis(massMoments, axis_).describe(lengthUnit_, suffix, report);
    if (const auto speed = turnsPerMinute(massMoments)) {
      report.add("sleeping_speed_" + suffix, *speed);
    }
    report.add("spins_" + suffix, isReached(massMoments));
  }

  std::string draw(const Moments& /*before*/, const Moments& /*after*/,
                   Annotations& annotations) const override {
    drawAxis(axis_, annotations);
    return "axis";
  }

private:
  std::optional<double> turnsPerMinute(const Moments& massMoments) const {
    const auto speed = sleepingSpeed(topOf(massMoments, lengthUnit_));
    return speed ? std::optional(*speed * kTurnsPerMinute) : std::nullopt;
  }

  std::string middleMoment(const Moments& massMoments) const {
    const Top top = topOf(massMoments, lengthUnit_);
    return std::string(
               turnsPerMinute(massMoments)
                   ? "its moment of inertia about the axis is barely the greatest or the least"
                   : "it has its middle moment of inertia about the axis, so that it falls "
                     "over at every speed") +
           " (on its tip I_zz/A = " + toString(top.axial / top.acrossA) +
           ", I_zz/B = " + toString(top.axial / top.acrossB) + ")";
  }

  static std::string wholeNumber(double value) { return std::to_string(std::llround(value)); }

  SpinGoal goal_;
  Vec2 axis_;
  double lengthUnit_;
  double handSpeed_;
};

} // namespace

std::unique_ptr<Goal> makeSpinGoal(const Moments& solidMassMoments, const Weights& weights,
                                   const Vec2& axis) {
  return std::make_unique<SpinGoal>(solidMassMoments, weights, axis);
}

std::unique_ptr<Verdict> makeSpinVerdict(const Moments& solidMassMoments, const Vec2& axis,
                                         double lengthUnit, double handSpeed) {
  return std::make_unique<SpinVerdict>(solidMassMoments, axis, lengthUnit, handSpeed);
}

} // namespace massprops
