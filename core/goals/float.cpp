#include "core/goals/float.h"

#include "core/base/angles.h"
#include "core/base/symmetric_eigen.h"
#include "core/physics/floating_pose.h"
#include "core/physics/hydrostatics.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace massprops {
namespace {

/// Least metacentric height that the constraint asks for, in diagonals: print and water are not
/// exact.
constexpr double kLeastStability = 1e-3;
/// A body that displaces a smaller share of its volume would have to weigh next to nothing.
constexpr double kLeastDisplaced = 1e-6;
/// Verdict: how far the body may lie from the wished pose.
constexpr double kUpright = 1.0;  // degrees
constexpr double kAtLevel = 0.01; // of the height

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
  if (!(wished.volume > kLeastDisplaced * pose.volume)) {
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

  /// GM ≥ margin, for the axis with the least.
  GoalConstraints inequalities(const Moments& massMoments) const override {
    const MassProperties body = massProperties(massMoments);
    return {Vector::Constant(1, body.centerOfMass.z() - wished_.metacentre + kLeastStability),
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
    tooHigh(0, 0) = (kLeastStability - wished_.metacentre) / most;
    return {linearConditions(equal, tooHigh, Eigen::Matrix<double, 1, 11>::Unit(10))};
  }

private:
  WishedPose wished_;
  double waterDensity_;
  double weight_;
};

class FloatVerdict final : public Verdict {
public:
  FloatVerdict(Points outer, Faces faces, const WishedPose& wished, double waterDensity,
               double lengthUnit)
      : goal_(wished, waterDensity, {}), outer_(std::move(outer)), faces_(std::move(faces)),
        wished_(wished), waterDensity_(waterDensity), lengthUnit_(lengthUnit) {}

  bool isReached(const Moments& massMoments) const override { return isReached(pose(massMoments)); }

  std::string worstViolation(const Moments& massMoments) const override {
    const MassProperties body = massProperties(massMoments);
    const Vector equalities = goal_.equalities(massMoments).values;
    const double aside = equalities.tail<2>().cwiseAbs().maxCoeff();
    const double unstable = goal_.inequalities(massMoments).values[0];
    if (std::abs(equalities[0]) >= std::max(aside, unstable)) {
      const double excess = body.mass / (waterDensity_ * wished_.displaced) - 1.0;
      return "it is " + toString(100.0 * std::abs(excess)) + " % too " +
             (excess > 0.0 ? "heavy" : "light") + " for this waterline";
    }
    return aside >= unstable
               ? "the centre of mass lies " + toString(equalities.tail<2>().norm() * lengthUnit_) +
                     " off the vertical through the centre of buoyancy"
               : "the metacentric height is " +
                     toString((wished_.metacentre - body.centerOfMass.z()) * lengthUnit_) + " only";
  }

  std::string whatIsMissed(const Moments& massMoments) const override {
    const FloatingPose p = pose(massMoments);
    if (!p.floats) return "it sinks";
    if (heel(p) >= kUpright) return "it floats " + toString(heel(p)) + "\u00b0 off upright";
    return isAtLevel(p) ? "the metacentric height is " +
                              toString(p.leastMetacentricHeight * lengthUnit_) + " only"
                        : "it floats with a draught of " + toString(p.draught * lengthUnit_) +
                              " instead of " + toString(wished_.draught * lengthUnit_);
  }

  void describe(const Moments& massMoments, const std::string& suffix,
                Report& report) const override {
    const FloatingPose p = pose(massMoments);
    report.add("draught_" + suffix, p.draught * lengthUnit_);
    report.add("heel_angle_" + suffix, heel(p));
    report.add("metacentric_height_" + suffix, p.leastMetacentricHeight * lengthUnit_);
    report.add("metacentric_height_long_" + suffix, p.greatestMetacentricHeight * lengthUnit_);
    report.add("reserve_buoyancy_" + suffix,
               1.0 - massMoments[0] / (waterDensity_ * wished_.volume));
    report.add("floats_" + suffix, p.floats);
    report.add("floats_upright_" + suffix, isReached(p));
  }

  /// The water's edge on the body as it floats, and the centre of buoyancy.
  std::string draw(const Moments& /*before*/, const Moments& after,
                   Annotations& annotations) const override {
    const FloatingPose p = pose(after);
    const double level = (outer_ * p.up).minCoeff() + p.draught;
    for (const auto& [from, to] : levelLines(outer_, faces_, p.up, level)) {
      annotations.addLine(from, to, kWaterColour);
    }
    annotations.addBall(displacement(outer_, faces_, p.up, level).centre, kWaterColour);
    return "waterline";
  }

private:
  /// Kept for the next question about the same body: it takes dozens of passes over the mesh.
  FloatingPose pose(const Moments& massMoments) const {
    if (!known_ || known_->first != massMoments) {
      const MassProperties body = massProperties(massMoments);
      known_ = {massMoments, floatingPose(floatingBody(outer_, faces_, body.centerOfMass,
                                                       body.mass / waterDensity_))};
    }
    return known_->second;
  }
  static double heel(const FloatingPose& p) {
    return std::acos(std::clamp(p.up.z(), -1.0, 1.0)) * kDegrees;
  }
  bool isAtLevel(const FloatingPose& p) const {
    return wished_.isSubmerged ? p.submerged
                               : std::abs(p.draught - wished_.draught) <= kAtLevel * wished_.height;
  }
  bool isReached(const FloatingPose& p) const {
    return p.floats && isAtLevel(p) && heel(p) < kUpright && p.leastMetacentricHeight > 0.0;
  }

  FloatGoal goal_;
  Points outer_;
  Faces faces_;
  WishedPose wished_;
  double waterDensity_;
  double lengthUnit_;
  mutable std::optional<std::pair<Moments, FloatingPose>> known_;
};

} // namespace

std::unique_ptr<Goal> makeFloatGoal(const Points& outer, const Faces& faces, double waterLevel,
                                    double waterDensity, const Weights& weights) {
  return std::make_unique<FloatGoal>(wishedPose(outer, faces, waterLevel), waterDensity, weights);
}

std::unique_ptr<Verdict> makeFloatVerdict(const Points& outer, const Faces& faces,
                                          double waterLevel, double waterDensity,
                                          double lengthUnit) {
  return std::make_unique<FloatVerdict>(outer, faces, wishedPose(outer, faces, waterLevel),
                                        waterDensity, lengthUnit);
}

} // namespace massprops
