#include "core/physics/righting_lever.h"

#include "core/base/bisection.h"
#include "core/base/circle.h"
#include "core/base/infinity.h"
#include "core/base/parallel.h"
#include "core/base/symmetric_eigen.h"
#include "core/base/tolerances.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace massprops {
namespace {

using Index = std::size_t;

/// How far the unstable equilibrium may be from where the copy has one.
constexpr double kFarthest = 15.0 / kDegrees;

/// Of up and of the direction of heel, when a pose is heeled by `angle` towards `t`.
struct Heeled {
  Vec3 up, towards;
};
Heeled heeled(const Vec3& up, const Vec3& t, double angle) {
  return {std::cos(angle) * up + std::sin(angle) * t, std::cos(angle) * t - std::sin(angle) * up};
}

/// Where a body that is heeled in one direction, without trimming, turns back no more.
struct End {
  double heel = kPi;
  double energy = kInfinity;
  bool floods = false;
};

/// With the waterplane's share r = tᵀJt/V ≥ 0 the energy obeys U'' + U = r, so that from a heel
/// with the lever U' > 0 on, U' ≥ lever·cos s − U·sin s for the next s ≤ 90°: it does not vanish
/// before tan s = lever/U, and no zero is stepped over but within the least step.
class Heeling {
public:
  Heeling(const FloatingBody& body, const FloatingPose& pose, const Vec3& towards)
      : body_(body), pose_(pose), towards_(towards) {}

  End end() const {
    const double mostStep = body_.rims.rows() > 0 ? kHeelStep : 0.5 * kPi;
    double before = 0.0;
    double heel = kSame;
    while (heel < kPi) {
      const Inclination now = at(heel);
      if (isOver(now, heel)) return between(before, heel);
      before = heel;
      const double safe = std::atan2(lever(now, heel), now.energy);
      heel += std::clamp(safe, kSame, mostStep);
    }
    return {};
  }

private:
  Inclination at(double heel) const { return inclined(body_, heeled(pose_.up, towards_, heel).up); }
  double lever(const Inclination& now, double heel) const {
    return now.lever(heeled(pose_.up, towards_, heel).towards);
  }
  bool isOver(const Inclination& now, double heel) const {
    return !now.isDry || lever(now, heel) <= kNoLever;
  }

  End between(double before, double after) const {
    const double heel = lastThatHolds(after, before, kFeasibility,
                                      [&](double middle) { return isOver(at(middle), middle); });
    const Inclination end = at(heel);
    return {heel, end.energy, !end.isDry};
  }

  const FloatingBody& body_;
  const FloatingPose& pose_;
  const Vec3& towards_;
};

std::vector<Vec3> directionsAround(const Vec3& up) {
  const Horizontal axes = horizontal(up);
  std::vector<Vec3> result;
  for (int k = 0; k < kAround; ++k) result.emplace_back(axes * onCircle(k));
  return result;
}

std::vector<End> endsAround(const FloatingBody& body, const FloatingPose& pose,
                            const std::vector<Vec3>& directions) {
  std::vector<End> ends(directions.size());
  forChunks(static_cast<Eigen::Index>(ends.size()), 1, [&](const Chunk& chunk) {
    const auto k = static_cast<Index>(chunk.begin);
    ends[k] = Heeling(body, pose, directions[k]).end();
  });
  return ends;
}

/// The saddle of the energy near to `start`: Newton's method, but uphill along the axis with the
/// lower curvature and downhill along the other one, so that it leads to no maximum.
std::optional<Inclination> saddleNear(const FloatingBody& body, const Vec3& start) {
  // Along a ridge that is level, as that of a body of revolution, there is nowhere to go.
  constexpr double kLevel = 1e-3;
  Inclination at = inclined(body, start);
  constexpr int kMostSteps = 25;
  for (int step = 0; step < kMostSteps; ++step) {
    if (std::acos(std::clamp(at.up.dot(start), -1.0, 1.0)) > kFarthest) return std::nullopt;
    const Horizontal axes = horizontal(at.up);
    const Eigen::Matrix2d hessian =
        axes.transpose() * at.stiffness * axes - at.energy * Eigen::Matrix2d::Identity();
    const auto principal = symmetricEigen(hessian);
    const Vec2 curvature = principal.values.cwiseAbs();
    const bool isLevel = curvature[1] < kLevel * curvature[0];
    const Vec2 gradient = principal.vectors.transpose() * (axes.transpose() * at.arm);
    const double slope = isLevel ? std::abs(gradient[0]) : gradient.norm();
    if (slope <= kNoLever) {
      const bool isSaddle = principal.values[0] < 0.0 && (isLevel || principal.values[1] > 0.0);
      return isSaddle ? std::optional(at) : std::nullopt;
    }
    Vec2 turn(gradient[0] / std::max(curvature[0], 1e-6), 0.0);
    if (!isLevel) turn[1] = -gradient[1] / std::max(curvature[1], 1e-6);
    turn *= std::min(1.0, kMostTurn / turn.norm());
    at = inclined(body, (at.up + axes * (principal.vectors * turn)).normalized());
  }
  return std::nullopt;
}

/// Where the body leaves its pose.
struct Pass {
  double heel, energy;
  Vec3 towards;
};

/// Numbers of the lowest points of the ridge around a pose, the few nearest ones.
std::vector<Index> passesAmong(const std::vector<End>& ends) {
  constexpr Index kMost = 6;
  std::vector<Index> passes;
  for (Index k = 0; k < ends.size(); ++k) {
    const End& left = ends[(k + ends.size() - 1) % ends.size()];
    const End& right = ends[(k + 1) % ends.size()];
    const bool isLow = ends[k].energy <= left.energy && ends[k].energy <= right.energy;
    if (ends[k].heel < kPi && isLow && !ends[k].floods) passes.push_back(k);
  }
  std::stable_sort(passes.begin(), passes.end(),
                   [&](Index i, Index j) { return ends[i].heel < ends[j].heel; });
  if (passes.size() > kMost) passes.resize(kMost);
  return passes;
}

/// The saddle of the body's own energy next to `guess`.
std::optional<Pass> saddlePass(const FloatingBody& body, const FloatingPose& pose,
                               const Vec3& guess) {
  const auto saddle = saddleNear(body, guess);
  if (!saddle) return std::nullopt;
  const Vec3 aside = saddle->up - saddle->up.dot(pose.up) * pose.up;
  if (aside.norm() == 0.0) return std::nullopt;
  return Pass{std::atan2(aside.norm(), saddle->up.dot(pose.up)), saddle->energy - pose.energy,
              aside.normalized()};
}

/// Trim by which the copy, heeled, gets lowest; from a guess.
double trimOf(const FloatingBody& copy, const Heeled& at, double guess) {
  const Vec3 axis = at.up.cross(at.towards);
  double trim = guess;
  constexpr int kSteps = 4;
  for (int step = 0; step < kSteps; ++step) {
    const Heeled trimmed = heeled(at.up, axis, trim);
    const Inclination state = inclined(copy, trimmed.up);
    const double curvature = std::max(std::abs(state.metacentricHeight(trimmed.towards)), 1e-6);
    trim -= std::clamp(state.lever(trimmed.towards) / curvature, -kMostTurn, kMostTurn);
  }
  return trim;
}

} // namespace

