#include "core/physics/hydrostatics.h"

#include "core/base/symmetric_eigen.h"
#include "core/base/triangle.h"
#include "core/physics/moments.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace massprops {
namespace {

/// A body whose weight is within this share of the displaced water's is neutral under water.
constexpr double kNeutral = 1e-4;
/// Sine of the heel at which the righting arm counts as nothing, and of the push off an unstable
/// equilibrium.
constexpr double kLevelled = 1e-10;
constexpr double kPush = 1e-3;
constexpr double kMostTurn = 0.2; // radians a step

/// A frame whose third row is `up`.
Mat3 frameOf(const Vec3& up) {
  Mat3 rows;
  rows.row(2) = up.transpose();
  rows.row(0) = up.unitOrthogonal().transpose();
  rows.row(1) = up.cross(rows.row(0).transpose()).transpose();
  return rows;
}

/// Sums over the wet part of the surface, in a frame with the water's surface at z = 0.
class WetSurface {
public:
  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    // Tetrahedra to the origin, which lies on the waterplane, so that the plane adds nothing.
    const double D = a.dot(areaNormal(a, b, c));
    const Vec3 s = a + b + c;
    volume += D / 6.0;
    first += D / 24.0 * s;
    // ∫q dA over the waterplane = −∫q n_z dA over the wet surface, for q does not depend on z.
    const Vec2 p = a.head<2>();
    const Vec2 q = b.head<2>();
    const Vec2 r = c.head<2>();
    const Vec2 sum = p + q + r;
    const double twice = (q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x());
    area -= twice / 2.0;
    areaFirst -= twice / 6.0 * sum;
    areaSecond -=
        twice / 24.0 *
        (sum * sum.transpose() + p * p.transpose() + q * q.transpose() + r * r.transpose());
  }

  double volume = 0.0;
  Vec3 first = Vec3::Zero();
  double area = 0.0;
  Vec2 areaFirst = Vec2::Zero();
  Eigen::Matrix2d areaSecond = Eigen::Matrix2d::Zero();
};

} // namespace

Displacement displacement(const Points& vertices, const Faces& faces, const Vec3& up,
                          double level) {
  const Mat3 frame = frameOf(up);
  // Near the body, lest the integrals cancel.
  const Vec3 mean = vertices.colwise().mean().transpose();
  const Vec3 origin = mean + (level - up.dot(mean)) * up;
  const Points x = (vertices.rowwise() - origin.transpose()) * frame.transpose();
  WetSurface wet;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    std::array<Vec3, 4> part;
    std::size_t corners = 0;
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = x.row(faces(f, k)).transpose();
      const Vec3 q = x.row(faces(f, (k + 1) % 3)).transpose();
      if (p.z() <= 0.0) part[corners++] = p;
      if ((p.z() <= 0.0) == (q.z() <= 0.0)) continue;
      // From the lower end, so that both triangles at the edge get the same point.
      const Vec3& low = p.z() <= 0.0 ? p : q;
      const Vec3& high = p.z() <= 0.0 ? q : p;
      Vec3 cut = low + low.z() / (low.z() - high.z()) * (high - low);
      cut.z() = 0.0;
      part[corners++] = cut;
    }
    for (std::size_t k = 2; k < corners; ++k) wet.add(part[0], part[k - 1], part[k]);
  }
  Displacement result;
  result.volume = wet.volume;
  result.centre = origin;
  if (wet.volume > 0.0) result.centre += frame.transpose() * (wet.first / wet.volume);
  result.waterplaneArea = std::max(0.0, wet.area);
  if (wet.area > 0.0) {
    Mat3 moment = Mat3::Zero();
    moment.topLeftCorner<2, 2>() =
        wet.areaSecond - wet.areaFirst * wet.areaFirst.transpose() / wet.area;
    result.waterplaneMoment = frame.transpose() * moment * frame;
  }
  return result;
}

std::vector<std::pair<Vec3, Vec3>> levelLines(const Points& vertices, const Faces& faces,
                                              const Vec3& up, double level) {
  const Vector heights = (vertices * up).array() - level;
  std::vector<std::pair<Vec3, Vec3>> lines;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    std::array<Vec3, 2> ends;
    std::size_t found = 0;
    for (int k = 0; k < 3; ++k) {
      const int p = faces(f, k);
      const int q = faces(f, (k + 1) % 3);
      if ((heights[p] <= 0.0) == (heights[q] <= 0.0)) continue;
      const double share = heights[p] / (heights[p] - heights[q]);
      ends[found++] = ((1.0 - share) * vertices.row(p) + share * vertices.row(q)).transpose();
    }
    if (found == 2) lines.emplace_back(ends[0], ends[1]);
  }
  return lines;
}

