#include "core/goals/float.h"

#include "core/base/angles.h"
#include "core/base/symmetric_eigen.h"
#include "core/base/tolerances.h"
#include "core/goals/upright.h"
#include "core/physics/floating_equilibria.h"
#include "core/physics/hydrostatics.h"
#include "core/physics/righting_lever.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace massprops {
namespace {

/// Verdict: how far the waterline may lie from the wished one.
constexpr double kAtLevel = 0.01; // of the height
/// Poses that only a lower barrier parts, of potential energy over the weight and in diagonals, are
/// one: facets of round bodies are of that kind. In a print of 100 mm it is a micrometre.
constexpr double kBarrier = 1e-5;

/// How the body shall lie in the water; depends on its outer surface only.
struct WishedPose {
  double volume; ///< of the whole body
  double height, draught;
  double displaced; ///< volume below the waterline
  Vec3 buoyancy;    ///< its centroid
  double metacentre;
  bool isSubmerged;
};

WishedPose wishedPose(const Points& outer, const Faces& faces, double waterLevel) {
  const double bottom = outer.col(2).minCoeff();
  WishedPose pose{};
  pose.volume = moments(outer, faces)[0];
  pose.height = outer.col(2).maxCoeff() - bottom;
  pose.draught = waterLevel * pose.height;
  pose.isSubmerged = waterLevel == 1.0;
  const Displacement wished = displacement(outer, faces, Vec3::UnitZ(), bottom + pose.draught);
  // The constraint on the mass does not tell less from nothing.
  if (!(wished.volume > kFeasibility * pose.volume)) {
    throw InvalidInput("Up to water_level = " + toString(waterLevel) +
                       " of its height the model has less than a millionth of its volume, so that "
                       "it would have to weigh next to nothing to float there: raise water_level, "
                       "then run again.");
  }
  pose.displaced = wished.volume;
  pose.buoyancy = wished.centre;
  const Eigen::Matrix2d waterplane = wished.waterplaneMoment.topLeftCorner<2, 2>();
  pose.metacentre = pose.buoyancy.z() + symmetricEigen(waterplane).values[0] / pose.displaced;
  return pose;
}

class FloatGoal final : public Goal {
public:
  FloatGoal(WishedPose wished, double waterDensity, const Weights& weights)
      : wished_(std::move(wished)), waterDensity_(waterDensity), weight_(weights.centerOfMass) {}

  GoalValue objective(const Moments& massMoments) const override {
    const MassProperties body = massProperties(massMoments);
    GoalValue f;
    f.value = weight_ * body.centerOfMass.z();
    f.gradient = weight_ * massPropertyGradients(body).centerOfMass.row(2);
    return f;
  }

  /// Weight equals buoyancy, as a share of the whole body's buoyancy; c above or below B.
  GoalConstraints equalities(const Moments& massMoments) const override {
    const MassProperties body = massProperties(massMoments);
    GoalConstraints h{Vector(3), MomentGradients::Zero(3, 10)};
    const double most = waterDensity_ * wished_.volume;
    h.values << body.mass / most - wished_.displaced / wished_.volume,
        (body.centerOfMass - wished_.buoyancy).head<2>();
    h.gradients(0, 0) = 1.0 / most;
    h.gradients.bottomRows<2>() = massPropertyGradients(body).centerOfMass.topRows<2>();
    return h;
  }

  /// GM ≥ 0, for the axis with the least.
  GoalConstraints inequalities(const Moments& massMoments) const override {
    const MassProperties body = massProperties(massMoments);
    return {Vector::Constant(1, body.centerOfMass.z() - wished_.metacentre),
            massPropertyGradients(body).centerOfMass.row(2)};
  }

  bool usesInertia() const override { return false; }

