#include "core/physics/floating_pose.h"

#include "core/base/symmetric_eigen.h"

#include <cmath>

namespace massprops {
namespace {

/// Sine of the push off an unstable equilibrium.
constexpr double kPush = 1e-3;

/// Under water the centre of buoyancy hangs above the centre of mass.
FloatingPose underWater(const FloatingBody& body) {
  const Vec3 arm = body.middle - body.centre;
  FloatingPose pose;
  pose.submerged = true;
  pose.floats = !sinks(body);
  if (arm.norm() > 0.0) pose.up = arm.normalized();
  pose.energy = -arm.norm();
  pose.leastMetacentricHeight = pose.greatestMetacentricHeight = arm.norm();
  const Vector heights = body.vertices * pose.up;
  pose.draught = heights.maxCoeff() - heights.minCoeff();
  return pose;
}

/// Turns a body downhill until it floats at rest.
class Floating {
public:
  Floating(const FloatingBody& body, const Vec3& up) : body_(body), at_(inclined(body, up)) {}

  FloatingPose settled() {
    FloatingPose pose;
    pose.floats = true;
    while (true) {
      const Horizontal axes = horizontal(at_.up);
      const Eigen::Matrix2d hessian =
          axes.transpose() * at_.stiffness * axes - at_.energy * Eigen::Matrix2d::Identity();
      const Principal principal = symmetricEigen(hessian);
      pose.leastMetacentricHeight = principal.values[0];
      pose.greatestMetacentricHeight = principal.values[1];
      const Vec2 gradient = axes.transpose() * at_.arm;
      const bool isStable = gradient.norm() < kNoLever && principal.values[0] >= 0.0;
      if (isStable || !descends(axes * downhill(gradient, principal))) break;
    }
    pose.up = at_.up;
    pose.energy = at_.energy;
    pose.draught = at_.level - (body_.vertices * at_.up).minCoeff();
    return pose;
  }

private:
  using Principal = SymmetricEigen<Eigen::Matrix2d>;

  static Vec2 downhill(const Vec2& gradient, const Principal& principal) {
    Vec2 turn;
    if (gradient.norm() < kNoLever) {
      turn = kPush * principal.vectors.col(0);
    } else {
      // Newton's step with the curvatures made positive always leads down.
      const Vec2 along = principal.vectors.transpose() * gradient;
      const Vec2 curvature = principal.values.cwiseAbs().cwiseMax(1e-6);
      turn = -principal.vectors * along.cwiseQuotient(curvature);
    }
    return turn.norm() > kMostTurn ? Vec2(turn * (kMostTurn / turn.norm())) : turn;
  }

  static double slope(const Inclination& at) { return (at.arm - at.energy * at.up).norm(); }

  bool isLower(const Inclination& next) const {
    // So near to the rest that rounding hides the descent, the slope still tells.
    const double rounding = 1e-14 * at_.arm.norm();
    return next.energy < at_.energy - rounding ||
           (next.energy < at_.energy + rounding && slope(next) < 0.5 * slope(at_));
  }

  /// Turns as far as leads down; returns whether it does at all.
  bool descends(Vec3 turn) {
    for (; turn.norm() > kNoLever; turn *= 0.5) {
      const Inclination next = inclined(body_, (at_.up + turn).normalized());
      if (!isLower(next)) continue;
      at_ = next;
      return true;
    }
    return false;
  }

  const FloatingBody& body_;
  Inclination at_;
};

} // namespace

FloatingPose floatingPose(const FloatingBody& body, const Vec3& up) {
  return isUnderWater(body) ? underWater(body) : Floating(body, up).settled();
}

} // namespace massprops
