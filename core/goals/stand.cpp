#include "core/goals/stand.h"

#include "core/base/angles.h"
#include "core/base/tolerances.h"
#include "core/goals/tipping.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace massprops {
namespace {

/// As hard to tip over as possible.
class StandGoal final : public Goal {
public:
  StandGoal(ContactArea area, const Weights& weights)
      : area_(std::move(area)), directions_(tippingDirections(area_)),
        weight_(weights.centerOfMass) {}

  GoalValue objective(const Moments& massMoments) const override {
    GoalValue f = negativeSmoothTipping(directions_, massMoments);
    f.value *= weight_;
    f.gradient *= weight_;
    return f;
  }

  GoalConstraints equalities(const Moments& /*massMoments*/) const override { return {}; }
  GoalConstraints inequalities(const Moments& /*massMoments*/) const override { return {}; }
  bool usesInertia() const override { return false; }

  std::vector<LinearConditions> conditions() const override {
    return {standingConditions(directions_)};
  }
  std::optional<double> measure(const Moments& massMoments) const override {
    return tippingAngleOf(area_, massMoments);
  }

private:
  ContactArea area_;
  std::vector<TippingDirection> directions_;
  double weight_;
};

/// The least material that stands up to a wanted angle.
class LeastMaterialGoal final : public Goal {
public:
  LeastMaterialGoal(ContactArea area, const Weights& weights, double wantedAngle, double solidMass)
      : area_(std::move(area)), directions_(tippingDirections(area_)), weights_(weights),
        wanted_(std::tan(wantedAngle / kDegrees)), solidMass_(solidMass) {}

  GoalValue objective(const Moments& massMoments) const override {
    GoalValue f;
    f.value = weights_.centerOfMass * massMoments[0] / solidMass_;
    f.gradient[0] = weights_.centerOfMass / solidMass_;
    return f;
  }

  GoalConstraints equalities(const Moments& /*massMoments*/) const override { return {}; }

  /// tan(wanted) ≤ (extent(u) − u·c)/c_z for all directions, and for the one that the body tips
  /// over in: the violation is that of the angle.
  GoalConstraints inequalities(const Moments& massMoments) const override {
    const auto count = static_cast<Eigen::Index>(directions_.size());
    GoalConstraints g{Vector(count + 1), MomentGradients::Zero(count + 1, 10)};
    const Vec3 S = massMoments.segment<3>(1);
    for (Eigen::Index i = 0; i <= count; ++i) {
      const Vec2 u = i < count ? directions_[static_cast<std::size_t>(i)].unit
                               : weakestDirection(area_, S.head<2>() / massMoments[0]);
      const double farthest = extent(area_, u);
      const double beyond = (u.dot(S.head<2>()) - farthest * massMoments[0]) / S.z();
      g.values[i] = wanted_ + beyond;
      g.gradients(i, 0) = -farthest / S.z();
      g.gradients.row(i).segment<2>(1) = u.transpose() / S.z();
      g.gradients(i, 3) = -beyond / S.z();
    }
    return g;
  }

  bool usesInertia() const override { return false; }

  std::vector<LinearConditions> conditions() const override {
    return {standingConditions(directions_)};
  }
  double wantedLevel() const override { return wanted_; }
  std::unique_ptr<Goal> insteadOfConstraints() const override {
    return std::make_unique<StandGoal>(area_, weights_);
  }

private:
  ContactArea area_;
  std::vector<TippingDirection> directions_;
  Weights weights_;
  double wanted_; ///< tangent of the angle
  double solidMass_;
};

class StandVerdict final : public Verdict {
public:
  StandVerdict(ContactArea area, double lengthUnit, double wantedAngle)
      : area_(std::move(area)), lengthUnit_(lengthUnit), wantedAngle_(wantedAngle) {}

  bool isReached(const Moments& massMoments) const override {
    const double angle = tippingAngleOf(area_, massMoments);
    return angle > 0.0 && angle >= wantedAngle_ - kFeasibility * kDegrees;
  }

  std::string worstViolation(const Moments& massMoments) const override {
    const double angle = tippingAngleOf(area_, massMoments);
    if (angle > 0.0 && wantedAngle_ == 0.0) {
      return "the centre of mass lies in the outermost tenth of the contact area, which the "
             "published constraints keep as a margin";
    }
    if (angle > 0.0) {
      return "it tips over at " + toString(angle) + "\u00b0 instead of " + toString(wantedAngle_) +
             "\u00b0";
    }
    const Vec3 c = massProperties(massMoments).centerOfMass;
    return "the centre of mass lies " +
           toString(-signedDistance(area_, c.head<2>()) * lengthUnit_) +
           " outside of the contact area";
  }

  double violation(const Moments& massMoments) const override {
    return wantedAngle_ - tippingAngleOf(area_, massMoments);
  }

  std::string whatIsMissed(const Moments& massMoments) const override {
    return worstViolation(massMoments);
  }

  void describe(const Moments& massMoments, const std::string& suffix,
                Report& report) const override {
    const double angle = tippingAngleOf(area_, massMoments);
    report.add("tip_angle_" + suffix, angle);
    report.add("stands_" + suffix, angle > 0.0);
  }

  std::string bestInWords(const std::vector<Moments>& states) const override {
    double least = tippingAngleOf(area_, states.front());
    for (const Moments& state : states) least = std::min(least, tippingAngleOf(area_, state));
    return "the best possible tipping angle is " + toString(least) + "\u00b0";
  }

  /// The contact area, and the centres of mass plumb above or beside it.
  std::string draw(const Moments& before, const Moments& after,
                   Annotations& annotations) const override {
    std::vector<Vec3> corners;
    for (const Vec2& p : outline(area_)) corners.emplace_back(p.x(), p.y(), 0.0);
    annotations.addLoop(corners, kGroundColour);
    const auto addPlumbLine = [&](const Moments& body, Colour colour) {
      const Vec3 c = massProperties(body).centerOfMass;
      annotations.addLine(c, {c.x(), c.y(), 0.0}, colour);
    };
    addPlumbLine(before, kBeforeColour);
    addPlumbLine(after, kAfterColour);
    return "contact area";
  }

private:
  ContactArea area_;
  double lengthUnit_;
  double wantedAngle_;
};

} // namespace

std::unique_ptr<Goal> makeStandGoal(const ContactArea& area, const Weights& weights,
                                    double wantedAngle, double solidMass) {
  if (wantedAngle <= 0.0) return std::make_unique<StandGoal>(area, weights);
  return std::make_unique<LeastMaterialGoal>(area, weights, wantedAngle, solidMass);
}

std::unique_ptr<Verdict> makeStandVerdict(const ContactArea& area, double lengthUnit,
                                          double wantedAngle) {
  return std::make_unique<StandVerdict>(area, lengthUnit, wantedAngle);
}

} // namespace massprops