  /// The level is a share of the whole body's buoyancy, or a length times m in those shares.
  std::vector<LinearConditions> conditions() const override {
    const double most = waterDensity_ * wished_.volume;
    AffineRows equal = AffineRows::Zero(3, 11);
    equal(0, 0) = 1.0 / most;
    equal(0, 10) = -wished_.displaced / wished_.volume;
    equal.bottomRows<2>().middleCols(1, 2).setIdentity();
    equal.bottomRows<2>().col(0) = -wished_.buoyancy.head<2>();
    equal.bottomRows<2>() /= most;
    AffineRows tooHigh = AffineRows::Zero(1, 11);
    tooHigh(0, 3) = 1.0 / most;
    tooHigh(0, 0) = -wished_.metacentre / most;
    return {linearConditions(equal, tooHigh, Eigen::Matrix<double, 1, 11>::Unit(10))};
  }

private:
  WishedPose wished_;
  double waterDensity_;
  double weight_;
};

/// The pose that a body set into the water upright comes to.
struct AtRest {
  FloatingPose pose;
  bool isDry = true; ///< no opening is under water
};

/// What else is told of it.
struct Afloat {
  FloatingEquilibria all;
  Stability stability;               ///< of the pose, and all below
  std::vector<RightingLever> levers; ///< while it is heeled towards where it leaves the pose first
};

/// Whether the pose is one of a family that turns without an answer.
bool turns(const FloatingRest& rest) {
  return rest.greatestTilt - rest.leastTilt > kHeelStep;
}

std::string inDegrees(double radians) {
  constexpr double kTenths = 10.0;
  return toString(std::round(radians * kDegrees * kTenths) / kTenths);
}

/// "90", or "0 to 180" of a family that turns through its tilts.
std::string tiltOf(const FloatingRest& rest) {
  return turns(rest) ? inDegrees(rest.leastTilt) + " to " + inDegrees(rest.greatestTilt)
                     : inDegrees(std::atan2(rest.pose.up.head<2>().norm(), rest.pose.up.z()));
}

std::string commaList(const std::vector<std::string>& items) {
  std::string list;
  for (const std::string& item : items) list += (list.empty() ? "" : ", ") + item;
  return list;
}

/// "90° over (4 poses) and 180° over"; "" without any.
std::string placesOf(const std::vector<std::string>& tilts) {
  std::vector<std::pair<std::string, int>> places;
  for (const std::string& tilt : tilts) {
    const auto known = std::find_if(places.begin(), places.end(),
                                    [&](const auto& place) { return place.first == tilt; });
    if (known == places.end()) {
      places.emplace_back(tilt, 1);
    } else {
      ++known->second;
    }
  }
  std::string text;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (i > 0) text += i + 1 < places.size() ? ", " : " and ";
    text += places[i].first + "\u00b0 over";
    if (places[i].second > 1) text += " (" + std::to_string(places[i].second) + " poses)";
  }
  return text;
}

class FloatVerdict final : public Verdict {
public:
  FloatVerdict(Points outer, Faces faces, Points rims, const WishedPose& wished,
               double waterDensity, double lengthUnit)
      : goal_(wished, waterDensity, {}), outer_(std::move(outer)), faces_(std::move(faces)),
        rims_(std::move(rims)), wished_(wished), waterDensity_(waterDensity),
        lengthUnit_(lengthUnit) {}

  bool isReached(const Moments& massMoments) const override {
    const auto& [p, isDry] = atRest(massMoments);
    if (!p.floats || !isDry || !isAtLevel(p) || heel(p) >= kUpright ||
        p.leastMetacentricHeight <= kNoLever) {
      return false;
    }
    return isHeldWithin(copyOf(bodyOf(massMoments)), p.up, kHeelStep, kBarrier) ||
           !turns(own(afloat(massMoments)));
  }

  std::string worstViolation(const Moments& massMoments) const override {
    const MassProperties body = massProperties(massMoments);
    const Vector equalities = goal_.equalities(massMoments).values;
    const double aside = equalities.tail<2>().norm();
    const double unstable = goal_.inequalities(massMoments).values[0];
    if (std::abs(equalities[0]) >= std::max(aside, unstable)) {
      const double excess = body.mass / (waterDensity_ * wished_.displaced) - 1.0;
      return "it is " + toString(100.0 * std::abs(excess)) + " % too " +
             (excess > 0.0 ? "heavy" : "light") + " for this waterline";
    }
    return aside >= unstable
               ? "the centre of mass lies " + toString(aside * lengthUnit_) +
                     " off the vertical through the centre of buoyancy"
               : "the metacentric height is " +
                     toString((wished_.metacentre - body.centerOfMass.z()) * lengthUnit_) + " only";
  }

  double violation(const Moments& massMoments) const override {
    const Vector equalities = goal_.equalities(massMoments).values;
    return std::max({std::abs(equalities[0]), equalities.tail<2>().norm(),
                     goal_.inequalities(massMoments).values[0]});
  }

