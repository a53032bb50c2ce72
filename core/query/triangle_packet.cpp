#include "core/query/triangle_packet.h"

#include "core/mesh/degenerate_faces.h"

namespace massprops {
namespace {

using Vectors = TrianglePacket::Vectors;

/// Of products, so that floats hold their sums.
constexpr float kMostHeld = 1e37F;
/// Of divisors, so that floats hold quotients.
constexpr float kLeast = 1e-30F;

Vectors operator-(const Vectors& a, const Vectors& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

Lanes dot(const Vectors& a, const Vectors& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

Vectors cross(const Vectors& a, const Vectors& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Vectors broadcast(const Eigen::Vector3f& p) {
  return {Lanes::Constant(p.x()), Lanes::Constant(p.y()), Lanes::Constant(p.z())};
}

Vectors broadcast(const Vec3& p) {
  return broadcast(Eigen::Vector3f(p.cast<float>()));
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
  const Lanes held = Lanes::Zero().max(kMostHeld - absSum(axis) * size);
  const Lanes reached = Lanes::Zero().max(gap).min(held);
  return (1.0F - kFloatRounding) * reached * (reached / dot(axis, axis).max(kLeast));
}

/// So that floats hold the square of its length.
Vectors scaled(const Vectors& axis) {
  const Lanes scale = 1.0F / absMax(axis).max(kLeast);
  return {scale * axis.x, scale * axis.y, scale * axis.z};
}

/// Squared distances that gaps along two axes leave, as far as these are upright on each other:
/// |w|² ≥ (g₁² + g₂²)/(1 + c) where their cosine is at most c.
Lanes combined(const Vectors& a, const Lanes& squaredAlongA, const Vectors& b,
               const Lanes& squaredAlongB) {
  constexpr float kMostCosine = 1e-5F;
  const Lanes product = dot(a, b);
  const Lanes squares = dot(a, a) * dot(b, b);
  return (product.square() < 0.5F * kMostCosine * kMostCosine * squares)
      .select((1.0F - kMostCosine) * (squaredAlongA + squaredAlongB),
              squaredAlongA.max(squaredAlongB));
}

/// Lower bounds that floats hold: of their least numbers, which are rounded up, nothing is left.
Lanes certain(const Lanes& squares) {
  return Lanes::Zero()
      .max(squares - std::numeric_limits<float>::min())
      .min((1.0F - kFloatRounding) * std::numeric_limits<float>::max());
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

Lanes TrianglePacket::squaredDistances(const Vec3& p, float rounding, double reach) const {
  const Vectors origin = broadcast(p);
  const Vectors t[3] = {corners_[0] - origin, corners_[1] - origin, corners_[2] - origin};
  const Lanes size = mostOf(absMax(t[0]), absMax(t[1]), absMax(t[2]));
  const Lanes error = rounding + kFloatRounding * size;
  const auto gap = [](const Lanes& a, const Lanes& b, const Lanes& c) -> Lanes {
    return leastOf(a, b, c).max(-mostOf(a, b, c));
  };
  const Lanes x = Lanes::Zero().max(gap(t[0].x, t[1].x, t[2].x) - error);
  const Lanes y = Lanes::Zero().max(gap(t[0].y, t[1].y, t[2].y) - error);
  const Lanes z = Lanes::Zero().max(gap(t[0].z, t[1].z, t[2].z) - error);
  const Lanes ofBoxes = (1.0F - kFloatRounding) * (x.square() + y.square() + z.square());
  const auto along = [&](const Vectors& axis) -> Lanes {
    const Lanes found = gap(dot(axis, t[0]), dot(axis, t[1]), dot(axis, t[2]));
    return squaredLength(found - error * absSum(axis), axis, size);
  };
  const Vectors normal = scaled(cross(t[1] - t[0], t[2] - t[0]));
  const Lanes ofPlanes = along(normal);
  Lanes atLeast = certain(ofBoxes.max(ofPlanes));
  if (static_cast<double>(atLeast.minCoeff()) >= reach) return atLeast;
  for (int k = 0; k < 3; ++k) {
    const Vectors beside = cross(t[(k + 1) % 3] - t[k], normal);
    atLeast = atLeast.max(certain(combined(normal, ofPlanes, beside, along(beside))));
  }
  return atLeast;
}

Lanes BoxPacket::squaredDistances(const Vec3& p, float rounding, const PlanePacket* planes) const {
  const Vectors origin = broadcast(p);
  const Vectors from = Vectors{lower[0], lower[1], lower[2]} - origin;
  const Vectors to = Vectors{upper[0], upper[1], upper[2]} - origin;
  const Lanes error = rounding + kFloatRounding * absMax(from).max(absMax(to));
  const Lanes x = Lanes::Zero().max(from.x.max(-to.x) - error);
  const Lanes y = Lanes::Zero().max(from.y.max(-to.y) - error);
  const Lanes z = Lanes::Zero().max(from.z.max(-to.z) - error);
  const Lanes ofBoxes = (1.0F - kFloatRounding) * (x.square() + y.square() + z.square());
  if (planes == nullptr || planes->normal.isZero()) return certain(ofBoxes);
  const Vectors axis = broadcast(planes->normal);
  const Lanes at = dot(axis, origin);
  const Lanes gap =
      Lanes::Zero().max((planes->above - at).max(at - planes->below) - error * absSum(axis));
  const Lanes ofPlanes = (1.0F - kFloatRounding) * gap.square();
  // What lies beside is farther away than the plane.
  const Vectors middle{0.5F * (from.x + to.x), 0.5F * (from.y + to.y), 0.5F * (from.z + to.z)};
  const Lanes up = dot(axis, middle);
  const Vectors beside{middle.x - up * axis.x, middle.y - up * axis.y, middle.z - up * axis.z};
  const Lanes reach = 0.5F * (beside.x.abs() * (to.x - from.x) + beside.y.abs() * (to.y - from.y) +
                              beside.z.abs() * (to.z - from.z));
  const Lanes ofSides =
      squaredLength(dot(beside, middle) - reach - error * absSum(beside), beside, absMax(middle));
  return certain(ofBoxes.max(combined(axis, ofPlanes, beside, ofSides)));
}

QueryTriangle::QueryTriangle(const Vec3& a, const Vec3& b, const Vec3& c)
    : a_(broadcast(a)), b_(broadcast(b) - a_), c_(broadcast(c) - a_),
      size_(absMax(b_).max(absMax(c_))) {
  const Vec3 sides[3] = {b - a, c - b, a - c};
  int longest = 0;
  for (int k = 1; k < 3; ++k) {
    if (sides[k].squaredNorm() > sides[longest].squaredNorm()) longest = k;
  }
  const bool isPoint = !(sides[longest].squaredNorm() > 0.0);
  const Vec3 along = isPoint ? Vec3(Vec3::UnitX()) : sides[longest].normalized();
  const Vec3& other = sides[0].squaredNorm() < sides[1].squaredNorm() ? sides[0] : sides[1];
  const Vec3 normal = along.cross(other);
  // What rounding leaves of a side that is parallel is no direction.
  const Vec3 across = normal.norm() > kSafe * other.norm() ? along.cross(normal).normalized()
                                                           : along.unitOrthogonal();
  const Vec3 axes[3] = {along, across, along.cross(across)};
  for (int k = 0; k < 3; ++k) {
    frame_[k] = broadcast(axes[k]);
    const Lanes ofB = dot(frame_[k], b_);
    const Lanes ofC = dot(frame_[k], c_);
    low_[k] = ofB.min(ofC).min(0.0F);
    high_[k] = ofB.max(ofC).max(0.0F);
  }
  for (int k = 0; k < 2; ++k) {
    const Vec3& side = sides[(longest + 1 + k) % 3];
    const Vec3& next = sides[(longest + 2 + k) % 3];
    Vec3 outwards = side.cross(axes[2]);
    if (outwards.dot(next) > 0.0) outwards = -outwards;
    beside_[k] = broadcast(outwards.squaredNorm() > 0.0 ? Vec3(outwards.normalized()) : across);
    atSide_[k] = dot(beside_[k], b_).max(dot(beside_[k], c_)).max(0.0F);
  }
}

Lanes QueryTriangle::squaredDistances(const TrianglePacket& triangles, float rounding) const {
  const Vectors t[3] = {triangles.corner(0) - a_, triangles.corner(1) - a_,
                        triangles.corner(2) - a_};
  const Lanes size = mostOf(absMax(t[0]), absMax(t[1]), absMax(t[2])).max(size_);
  const Lanes error = rounding + kFloatRounding * size;
  Lanes inFrame[3];
  for (int k = 0; k < 3; ++k) {
    const Vectors& axis = frame_[k];
    const Lanes p = dot(axis, t[0]);
    const Lanes q = dot(axis, t[1]);
    const Lanes r = dot(axis, t[2]);
    const Lanes gap = (leastOf(p, q, r) - high_[k]).max(low_[k] - mostOf(p, q, r));
    inFrame[k] = Lanes::Zero().max(gap - error * absSum(axis)).square();
  }
  Lanes inPlane = inFrame[0] + inFrame[1];
  for (int k = 0; k < 2; ++k) {
    const Vectors& axis = beside_[k];
    const Lanes gap = leastOf(dot(axis, t[0]), dot(axis, t[1]), dot(axis, t[2])) - atSide_[k];
    inPlane = inPlane.max(Lanes::Zero().max(gap - error * absSum(axis)).square());
  }
  const Vectors axis = cross(t[1] - t[0], t[2] - t[0]);
  const Lanes p = dot(axis, t[0]);
  const Lanes q = dot(axis, t[1]);
  const Lanes r = dot(axis, t[2]);
  const Lanes b = dot(axis, b_);
  const Lanes c = dot(axis, c_);
  const Lanes gap =
      (leastOf(p, q, r) - b.max(c).max(0.0F)).max(b.min(c).min(0.0F) - mostOf(p, q, r));
  const Lanes ofNormals = squaredLength(gap - error * absSum(axis), axis, size);
  return certain(((1.0F - kFloatRounding) * (inPlane + inFrame[2])).max(ofNormals));
}

Lanes QueryTriangle::squaredDistances(const BoxPacket& boxes, float rounding,
                                      const PlanePacket* planes) const {
  const Lanes* const lower = boxes.lower;
  const Lanes* const upper = boxes.upper;
  const Vectors from = Vectors{lower[0], lower[1], lower[2]} - a_;
  const Vectors to = Vectors{upper[0], upper[1], upper[2]} - a_;
  const Lanes error = rounding + kFloatRounding * absMax(from).max(absMax(to)).max(size_);
  const Vectors middle{0.5F * (from.x + to.x), 0.5F * (from.y + to.y), 0.5F * (from.z + to.z)};
  const Vectors half{0.5F * (to.x - from.x), 0.5F * (to.y - from.y), 0.5F * (to.z - from.z)};
  const auto reachAlong = [&](const Vectors& axis) -> Lanes {
    return axis.x.abs() * half.x + axis.y.abs() * half.y + axis.z.abs() * half.z;
  };
  Lanes gaps[3];
  for (int k = 0; k < 3; ++k) {
    const Vectors& axis = frame_[k];
    const Lanes at = dot(axis, middle);
    const Lanes reach = reachAlong(axis);
    gaps[k] = (at - reach - high_[k]).max(low_[k] - at - reach) - error * absSum(axis);
  }
  Lanes inPlane = Lanes::Zero().max(gaps[0]).square() + Lanes::Zero().max(gaps[1]).square();
  for (int k = 0; k < 2; ++k) {
    const Vectors& axis = beside_[k];
    const Lanes gap = dot(axis, middle) - reachAlong(axis) - atSide_[k];
    inPlane = inPlane.max(Lanes::Zero().max(gap - error * absSum(axis)).square());
  }
  const auto inFrame = [&]() -> Lanes {
    return (1.0F - kFloatRounding) * (inPlane + Lanes::Zero().max(gaps[2]).square());
  };
  if (planes == nullptr || planes->normal.isZero()) return certain(inFrame());
  const Vectors normal = broadcast(planes->normal);
  const Lanes at = dot(normal, a_);
  const Lanes above = planes->above - at;
  const Lanes below = planes->below - at;
  // This one's normal is partly the planes', between which little lies; of the rest boxes tell.
  const Vectors& own = frame_[2];
  const Lanes share = dot(own, normal);
  const Vectors rest{own.x - share * normal.x, own.y - share * normal.y, own.z - share * normal.z};
  const Lanes atRest = dot(rest, middle);
  const Lanes reach = reachAlong(rest);
  const Lanes low = (share * above).min(share * below) + atRest - reach;
  const Lanes high = (share * above).max(share * below) + atRest + reach;
  constexpr float kRoundings = 4.0F; // as many as along one axis
  gaps[2] = gaps[2].max((low - high_[2]).max(low_[2] - high) - kRoundings * error);
  const Lanes b = dot(normal, b_);
  const Lanes c = dot(normal, c_);
  const Lanes gap = (above - b.max(c).max(0.0F)).max(b.min(c).min(0.0F) - below);
  const Lanes ofPlanes = Lanes::Zero().max(gap - error * absSum(normal)).square();
  return certain(inFrame().max((1.0F - kFloatRounding) * ofPlanes));
}

WayOfTriangle::WayOfTriangle(const Vec3& a, const Vec3& b, const Vec3& c,
                             const EarlierTriangle& earlier)
    : a_(broadcast(a)), size_(Lanes::Zero()), ways_(Lanes::Zero()) {
  const double before = earlier.distance * earlier.distance;
  before_ = Lanes::Constant(before < kMostHeld ? static_cast<float>(before) : 0.0F);
  const Vec3* const now[3] = {&a, &b, &c};
  const Vectors was[3] = {broadcast(Vec3(earlier.corners[0] - a)),
                          broadcast(Vec3(earlier.corners[1] - a)),
                          broadcast(Vec3(earlier.corners[2] - a))};
  for (int k = 0; k < 3; ++k) {
    by_[k] = broadcast(Vec3(*now[k] - earlier.corners[k]));
    least_[k] = leastOf(dot(by_[k], was[0]), dot(by_[k], was[1]), dot(by_[k], was[2]));
    size_ = size_.max(absMax(was[k]));
    ways_ = ways_.max(absSum(by_[k]));
  }
}

Lanes WayOfTriangle::squaredDistances(const BoxPacket& boxes, float rounding) const {
  const Vectors from = Vectors{boxes.lower[0], boxes.lower[1], boxes.lower[2]} - a_;
  const Vectors to = Vectors{boxes.upper[0], boxes.upper[1], boxes.upper[2]} - a_;
  const Lanes size = absMax(from).max(absMax(to)).max(size_);
  Lanes away = Lanes::Constant(kMostHeld);
  for (int k = 0; k < 3; ++k) {
    const Vectors& by = by_[k];
    const Lanes farthest = (by.x * from.x).max(by.x * to.x) + (by.y * from.y).max(by.y * to.y) +
                           (by.z * from.z).max(by.z * to.z);
    away = away.min(least_[k] - farthest);
  }
  away -= (rounding + kFloatRounding * size) * ways_;
  const Lanes squares =
      (1.0F - kFloatRounding) * before_ + 2.0F * away - kFloatRounding * away.abs();
  // Nothing is known where floats do not hold the products.
  return (size * ways_ < kMostHeld).select(squares - std::numeric_limits<float>::min(), 0.0F);
}

} // namespace massprops
