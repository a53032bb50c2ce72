#include "core/goals/yo_yo.h"

#include "core/goals/spinning_axis.h"
#include "core/goals/upright.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace massprops {
namespace {

class YoYoGoal final : public Goal {
public:
  YoYoGoal(const Moments& solidMassMoments, const Weights& weights, const Vec3& pivot)
      : task_{pivot,
              true,
              solidMassMoments[0],
              massProperties(solidMassMoments).inertiaTensor(2, 2),
              0.0,
              weights.inertia} {}

  GoalValue objective(const Moments& massMoments) const override {
    const GoalValue ratios = inertiaRatios(massMoments);
    return {task_.inertiaWeight * ratios.value, task_.inertiaWeight * ratios.gradient};
  }

  GoalConstraints equalities(const Moments& massMoments) const override {
    const MassProperties body = massProperties(massMoments);
    const GoalConstraints axis =
        axisConstraints(massMoments, task_.point.head<2>(), task_.solidInertia);
    GoalConstraints h{Vector(5), MomentGradients(5, 10)};
    h.values << axis.values, body.centerOfMass.z() - task_.point.z();
    h.gradients << axis.gradients, massPropertyGradients(body).centerOfMass.row(2);
    return h;
  }

  GoalConstraints inequalities(const Moments& massMoments) const override {
    if (isRelaxed_) return {};
    return notTheMiddleMoment(massMoments, TurnsAbout::Centre, task_.solidInertia);
  }

  std::unique_ptr<Goal> relaxed() const override {
    auto goal = std::make_unique<YoYoGoal>(*this);
    goal->isRelaxed_ = true;
    return goal;
  }

  bool usesInertia() const override { return true; }

  std::vector<LinearConditions> conditions() const override { return spinningConditions(task_); }

  const SpinningTask* spinningTask() const override { return &task_; }

private:
  SpinningTask task_;
  bool isRelaxed_ = false; ///< any moment about the axle will do
};

class YoYoVerdict final : public Verdict {
public:
  YoYoVerdict(const Moments& solidMassMoments, const Vec3& pivot, double lengthUnit)
      : goal_(solidMassMoments, {}, pivot), pivot_(pivot), lengthUnit_(lengthUnit) {}

  bool isReached(const Moments& massMoments) const override {
    return spins(spinningAxis(massMoments, pivot_.head<2>())) &&
           std::abs(offMiddle(massMoments)) < kExact;
  }

  std::string worstViolation(const Moments& massMoments) const override {
    const Eigen::Vector4d axis = goal_.equalities(massMoments).values.head<4>();
    const double along = std::abs(offMiddle(massMoments));
    const double between = goal_.inequalities(massMoments).values[0];
    if (between > std::max(along, axisViolation(axis))) {
      return middleMoment(spinningAxis(massMoments, pivot_.head<2>()));
    }
    return along < axisViolation(axis)
               ? axisViolation(axis, lengthUnit_)
               : "the centre of mass lies " + toString(along * lengthUnit_) +
                     " off the middle of the axle";
  }

  double violation(const Moments& massMoments) const override {
    return std::max({axisViolation(goal_.equalities(massMoments).values.head<4>()),
                     std::abs(offMiddle(massMoments)), goal_.inequalities(massMoments).values[0]});
  }

  std::string whatIsMissed(const Moments& massMoments) const override {
    const SpinningAxis axis = spinningAxis(massMoments, pivot_.head<2>());
    if (!axis.isCentred()) return offAxis(axis.offset * lengthUnit_);
    return isStable(axis) ? leaningAxis(axis.tilt) : middleMoment(axis);
  }

  void describe(const Moments& massMoments, const std::string& suffix,
                Report& report) const override {
    const SpinningAxis axis = spinningAxis(massMoments, pivot_.head<2>());
    axis.describe(lengthUnit_, suffix, report);
    report.add("spins_" + suffix, spins(axis));
    report.add("middle_offset_" + suffix, offMiddle(massMoments) * lengthUnit_);
    report.add("sleeps_" + suffix, isReached(massMoments));
  }

  /// The axle, and its middle.
  std::string draw(const Moments& /*before*/, const Moments& /*after*/,
                   Annotations& annotations) const override {
    annotations.addBall(pivot_, kGroundColour);
    drawAxis(pivot_.head<2>(), annotations);
    return "axis";
  }

private:
  static bool isStable(const SpinningAxis& axis) {
    return std::min(axis.ratioA, axis.ratioB) > 1.0 || std::max(axis.ratioA, axis.ratioB) < 1.0;
  }

  static bool spins(const SpinningAxis& axis) {
    return axis.isCentred() && axis.isUpright() && isStable(axis);
  }

  static std::string middleMoment(const SpinningAxis& axis) {
    return std::string(
               isStable(axis)
                   ? "its moment of inertia about the axis is barely the greatest or the least"
                   : "it has its middle moment of inertia about the axis, about which no "
                     "body spins steadily") +
           " (I_zz/I_a = " + toString(axis.ratioA) + ", I_zz/I_b = " + toString(axis.ratioB) + ")";
  }

  double offMiddle(const Moments& massMoments) const {
    return massProperties(massMoments).centerOfMass.z() - pivot_.z();
  }

  YoYoGoal goal_;
  Vec3 pivot_;
  double lengthUnit_;
};

} // namespace

std::unique_ptr<Goal> makeYoYoGoal(const Moments& solidMassMoments, const Weights& weights,
                                   const Vec3& pivot) {
  return std::make_unique<YoYoGoal>(solidMassMoments, weights, pivot);
}

std::unique_ptr<Verdict> makeYoYoVerdict(const Moments& solidMassMoments, const Vec3& pivot,
                                         double lengthUnit) {
  return std::make_unique<YoYoVerdict>(solidMassMoments, pivot, lengthUnit);
}

} // namespace massprops
