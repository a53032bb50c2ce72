#include "core/goals/goals.h"
#include "core/physics/hydrostatics.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace massprops {
namespace {

constexpr double kDegrees = 180.0 / 3.14159265358979323846;
/// Least metacentric height that the constraint asks for, in diagonals: print and water are not
/// exact.
constexpr double kLeastStability = 1e-3;
/// Verdict: how far the body may lie from the wished pose.
constexpr double kUpright = 1.0;  // degrees
constexpr double kAtLevel = 0.01; // of the height

class FloatGoal final : public Goal {
public:
  FloatGoal(const Points& outer, const Faces& faces, double waterLevel, double waterDensity,
            const Weights& weights, double lengthUnit)
      : outer_(outer), faces_(faces), waterDensity_(waterDensity), weight_(weights.centerOfMass),
        lengthUnit_(lengthUnit) {
    const double bottom = outer.col(2).minCoeff();
    height_ = outer.col(2).maxCoeff() - bottom;
    draught_ = waterLevel * height_;
    const Moments whole = moments(outer, faces);
    volume_ = whole[0];
    const Displacement wished = displacement(outer, faces, Vec3::UnitZ(), bottom + draught_);
    displaced_ = wished.volume;
    buoyancy_ = wished.centre;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(
        wished.waterplaneMoment.topLeftCorner<2, 2>());
    metacentre_ = buoyancy_.z() + axes.eigenvalues()[0] / displaced_;
    submerged_ = waterLevel == 1.0;
  }

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
    const double most = waterDensity_ * volume_;
    h.values << body.mass / most - displaced_ / volume_, (body.centerOfMass - buoyancy_).head<2>();
    h.gradients(0, 0) = 1.0 / most;
    h.gradients.bottomRows<2>() = massPropertyGradients(body).centerOfMass.topRows<2>();
    return h;
  }

  /// GM ≥ margin, for the axis with the least.
  GoalConstraints inequalities(const Moments& massMoments) const override {
    const MassProperties body = massProperties(massMoments);
    return {Vector::Constant(1, body.centerOfMass.z() - metacentre_ + kLeastStability),
            massPropertyGradients(body).centerOfMass.row(2)};
  }

  bool usesInertia() const override { return false; }

  bool isReached(const Moments& massMoments) const override { return isReached(pose(massMoments)); }

  std::string worstViolation(const Moments& massMoments) const override {
    const MassProperties body = massProperties(massMoments);
    const double weight = body.mass / (waterDensity_ * displaced_) - 1.0;
    const double aside = (body.centerOfMass - buoyancy_).head<2>().norm();
    const double unstable = inequalities(massMoments).values[0];
    if (std::abs(equalities(massMoments).values[0]) >= std::max(aside, unstable)) {
      return "it is " + toString(100.0 * std::abs(weight)) + " % too " +
             (weight > 0.0 ? "heavy" : "light") + " for this waterline";
    }
    return aside >= unstable
               ? "the centre of mass lies " + toString(aside * lengthUnit_) +
                     " off the vertical through the centre of buoyancy"
               : "the metacentric height is " +
                     toString((metacentre_ - body.centerOfMass.z()) * lengthUnit_) + " only";
  }

  void describe(const Moments& massMoments, const std::string& suffix,
                Report& report) const override {
    const FloatingPose p = pose(massMoments);
    report.add("draught_" + suffix, p.draught * lengthUnit_);
    report.add("heel_angle_" + suffix, heel(p));
    report.add("metacentric_height_" + suffix, p.leastMetacentricHeight * lengthUnit_);
    report.add("metacentric_height_long_" + suffix, p.greatestMetacentricHeight * lengthUnit_);
    report.add("reserve_buoyancy_" + suffix, 1.0 - massMoments[0] / (waterDensity_ * volume_));
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
      known_ = {massMoments,
                floatingPose(outer_, faces_, body.centerOfMass, body.mass / waterDensity_)};
    }
    return known_->second;
  }
  static double heel(const FloatingPose& p) {
    return std::acos(std::clamp(p.up.z(), -1.0, 1.0)) * kDegrees;
  }
  bool isReached(const FloatingPose& p) const {
    const bool atLevel =
        submerged_ ? p.submerged : std::abs(p.draught - draught_) <= kAtLevel * height_;
    return p.floats && atLevel && heel(p) < kUpright && p.leastMetacentricHeight > 0.0;
  }

  Points outer_;
  Faces faces_;
  double waterDensity_;
  double weight_;
  double lengthUnit_;
  double height_ = 0.0, volume_ = 0.0;
  /// Of the wished pose.
  double draught_ = 0.0, displaced_ = 0.0, metacentre_ = 0.0;
  Vec3 buoyancy_ = Vec3::Zero();
  bool submerged_ = false;
  mutable std::optional<std::pair<Moments, FloatingPose>> known_;
};

} // namespace

std::unique_ptr<Goal> makeFloatGoal(const Points& outer, const Faces& faces, double waterLevel,
                                    double waterDensity, const Weights& weights,
                                    double lengthUnit) {
  return std::make_unique<FloatGoal>(outer, faces, waterLevel, waterDensity, weights, lengthUnit);
}

} // namespace massprops
