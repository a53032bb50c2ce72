#include "core/contour/opening.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace massprops {
namespace {

constexpr double kTiny = 1e-12;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Ways v with slope·v ≥ rise.
struct HalfSpace {
  Vec3 slope;
  double rise;
};

/// The shortest way into all of some half-spaces.
class ShortestWay {
public:
  static constexpr std::size_t kMost = 8;

  bool isFull() const { return count_ == kMost; }

  /// One more, that the shortest way into those before it does not lead into: so that the new one
  /// ends on its border, and on those of two others at most. It is the shortest of all ways onto
  /// such borders that lead into the others, too. Empty: there is none.
  std::optional<Vec3> add(const HalfSpace& a) {
    shortest_.reset();
    halfSpaces_[count_++] = a;
    consider(a.rise * a.slope);
    for (std::size_t i = 0; i + 1 < count_; ++i) {
      considerBoth(a, halfSpaces_[i]);
      for (std::size_t k = 0; k < i; ++k) considerAll(a, halfSpaces_[i], halfSpaces_[k]);
    }
    return shortest_;
  }

private:
  void considerBoth(const HalfSpace& a, const HalfSpace& b) {
    const double c = a.slope.dot(b.slope);
    const double squaredSine = 1.0 - c * c;
    if (squaredSine < kTiny) return;
    consider(((a.rise - c * b.rise) * a.slope + (b.rise - c * a.rise) * b.slope) / squaredSine);
  }

  void considerAll(const HalfSpace& a, const HalfSpace& b, const HalfSpace& c) {
    const Vec3 bc = b.slope.cross(c.slope);
    const double volume = a.slope.dot(bc);
    if (std::abs(volume) < kTiny) return;
    consider((a.rise * bc + b.rise * c.slope.cross(a.slope) + c.rise * a.slope.cross(b.slope)) /
             volume);
  }

  void consider(const Vec3& way) {
    if (shortest_ && way.squaredNorm() >= shortest_->squaredNorm()) return;
    constexpr double kRoundedOff = 1e-9;
    for (std::size_t i = 0; i < count_; ++i) {
      const HalfSpace& h = halfSpaces_[i];
      if (h.slope.dot(way) < h.rise - kRoundedOff * std::abs(h.rise)) return;
    }
    shortest_ = way;
  }

  std::array<HalfSpace, kMost> halfSpaces_;
  std::size_t count_ = 0;
  std::optional<Vec3> shortest_;
};

} // namespace

OpeningProbe::OpeningProbe(const TriangleTree& surface, const Opening& opening, double slack)
    : surface_(surface), opening_(opening), slack_(slack), inside_(surface) {}

std::optional<Sample> OpeningProbe::at(const Vec3& x, const Sample& depth, double enough,
                                       double horizon) {
  const Sample surely{kInfinity, Vec3::UnitX()};
  if (depth.value >= opening_.fits || isSurely(x, enough)) return surely;
  const double farthest = opening_.reach + horizon;
  const std::optional<Vec3> place = placeNear(x, depth, farthest);
  if (place) known_ = place;
  if (!known_) return {};
  const double away = (*known_ - x).norm();
  if (away > farthest) return {};
  const double value = opening_.reach - away;
  if (value >= enough) return surely;
  return Sample{value, (*known_ - x) / std::max(away, kTiny)};
}

Sample OpeningProbe::depthAt(const Vec3& x, bool isInside) {
  // Only the very nearest face tells the side.
  const double exact = isInside ? opening_.fits * opening_.fits : kInfinity;
  const TriangleTree::Hit hit =
      surface_.nearest(x, kInfinity, nearestFace_, exact, isInside ? slack_ : 0.0);
  nearestFace_ = hit.face;
  const double sign = isInside || inside_.contains(x, hit) ? 1.0 : -1.0;
  const TriangleTree::Hit clear = surface_.clearance(x, hit);
  const double distance = std::sqrt(clear.squaredDistance);
  return {sign * distance, sign * (x - clear.point) / std::max(distance, kTiny)};
}

std::optional<Vec3> OpeningProbe::placeNear(const Vec3& x, const Sample& depth, double farthest) {
  constexpr double kReached = 1e-6; // of the depth
  const double enough = (1.0 - kReached) * opening_.fits;
  ShortestWay shortest;
  Vec3 y = x;
  Sample here = depth;
  while (!shortest.isFull()) {
    const std::optional<Vec3> way =
        shortest.add({here.slope, opening_.fits - here.value + here.slope.dot(y - x)});
    if (!way || way->norm() > farthest) return {};
    y = x + *way;
    here = depthAt(y, way->norm() < depth.value);
    if (here.value >= enough) return y;
  }
  return {};
}

} // namespace massprops
