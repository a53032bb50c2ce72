#include "core/query/triangle_packet.h"

#include <limits>

namespace massprops {
namespace {

using Vectors = TrianglePacket::Vectors;

constexpr float kUnits = 16.0F * std::numeric_limits<float>::epsilon();

Vectors operator-(const Vectors& a, const Vectors& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

Lanes dot(const Vectors& a, const Vectors& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

Vectors cross(const Vectors& a, const Vectors& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Vectors broadcast(const Vec3& p) {
  const Eigen::Vector3f f = p.cast<float>();
  return {Lanes::Constant(f.x()), Lanes::Constant(f.y()), Lanes::Constant(f.z())};
}

Lanes absSum(const Vectors& a) {
  return a.x.abs() + a.y.abs() + a.z.abs();
}

Lanes absMax(const Vectors& a) {
  return a.x.abs().max(a.y.abs()).max(a.z.abs());
}

Lanes leastOf(const Lanes& a, const Lanes& b, const Lanes& c) {
  return a.min(b).min(c);
}

Lanes mostOf(const Lanes& a, const Lanes& b, const Lanes& c) {
  return a.max(b).max(c);
}

/// Of the gaps between what two bodies of this `size` cast on an axis of any length: no more than
/// their distance, whatever the axis is. Short axes, whose squares floats cannot hold, count as
/// longer, and gaps that come of products which floats cannot hold as none.
[[gnu::always_inline]] inline Lanes squaredLength(const Lanes& gap, const Vectors& axis,
                                                  const Lanes& size) {
  constexpr float kLeast = 1e-30F;
  constexpr float kMost = 1e37F;
  const Lanes held = Lanes::Zero().max(kMost - absSum(axis) * size);
  const Lanes reached = Lanes::Zero().max(gap).min(held);
  return (1.0F - kUnits) * reached * (reached / dot(axis, axis).max(kLeast));
}

/// Lower bounds that floats hold: of their least numbers, which are rounded up, nothing is left.
Lanes certain(const Lanes& squares) {
  return Lanes::Zero()
      .max(squares - std::numeric_limits<float>::min())
      .min((1.0F - kUnits) * std::numeric_limits<float>::max());
}

} // namespace

void TrianglePacket::set(int i, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3* const all[3] = {&a, &b, &c};
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3f p = all[k]->cast<float>();
    corners_[k].x[i] = p.x();
    corners_[k].y[i] = p.y();
    corners_[k].z[i] = p.z();
  }
}

Lanes TrianglePacket::squaredDistances(const Vec3& p, float rounding) const {
  const Vectors origin = broadcast(p);
  const Vectors t[3] = {corners_[0] - origin, corners_[1] - origin, corners_[2] - origin};
  const Lanes size = mostOf(absMax(t[0]), absMax(t[1]), absMax(t[2]));
  const Lanes error = rounding + kUnits * size;
  const auto gap = [](const Lanes& a, const Lanes& b, const Lanes& c) -> Lanes {
    return leastOf(a, b, c).max(-mostOf(a, b, c));
  };
  const Lanes x = Lanes::Zero().max(gap(t[0].x, t[1].x, t[2].x) - error);
  const Lanes y = Lanes::Zero().max(gap(t[0].y, t[1].y, t[2].y) - error);
  const Lanes z = Lanes::Zero().max(gap(t[0].z, t[1].z, t[2].z) - error);
  const Lanes ofBoxes = (1.0F - kUnits) * (x.square() + y.square() + z.square());
  const Vectors normal = cross(t[1] - t[0], t[2] - t[0]);
  const Lanes above = gap(dot(normal, t[0]), dot(normal, t[1]), dot(normal, t[2]));
  const Lanes ofPlanes = squaredLength(above - error * absSum(normal), normal, size);
  return certain(ofBoxes.max(ofPlanes));
}

QueryTriangle::QueryTriangle(const Vec3& a, const Vec3& b, const Vec3& c)
    : a_(broadcast(a)), b_(broadcast(b) - a_), c_(broadcast(c) - a_), normal_(cross(b_, c_)),
      size_(absMax(b_).max(absMax(c_))) {}

Lanes QueryTriangle::squaredDistances(const TrianglePacket& triangles, float rounding) const {
  const Vectors t[3] = {triangles.corner(0) - a_, triangles.corner(1) - a_,
                        triangles.corner(2) - a_};
  const Lanes size = mostOf(absMax(t[0]), absMax(t[1]), absMax(t[2])).max(size_);
  const Lanes error = rounding + kUnits * size;
  const auto along = [&](const Vectors& axis) -> Lanes {
    const Lanes p = dot(axis, t[0]);
    const Lanes q = dot(axis, t[1]);
    const Lanes r = dot(axis, t[2]);
    const Lanes b = dot(axis, b_);
    const Lanes c = dot(axis, c_);
    const Lanes gap =
        (leastOf(p, q, r) - b.max(c).max(0.0F)).max(b.min(c).min(0.0F) - mostOf(p, q, r));
    return squaredLength(gap - error * absSum(axis), axis, size);
  };
  const Lanes ofNormals = along(cross(t[1] - t[0], t[2] - t[0]));
  return certain(along(normal_).max(ofNormals));
}

} // namespace massprops