  std::string whatIsMissed(const Moments& massMoments) const override {
    const auto& [p, isDry] = atRest(massMoments);
    if (!p.floats) return "it sinks";
    if (!isDry) return "an opening gets under water, so that it fills";
    if (heel(p) >= kUpright) return "it floats " + toString(heel(p)) + "\u00b0 off upright";
    const FloatingRest& rest = own(afloat(massMoments));
    if (turns(rest)) return "it turns without an answer, " + tiltOf(rest) + "\u00b0 over";
    return isAtLevel(p) ? "the metacentric height is " +
                              toString(p.leastMetacentricHeight * lengthUnit_) + " only"
                        : "it floats with a draught of " + toString(p.draught * lengthUnit_) +
                              " instead of " + toString(wished_.draught * lengthUnit_);
  }

  /// What else it can settle into, how far it may heel, and how neutral it is.
  std::string remark(const Moments& massMoments) const override {
    const Afloat& at = afloat(massMoments);
    const std::string others = placesOf(tilts(at, false));
    std::string text;
    if (!others.empty() || at.stability.floods) {
      text += "Heeled by less than " + inDegrees(at.stability.safe) + "\u00b0 it comes back";
      text += others.empty() ? "" : "; it also floats " + others;
      text += at.stability.floods ? "; heeled by " + inDegrees(at.stability.flooding) +
                                        "\u00b0 it fills through an opening."
                                  : ".";
    } else {
      text += "It floats in no other pose, so that it comes back from every heel.";
    }
    if (wished_.isSubmerged) {
      text += " It hovers while the water's density is within " +
              toString(100.0 * densityTolerance(massMoments)) +
              " % of the given one; in lighter water it sinks, in denser water it comes up.";
    }
    return text;
  }

  void describe(const Moments& massMoments, const std::string& suffix,
                Report& report) const override {
    const FloatingPose& p = atRest(massMoments).pose;
    report.add("draught_" + suffix, p.draught * lengthUnit_);
    report.add("heel_angle_" + suffix, heel(p));
    report.add("metacentric_height_" + suffix, p.leastMetacentricHeight * lengthUnit_);
    report.add("metacentric_height_long_" + suffix, p.greatestMetacentricHeight * lengthUnit_);
    report.add("reserve_buoyancy_" + suffix,
               1.0 - massMoments[0] / (waterDensity_ * wished_.volume));
    report.add("floats_" + suffix, p.floats);
    report.add("floats_upright_" + suffix, isReached(massMoments));
    describeStability(afloat(massMoments), suffix, report);
    if (wished_.isSubmerged) {
      report.add("water_density_tolerance_" + suffix, densityTolerance(massMoments));
    }
  }

  /// The water's edge on the body as it floats, and the centre of buoyancy.
  std::string draw(const Moments& /*before*/, const Moments& after,
                   Annotations& annotations) const override {
    const FloatingPose& p = atRest(after).pose;
    const double level = (outer_ * p.up).minCoeff() + p.draught;
    for (const auto& [from, to] : levelLines(outer_, faces_, p.up, level)) {
      annotations.addLine(from, to, kWaterColour);
    }
    annotations.addBall(displacement(outer_, faces_, p.up, level).centre, kWaterColour);
    return "waterline";
  }

private:
  FloatingBody bodyOf(const Moments& massMoments) const {
    const MassProperties mass = massProperties(massMoments);
    return floatingBody(outer_, faces_, mass.centerOfMass, mass.mass / waterDensity_, rims_);
  }
  FloatingBody copyOf(const FloatingBody& body) const {
    if (!coarse_) coarse_ = coarseSurface(outer_, faces_);
    return withSurface(body, *coarse_);
  }

  /// Kept, as the rest of it is, for the next question about the same body: it takes dozens of
  /// passes over the mesh.
  const AtRest& atRest(const Moments& massMoments) const {
    if (!atRest_ || atRest_->first != massMoments) {
      const FloatingBody body = bodyOf(massMoments);
      AtRest at{floatingPose(body), true};
      if (at.pose.floats) at.isDry = inclined(body, at.pose.up).isDry;
      atRest_ = {massMoments, at};
    }
    return atRest_->second;
  }

