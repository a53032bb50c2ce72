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

/// The moments of the filled body from those of the empty one.
class Filled {
public:
  Filled(Moments outer, double density) : outer_(std::move(outer)), density_(density) {}
  Moments operator()(const Moments& empty) const {
    return (1.0 - density_) * empty + density_ * outer_;
  }
  double density() const { return density_; }

private:
  Moments outer_;
  double density_;
};

class StandEmptyAndFilledVerdict final : public Verdict {
public:
  StandEmptyAndFilledVerdict(ContactArea area, double lengthUnit, Filled filled,
                             std::optional<FillingLevels> levels)
      : area_(std::move(area)), directions_(tippingDirections(area_)),
        stand_(makeStandVerdict(area_, lengthUnit)), filled_(std::move(filled)),
        levels_(std::move(levels)) {}

  bool isReached(const Moments& massMoments) const override {
    return stand_->isReached(massMoments) && stand_->isReached(filled_(massMoments)) &&
           (!levels_ || levels_->stands(directions_, massMoments, filled_.density(), 0.0));
  }

  std::string whatIsMissed(const Moments& massMoments) const override {
    const bool standsAtEnds =
        stand_->isReached(massMoments) && stand_->isReached(filled_(massMoments));
    return standsAtEnds && levels_
               ? "it may fall over while it is filled, its tipping angle being " +
                     toString(leastAngle(massMoments)) + "\u00b0 at the worst level"
               : worstViolation(massMoments);
  }

  std::string worstViolation(const Moments& massMoments) const override {
    const Moments full = filled_(massMoments);
    const bool emptyIsWorse = tippingAngleOf(area_, massMoments) <= tippingAngleOf(area_, full);
    return (emptyIsWorse ? "empty, " : "filled, ") +
           stand_->worstViolation(emptyIsWorse ? massMoments : full);
  }

  void describe(const Moments& massMoments, const std::string& suffix,
                Report& report) const override {
    stand_->describe(massMoments, "empty_" + suffix, report);
    stand_->describe(filled_(massMoments), "filled_" + suffix, report);
    if (!levels_) return;
    describeWorst(leastAngle(massMoments), suffix, report);
    report.add("filled_as", levels_->cavities() == 1
                                ? std::string("one cavity")
                                : toString(levels_->cavities()) + " cavities, each by itself");
  }

  void describeWorst(double angle, const std::string& suffix, Report& report) const override {
    report.add("tip_angle_filling_" + suffix, angle);
    report.add("stands_filling_" + suffix, angle > 0.0);
  }

  std::optional<double> worstMeasure(const Moments& massMoments) const override {
    return levels_ ? leastAngle(massMoments)
                   : std::min(tippingAngleOf(area_, massMoments),
                              tippingAngleOf(area_, filled_(massMoments)));
  }

  std::string bestInWords(const std::vector<Moments>& states) const override {
    return stand_->bestInWords(states) + " at the worst level of its contents";
  }

  std::string draw(const Moments& before, const Moments& after,
                   Annotations& annotations) const override {
    return stand_->draw(before, after, annotations);
  }

private:
  /// Over all levels of the contents.
  double leastAngle(const Moments& empty) const {
    return std::atan(levels_->leastTangent(directions_, empty, filled_.density())) * kDegrees;
  }

  ContactArea area_;
  std::vector<TippingDirection> directions_;
  std::unique_ptr<Verdict> stand_;
  Filled filled_;
  std::optional<FillingLevels> levels_; ///< of a body that has cavities
};

} // namespace

std::unique_ptr<Verdict> makeStandEmptyAndFilledVerdict(const ContactArea& area,
                                                        const Moments& outer, double filling,
                                                        double lengthUnit,
                                                        const TriangleMesh* cavity) {
  std::optional<FillingLevels> levels;
  if (cavity != nullptr) levels.emplace(cavity->vertices, cavity->faces);
  return std::make_unique<StandEmptyAndFilledVerdict>(area, lengthUnit, Filled(outer, filling),
                                                      std::move(levels));
}

} // namespace massprops
