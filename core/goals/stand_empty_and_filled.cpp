#include "core/goals/goals.h"

#include <utility>

namespace massprops {
namespace {

/// Stand, asked of two bodies at once: M with the cavity empty and (1 − f) M + f outer with it
/// filled, for inner = outer − M.
class StandEmptyAndFilledGoal final : public Goal {
public:
  StandEmptyAndFilledGoal(const ContactArea& area, Moments outer, double filling,
                          const Weights& weights, double lengthUnit)
      : stand_(makeStandGoal(area, weights, lengthUnit)), outer_(std::move(outer)),
        filling_(filling) {}

  GoalValue objective(const Moments& massMoments) const override {
    const GoalValue empty = stand_->objective(massMoments);
    const GoalValue full = stand_->objective(filled(massMoments));
    return {empty.value + full.value, empty.gradient + (1.0 - filling_) * full.gradient};
  }

  GoalConstraints equalities(const Moments& /*massMoments*/) const override { return {}; }

  GoalConstraints inequalities(const Moments& massMoments) const override {
    const GoalConstraints empty = stand_->inequalities(massMoments);
    const GoalConstraints full = stand_->inequalities(filled(massMoments));
    GoalConstraints both{Vector(2 * empty.values.size()),
                         MomentGradients(2 * empty.values.size(), 10)};
    both.values << empty.values, full.values;
    both.gradients << empty.gradients, (1.0 - filling_) * full.gradients;
    return both;
  }

  bool usesInertia() const override { return false; }

  bool isReached(const Moments& massMoments) const override {
    return stand_->isReached(massMoments) && stand_->isReached(filled(massMoments));
  }

  std::string worstViolation(const Moments& massMoments) const override {
    const Moments full = filled(massMoments);
    const bool emptyIsWorse =
        largestViolation(*stand_, massMoments) >= largestViolation(*stand_, full);
    return (emptyIsWorse ? "empty, " : "filled, ") +
           stand_->worstViolation(emptyIsWorse ? massMoments : full);
  }

  void describe(const Moments& massMoments, const std::string& suffix,
                Report& report) const override {
    stand_->describe(massMoments, "empty_" + suffix, report);
    stand_->describe(filled(massMoments), "filled_" + suffix, report);
  }

  std::string draw(const Moments& before, const Moments& after,
                   Annotations& annotations) const override {
    return stand_->draw(before, after, annotations);
  }

private:
  Moments filled(const Moments& empty) const {
    return (1.0 - filling_) * empty + filling_ * outer_;
  }

  std::unique_ptr<Goal> stand_;
  Moments outer_;
  double filling_;
};

} // namespace

std::unique_ptr<Goal> makeStandEmptyAndFilledGoal(const ContactArea& area, const Moments& outer,
                                                  double filling, const Weights& weights,
                                                  double lengthUnit) {
  return std::make_unique<StandEmptyAndFilledGoal>(area, outer, filling, weights, lengthUnit);
}

} // namespace massprops
