#include "core/goals/stand_empty_and_filled.h"

#include "core/goals/stand.h"

#include <utility>

namespace massprops {
namespace {

/// (1 − f) M + f outer for inner = outer − M, M the moments of the empty body.
class Filling {
public:
  Filling(Moments outer, double density) : outer_(std::move(outer)), density_(density) {}
  Moments filled(const Moments& empty) const {
    return (1.0 - density_) * empty + density_ * outer_;
  }
  /// d(filled)/d(empty)
  double slope() const { return 1.0 - density_; }

private:
  Moments outer_;
  double density_;
};

/// Stand, asked of two bodies at once.
class StandEmptyAndFilledGoal final : public Goal {
public:
  StandEmptyAndFilledGoal(std::unique_ptr<Goal> stand, Filling filling)
      : stand_(std::move(stand)), filling_(std::move(filling)) {}

  GoalValue objective(const Moments& massMoments) const override {
    const GoalValue empty = stand_->objective(massMoments);
    const GoalValue full = stand_->objective(filling_.filled(massMoments));
    return {empty.value + full.value, empty.gradient + filling_.slope() * full.gradient};
  }

  GoalConstraints equalities(const Moments& /*massMoments*/) const override { return {}; }

  GoalConstraints inequalities(const Moments& massMoments) const override {
    const GoalConstraints empty = stand_->inequalities(massMoments);
    const GoalConstraints full = stand_->inequalities(filling_.filled(massMoments));
    GoalConstraints both{Vector(2 * empty.values.size()),
                         MomentGradients(2 * empty.values.size(), 10)};
    both.values << empty.values, full.values;
    both.gradients << empty.gradients, filling_.slope() * full.gradients;
    return both;
  }

  bool usesInertia() const override { return false; }

private:
  std::unique_ptr<Goal> stand_;
  Filling filling_;
};

class StandEmptyAndFilledVerdict final : public Verdict {
public:
  StandEmptyAndFilledVerdict(std::unique_ptr<Goal> standGoal, std::unique_ptr<Verdict> stand,
                             Filling filling)
      : standGoal_(std::move(standGoal)), stand_(std::move(stand)), filling_(std::move(filling)) {}

  bool isReached(const Moments& massMoments) const override {
    return stand_->isReached(massMoments) && stand_->isReached(filling_.filled(massMoments));
  }

  std::string worstViolation(const Moments& massMoments) const override {
    const Moments full = filling_.filled(massMoments);
    const bool emptyIsWorse =
        largestViolation(*standGoal_, massMoments) >= largestViolation(*standGoal_, full);
    return (emptyIsWorse ? "empty, " : "filled, ") +
           stand_->worstViolation(emptyIsWorse ? massMoments : full);
  }

  void describe(const Moments& massMoments, const std::string& suffix,
                Report& report) const override {
    stand_->describe(massMoments, "empty_" + suffix, report);
    stand_->describe(filling_.filled(massMoments), "filled_" + suffix, report);
  }

  std::string draw(const Moments& before, const Moments& after,
                   Annotations& annotations) const override {
    return stand_->draw(before, after, annotations);
  }

private:
  std::unique_ptr<Goal> standGoal_;
  std::unique_ptr<Verdict> stand_;
  Filling filling_;
};

} // namespace

std::unique_ptr<Goal> makeStandEmptyAndFilledGoal(const ContactArea& area, const Moments& outer,
                                                  double filling, const Weights& weights) {
  return std::make_unique<StandEmptyAndFilledGoal>(makeStandGoal(area, weights),
                                                   Filling(outer, filling));
}

std::unique_ptr<Verdict> makeStandEmptyAndFilledVerdict(const ContactArea& area,
                                                        const Moments& outer, double filling,
                                                        double lengthUnit) {
  return std::make_unique<StandEmptyAndFilledVerdict>(
      makeStandGoal(area, {}), makeStandVerdict(area, lengthUnit), Filling(outer, filling));
}

} // namespace massprops
