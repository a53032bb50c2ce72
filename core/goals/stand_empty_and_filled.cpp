#include "core/goals/stand_empty_and_filled.h"

#include "core/base/angles.h"
#include "core/goals/filling_levels.h"
#include "core/goals/stand.h"
#include "core/goals/tipping.h"
#include "core/model/contact.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace massprops {
namespace {

/// (1 − f) M + f outer for inner = outer − M, M the moments of the empty body.
class Filling {
public:
  Filling(Moments outer, double density) : outer_(std::move(outer)), density_(density) {}
  Moments filled(const Moments& empty) const {
    return (1.0 - density_) * empty + density_ * outer_;
  }
  double density() const { return density_; }
  /// d(filled)/d(empty)
  double slope() const { return 1.0 - density_; }
  /// Functionals of the filled body as such of the empty one.
  AffineRows seenFromEmpty(const AffineRows& ofFilled) const {
    AffineRows rows = ofFilled;
    rows.leftCols<10>() *= slope();
    rows.col(10) += density_ * ofFilled.leftCols<10>() * outer_;
    return rows;
  }

private:
  Moments outer_;
  double density_;
};

/// The smaller of the tipping angles of two bodies at once.
class StandEmptyAndFilledGoal final : public Goal {
public:
  StandEmptyAndFilledGoal(ContactArea area, Filling filling, const Weights& weights)
      : area_(std::move(area)), directions_(tippingDirections(area_)), filling_(std::move(filling)),
        weight_(weights.centerOfMass) {}

  GoalValue objective(const Moments& massMoments) const override {
    const GoalValue empty = negativeSmoothTipping(directions_, massMoments);
    GoalValue full = negativeSmoothTipping(directions_, filling_.filled(massMoments));
    full.gradient *= filling_.slope();
    GoalValue f = smoothMaximum(empty, full);
    f.value *= weight_;
    f.gradient *= weight_;
    return f;
  }

  GoalConstraints equalities(const Moments& /*massMoments*/) const override { return {}; }
  GoalConstraints inequalities(const Moments& /*massMoments*/) const override { return {}; }
  bool usesInertia() const override { return false; }

  std::vector<LinearConditions> conditions() const override {
    const LinearConditions empty = standingConditions(directions_);
    const LinearConditions full{filling_.seenFromEmpty(empty.atZero),
                                filling_.seenFromEmpty(empty.slopes)};
    LinearConditions both{AffineRows(2 * empty.atZero.rows(), 11),
                          AffineRows(2 * empty.atZero.rows(), 11)};
    both.atZero << empty.atZero, full.atZero;
    both.slopes << empty.slopes, full.slopes;
    return {both};
  }

  std::optional<double> measure(const Moments& massMoments) const override {
    const auto angle = [&](const Moments& body) {
      return tippingAngle(area_, massProperties(body).centerOfMass);
    };
    return std::min(angle(massMoments), angle(filling_.filled(massMoments)));
  }

private:
  ContactArea area_;
  std::vector<TippingDirection> directions_;
  Filling filling_;
  double weight_;
};

class StandEmptyAndFilledVerdict final : public Verdict {
public:
  StandEmptyAndFilledVerdict(ContactArea area, double lengthUnit, Filling filling,
                             std::optional<FillingLevels> levels)
      : area_(std::move(area)), stand_(makeStandVerdict(area_, lengthUnit)),
        filling_(std::move(filling)), levels_(std::move(levels)) {}

  bool isReached(const Moments& massMoments) const override {
    return stand_->isReached(massMoments) && stand_->isReached(filling_.filled(massMoments)) &&
           (!levels_ || leastAngle(massMoments) > 0.0);
  }

  std::string whatIsMissed(const Moments& massMoments) const override {
    const bool standsAtEnds =
        stand_->isReached(massMoments) && stand_->isReached(filling_.filled(massMoments));
    return standsAtEnds && levels_
               ? "it may fall over while it is filled, its tipping angle being " +
                     toString(leastAngle(massMoments)) + "\u00b0 at the worst level"
               : worstViolation(massMoments);
  }

  std::string worstViolation(const Moments& massMoments) const override {
    const Moments full = filling_.filled(massMoments);
    const auto angle = [&](const Moments& body) {
      return tippingAngle(area_, massProperties(body).centerOfMass);
    };
    const bool emptyIsWorse = angle(massMoments) <= angle(full);
    return (emptyIsWorse ? "empty, " : "filled, ") +
           stand_->worstViolation(emptyIsWorse ? massMoments : full);
  }

  void describe(const Moments& massMoments, const std::string& suffix,
                Report& report) const override {
    stand_->describe(massMoments, "empty_" + suffix, report);
    stand_->describe(filling_.filled(massMoments), "filled_" + suffix, report);
    if (!levels_) return;
    report.add("tip_angle_filling_" + suffix, leastAngle(massMoments));
    report.add("stands_filling_" + suffix, leastAngle(massMoments) > 0.0);
    report.add("filled_as", levels_->cavities() == 1
                                ? std::string("one cavity")
                                : toString(levels_->cavities()) + " cavities, each by itself");
  }

  std::string draw(const Moments& before, const Moments& after,
                   Annotations& annotations) const override {
    return stand_->draw(before, after, annotations);
  }

private:
  /// Over all levels of the contents.
  double leastAngle(const Moments& empty) const {
    return std::atan(levels_->leastTangent(tippingDirections(area_), empty, filling_.density())) *
           kDegrees;
  }

  ContactArea area_;
  std::unique_ptr<Verdict> stand_;
  Filling filling_;
  std::optional<FillingLevels> levels_; ///< of a body that has cavities
};

} // namespace

std::unique_ptr<Goal> makeStandEmptyAndFilledGoal(const ContactArea& area, const Moments& outer,
                                                  double filling, const Weights& weights) {
  return std::make_unique<StandEmptyAndFilledGoal>(area, Filling(outer, filling), weights);
}

std::unique_ptr<Verdict> makeStandEmptyAndFilledVerdict(const ContactArea& area,
                                                        const Moments& outer, double filling,
                                                        double lengthUnit,
                                                        const TriangleMesh* cavity) {
  std::optional<FillingLevels> levels;
  if (cavity != nullptr) levels.emplace(cavity->vertices, cavity->faces);
  return std::make_unique<StandEmptyAndFilledVerdict>(area, lengthUnit, Filling(outer, filling),
                                                      std::move(levels));
}

} // namespace massprops
