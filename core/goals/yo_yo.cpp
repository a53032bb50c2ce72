#include "core/goals/yo_yo.h"

#include "core/goals/spin.h"

#include <cmath>
#include <utility>

namespace massprops {
namespace {

/// Verdict: a yo-yo whose centre is farther from the string's plane tilts, in diagonals.
constexpr double kCentred = 1e-3;

/// Spin without the height, and with the centre of mass in the middle of the axle.
class YoYoGoal final : public Goal {
public:
  YoYoGoal(const Moments& solidMassMoments, Weights weights, const Vec3& pivot) : pivot_(pivot) {
    weights.centerOfMass = 0.0;
    spin_ = makeSpinGoal(solidMassMoments, weights, pivot.head<2>());
  }

  GoalValue objective(const Moments& massMoments) const override {
    return spin_->objective(massMoments);
  }

  GoalConstraints equalities(const Moments& massMoments) const override {
    const MassProperties body = massProperties(massMoments);
    GoalConstraints h = spin_->equalities(massMoments);
    const Eigen::Index last = h.values.size();
    h.values.conservativeResize(last + 1);
    h.gradients.conservativeResize(last + 1, 10);
    h.values[last] = body.centerOfMass.z() - pivot_.z();
    h.gradients.row(last) = massPropertyGradients(body).centerOfMass.row(2);
    return h;
  }

  GoalConstraints inequalities(const Moments& /*massMoments*/) const override { return {}; }

  bool usesInertia() const override { return true; }

private:
  std::unique_ptr<Goal> spin_;
  Vec3 pivot_;
};

class YoYoVerdict final : public Verdict {
public:
  YoYoVerdict(const Moments& solidMassMoments, const Vec3& pivot, double lengthUnit)
      : goal_(solidMassMoments, {}, pivot),
        spin_(makeSpinVerdict(solidMassMoments, pivot.head<2>(), lengthUnit)), pivot_(pivot),
        lengthUnit_(lengthUnit) {}

  bool isReached(const Moments& massMoments) const override {
    return spin_->isReached(massMoments) && std::abs(offMiddle(massMoments)) < kCentred;
  }

  std::string worstViolation(const Moments& massMoments) const override {
    const double along = std::abs(offMiddle(massMoments));
    return along < largestViolation(goal_, massMoments)
               ? axisViolation(goal_.equalities(massMoments).values.head<4>(), lengthUnit_)
               : "the centre of mass lies " + toString(along * lengthUnit_) +
                     " off the middle of the axle";
  }

  std::string whatIsMissed(const Moments& massMoments) const override {
    return spin_->whatIsMissed(massMoments);
  }

  void describe(const Moments& massMoments, const std::string& suffix,
                Report& report) const override {
    spin_->describe(massMoments, suffix, report);
    report.add("middle_offset_" + suffix, offMiddle(massMoments) * lengthUnit_);
    report.add("sleeps_" + suffix, isReached(massMoments));
  }

  /// The axle, and its middle.
  std::string draw(const Moments& before, const Moments& after,
                   Annotations& annotations) const override {
    annotations.addBall(pivot_, kGroundColour);
    return spin_->draw(before, after, annotations);
  }

private:
  double offMiddle(const Moments& massMoments) const {
    return massProperties(massMoments).centerOfMass.z() - pivot_.z();
  }

  YoYoGoal goal_;
  std::unique_ptr<Verdict> spin_;
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