double levelFor(const Points& vertices, const Faces& faces, const Vec3& up, double volume) {
  const Vector heights = vertices * up;
  double low = heights.minCoeff();
  double high = heights.maxCoeff();
  const double tolerance = 1e-13 * (high - low);
  double level = 0.5 * (low + high);
  constexpr int kMostSteps = 100;
  for (int step = 0; step < kMostSteps && high - low > tolerance; ++step) {
    const Displacement d = displacement(vertices, faces, up, level);
    (d.volume < volume ? low : high) = level;
    // dV/dlevel is the waterplane's area: Newton, or halves where that leaves the bracket.
    const double newton = level + (volume - d.volume) / d.waterplaneArea;
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    if (std::abs(next - level) <= tolerance) return next;
    level = next;
  }
  return level;
}

namespace {

/// Under water the centre of buoyancy hangs above the centre of mass.
FloatingPose underWater(const Points& vertices, const Moments& whole, const Vec3& centre,
                        double displaced) {
  const Vec3 arm = whole.segment<3>(1) / whole[0] - centre;
  FloatingPose pose;
  pose.submerged = true;
  pose.floats = displaced < (1.0 + kNeutral) * whole[0];
  if (arm.norm() > 0.0) pose.up = arm.normalized();
  pose.leastMetacentricHeight = pose.greatestMetacentricHeight = arm.norm();
  const Vector heights = vertices * pose.up;
  pose.draught = heights.maxCoeff() - heights.minCoeff();
  return pose;
}

/// Turns a body downhill until it floats at rest. The potential energy over the weight is
/// U = (c − B)·up at constant displacement; along unit tangents t, dU = (c − B)·t and
/// d²U = tᵀJt/V − (c − B)·up, which is the metacentric height.
class Floating {
public:
  Floating(const Points& vertices, const Faces& faces, const Vec3& centre, double displaced)
      : vertices_(vertices), faces_(faces), centre_(centre), displaced_(displaced),
        state_(at(pose_.up)) {
    pose_.floats = true;
  }

  FloatingPose settled() {
    constexpr int kMostSteps = 200;
    for (int step = 0;; ++step) {
      const Mat3 frame = frameOf(pose_.up);
      const Eigen::Matrix2d hessian =
          (frame * state_.d.waterplaneMoment * frame.transpose()).topLeftCorner<2, 2>() /
              displaced_ -
          state_.energy * Eigen::Matrix2d::Identity();
      const Axes axes = symmetricEigen(hessian);
      pose_.leastMetacentricHeight = axes.values[0];
      pose_.greatestMetacentricHeight = axes.values[1];
      const Vec2 gradient = (frame * (centre_ - state_.d.centre)).head<2>();
      const bool isStable = gradient.norm() < kLevelled && axes.values[0] >= 0.0;
      if (step == kMostSteps || isStable || !descends(frame, downhill(gradient, axes))) break;
    }
    pose_.draught = state_.level - (vertices_ * pose_.up).minCoeff();
    return pose_;
  }

private:
  struct State {
    Displacement d;
    double level, energy;
  };
  using Axes = SymmetricEigen<Eigen::Matrix2d>;

  State at(const Vec3& up) const {
    const double level = levelFor(vertices_, faces_, up, displaced_);
    const Displacement d = displacement(vertices_, faces_, up, level);
    return {d, level, (centre_ - d.centre).dot(up)};
  }

  static Vec2 downhill(const Vec2& gradient, const Axes& axes) {
    Vec2 turn;
    if (gradient.norm() < kLevelled) {
      turn = kPush * axes.vectors.col(0);
    } else {
      // Newton's step with the curvatures made positive always leads down.
      const Vec2 along = axes.vectors.transpose() * gradient;
      const Vec2 curvature = axes.values.cwiseAbs().cwiseMax(1e-6);
      turn = -axes.vectors * along.cwiseQuotient(curvature);
    }
    return turn.norm() > kMostTurn ? Vec2(turn * (kMostTurn / turn.norm())) : turn;
  }

  /// Turns as far as leads down; returns whether it does at all.
  bool descends(const Mat3& frame, Vec2 turn) {
    constexpr int kMostHalvings = 30;
    for (int halving = 0; halving < kMostHalvings; ++halving, turn *= 0.5) {
      const Vec3 up = (pose_.up + frame.topRows<2>().transpose() * turn).normalized();
      const State next = at(up);
      if (next.energy >= state_.energy) continue;
      state_ = next;
      pose_.up = up;
      return true;
    }
    return false;
  }

  const Points& vertices_;
  const Faces& faces_;
  const Vec3& centre_;
  double displaced_;
  FloatingPose pose_;
  State state_;
};

} // namespace

FloatingPose floatingPose(const Points& vertices, const Faces& faces, const Vec3& centre,
                          double displaced) {
  const Moments whole = moments(vertices, faces);
  if (displaced > (1.0 - kNeutral) * whole[0]) {
    return underWater(vertices, whole, centre, displaced);
  }
  return Floating(vertices, faces, centre, displaced).settled();
}

} // namespace massprops