Stability stability(const FloatingBody& body, const FloatingBody& copy,
                    const FloatingEquilibria& all) {
  const FloatingPose& pose = all.rests[all.upright].pose;
  const FloatingPose onCopy = floatingPose(copy, pose.up);
  if ((onCopy.up - pose.up).norm() > kFarthest && &copy != &body) return stability(body, body, all);
  const std::vector<Vec3> directions = directionsAround(onCopy.up);
  const std::vector<End> ends = endsAround(copy, onCopy, directions);
  std::optional<Pass> nearest; // that counts
  Pass safe{kPi, 0.0, Vec3::UnitX()};
  Stability result;
  for (Index k = 0; k < ends.size(); ++k) {
    const Pass here{ends[k].heel, ends[k].energy - onCopy.energy, directions[k]};
    if (here.heel < safe.heel) safe = here;
    if (!ends[k].floods || here.heel >= result.flooding) continue;
    result.flooding = here.heel;
    nearest = here;
  }
  for (const Index k : passesAmong(ends)) {
    const auto pass = saddlePass(body, pose, heeled(onCopy.up, directions[k], ends[k].heel).up);
    if (pass && (!nearest || pass->heel < nearest->heel)) nearest = pass;
  }
  // Where there are other poses there is a way to them, found or not.
  if (!nearest && all.rests.size() > 1) nearest = safe;
  result.vanishing = nearest ? nearest->heel : kPi;
  result.safe = std::min(safe.heel, result.vanishing);
  result.floods = nearest && result.flooding == nearest->heel && result.flooding < kPi;
  result.barrier = nearest ? nearest->energy : 0.0;
  result.direction = nearest ? nearest->towards : safe.heel < kPi ? safe.towards : directions[0];
  return result;
}

std::vector<RightingLever> rightingLevers(const FloatingBody& body, const FloatingBody& copy,
                                          const FloatingPose& pose, const Vec3& towards,
                                          double step, double last) {
  std::vector<Heeled> poses;
  std::vector<RightingLever> levers;
  double trim = 0.0;
  const int count = static_cast<int>(std::ceil(last / step - 1e-9));
  for (int k = 1; k <= count; ++k) {
    const double angle = std::min(k * step, last);
    const Heeled at = heeled(pose.up, towards, angle);
    trim = trimOf(copy, at, trim);
    const Vec3 up = heeled(at.up, at.up.cross(at.towards), trim).up;
    poses.push_back({up, at.towards});
    levers.push_back({angle, 0.0});
  }
  forChunks(static_cast<Eigen::Index>(levers.size()), 1, [&](const Chunk& chunk) {
    const auto k = static_cast<Index>(chunk.begin);
    levers[k].lever = inclined(body, poses[k].up).lever(poses[k].towards);
  });
  return levers;
}

} // namespace massprops
