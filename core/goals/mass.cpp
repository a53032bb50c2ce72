#include "core/goals/mass.h"

#include "core/goals/upright.h"

#include <cmath>
#include <vector>

namespace massprops {
namespace {

class MassGoal final : public Goal {
public:
  MassGoal(double solidMass, const std::optional<double>& target, const Weights& weights)
      : solidMass_(solidMass), target_(target), weight_(weights.centerOfMass) {}

  GoalValue objective(const Moments& massMoments) const override {
    const double excess = (massMoments[0] - target_.value_or(0.0)) / solidMass_;
    GoalValue f;
    f.value = weight_ * excess * excess;
    f.gradient[0] = 2.0 * weight_ * excess / solidMass_;
    return f;
  }

  GoalConstraints equalities(const Moments& massMoments) const override {
    if (!target_) return {};
    GoalConstraints h{Vector::Constant(1, (massMoments[0] - *target_) / solidMass_),
                      MomentGradients::Zero(1, 10)};
    h.gradients(0, 0) = 1.0 / solidMass_;
    return h;
  }

  GoalConstraints inequalities(const Moments& /*massMoments*/) const override { return {}; }

  bool usesInertia() const override { return false; }

  /// The level is a share of the solid's mass.
  std::vector<LinearConditions> conditions() const override {
    if (!target_) return {};
    AffineRows excess = AffineRows::Zero(1, 11);
    excess(0, 0) = 1.0 / solidMass_;
    excess(0, 10) = -*target_ / solidMass_;
    return {linearConditions(excess, AffineRows(0, 11), Eigen::Matrix<double, 1, 11>::Unit(10))};
  }

  /// Without a target: as light as possible.
  std::optional<double> measure(const Moments& massMoments) const override {
    if (target_) return std::nullopt;
    return -massMoments[0] / solidMass_;
  }

  std::optional<double> wantedMass() const override { return target_; }

private:
  double solidMass_;
  std::optional<double> target_;
  double weight_;
};

class MassVerdict final : public Verdict {
public:
  MassVerdict(const std::optional<double>& target, double grams) : target_(target), grams_(grams) {}

  bool isReached(const Moments& massMoments) const override {
    return !target_ || std::abs(massMoments[0] - *target_) <= kExact * *target_;
  }

  std::string worstViolation(const Moments& massMoments) const override {
    const double excess = (massMoments[0] - target_.value_or(0.0)) * grams_;
    return "the mass is " + toString(std::abs(excess)) + " g too " +
           (excess > 0.0 ? "large" : "small");
  }

  double violation(const Moments& massMoments) const override {
    return target_ ? std::abs(massMoments[0] - *target_) : 0.0;
  }

  void describe(const Moments& massMoments, const std::string& suffix,
                Report& report) const override {
    if (!target_) return;
    report.add("mass_error_" + suffix, (massMoments[0] - *target_) * grams_);
    report.add("weighs_target_" + suffix, isReached(massMoments));
  }

private:
  std::optional<double> target_;
  double grams_;
};

} // namespace

std::unique_ptr<Goal> makeMassGoal(double solidMass, const std::optional<double>& target,
                                   const Weights& weights) {
  return std::make_unique<MassGoal>(solidMass, target, weights);
}

std::unique_ptr<Verdict> makeMassVerdict(const std::optional<double>& target, double grams) {
  return std::make_unique<MassVerdict>(target, grams);
}

} // namespace massprops