  /// Takes hundreds.
  const Afloat& afloat(const Moments& massMoments) const {
    if (afloat_ && afloat_->first == massMoments) return afloat_->second;
    const FloatingBody body = bodyOf(massMoments);
    Afloat at;
    if (!sinks(body)) {
      const FloatingBody copy = copyOf(body);
      at.all = floatingEquilibria(body, copy, kBarrier);
      // What turns without an answer does not come back from any heel.
      if (!turns(own(at))) {
        at.stability = stability(body, copy, at.all);
        at.levers = rightingLevers(body, copy, own(at).pose, at.stability.direction, kHeelStep,
                                   at.stability.vanishing);
      }
    }
    afloat_ = {massMoments, std::move(at)};
    return afloat_->second;
  }

  static const FloatingRest& own(const Afloat& at) { return at.all.rests[at.all.upright]; }

  /// Of the dry poses, with the one that the upright body comes to or without.
  static std::vector<std::string> tilts(const Afloat& at, bool withOwn) {
    std::vector<std::string> result;
    for (std::size_t i = 0; i < at.all.rests.size(); ++i) {
      if (!at.all.rests[i].isDry || (i == at.all.upright && !withOwn)) continue;
      result.push_back(tiltOf(at.all.rests[i]));
    }
    return result;
  }

  void describeStability(const Afloat& at, const std::string& suffix, Report& report) const {
    const std::vector<std::string> all = tilts(at, true);
    report.add("floating_poses_" + suffix, static_cast<int>(all.size()));
    if (at.all.rests.empty()) return;
    report.add("floating_tilts_" + suffix, commaList(all));
    std::vector<std::string> energies;
    for (const FloatingRest& rest : at.all.rests) {
      if (rest.isDry) energies.push_back(toString(rest.pose.energy * lengthUnit_));
    }
    report.add("floating_energies_" + suffix, commaList(energies));
    report.add("vanishing_stability_" + suffix, at.stability.vanishing * kDegrees);
    report.add("safe_heel_" + suffix, at.stability.safe * kDegrees);
    if (rims_.rows() > 0) report.add("flooding_heel_" + suffix, at.stability.flooding * kDegrees);
    RightingLever most{0.0, 0.0};
    std::vector<std::string> levers;
    for (const RightingLever& l : at.levers) {
      if (l.lever > most.lever) most = l;
      levers.push_back(inDegrees(l.heel) + ": " + toString(l.lever * lengthUnit_));
    }
    report.add("righting_lever_max_" + suffix, most.lever * lengthUnit_);
    report.add("righting_lever_max_heel_" + suffix, most.heel * kDegrees);
    report.add("righting_levers_" + suffix, commaList(levers));
    report.add("dynamical_stability_" + suffix, at.stability.barrier * lengthUnit_);
  }

  static double heel(const FloatingPose& p) {
    return std::acos(std::clamp(p.up.z(), -1.0, 1.0)) * kDegrees;
  }
  bool isAtLevel(const FloatingPose& p) const {
    return wished_.isSubmerged ? p.submerged
                               : std::abs(p.draught - wished_.draught) <= kAtLevel * wished_.height;
  }
  /// By how much the water's density may differ, as a share, lighter or denser, with the body
  /// still neutral.
  double densityTolerance(const Moments& massMoments) const {
    const double share = massMoments[0] / (waterDensity_ * wished_.volume);
    return std::max(0.0, std::min(1.0 - share / (1.0 + kNeutral), share / (1.0 - kNeutral) - 1.0));
  }

  FloatGoal goal_;
  Points outer_;
  Faces faces_;
  Points rims_;
  WishedPose wished_;
  double waterDensity_;
  double lengthUnit_;
  mutable std::optional<TriangleMesh> coarse_;
  mutable std::optional<std::pair<Moments, AtRest>> atRest_;
  mutable std::optional<std::pair<Moments, Afloat>> afloat_;
};

} // namespace

std::unique_ptr<Goal> makeFloatGoal(const Points& outer, const Faces& faces, double waterLevel,
                                    double waterDensity, const Weights& weights) {
  return std::make_unique<FloatGoal>(wishedPose(outer, faces, waterLevel), waterDensity, weights);
}

std::unique_ptr<Verdict> makeFloatVerdict(const Points& outer, const Faces& faces,
                                          double waterLevel, double waterDensity, double lengthUnit,
                                          const Points& rims) {
  return std::make_unique<FloatVerdict>(outer, faces, rims, wishedPose(outer, faces, waterLevel),
                                        waterDensity, lengthUnit);
}

} // namespace massprops
