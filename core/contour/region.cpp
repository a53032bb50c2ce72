#include "core/contour/region.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace massprops {
namespace {

constexpr double kTiny = 1e-300;

struct QuadricAt {
  double value;
  Vec3 gradient;
};

QuadricAt quadricAt(const Moments& q, const Vec3& x) {
  return {q.dot(monomials(x)), gradientAt(q, x)};
}

/// Largest second derivative along any direction, or more.
double curvatureOf(const Moments& q) {
  return 2.0 * std::sqrt(q.segment<3>(4).squaredNorm() + 0.5 * q.tail<3>().squaredNorm());
}

} // namespace

Sample cutAt(const LayeredQuadric& layered, double transition, const Vec3& x) {
  const std::vector<double>& heights = layered.heights;
  QuadricAt q = quadricAt(layered.quadrics[layered.layerAt(x.z())], x);
  const auto above = std::lower_bound(heights.begin(), heights.end(), x.z() - transition);
  if (above != heights.end() && *above < x.z() + transition) {
    // Of heights nearer to each other than that the lowest is taken.
    const auto layer = static_cast<std::size_t>(above - heights.begin());
    const QuadricAt below = quadricAt(layered.quadrics[layer], x);
    q = quadricAt(layered.quadrics[layer + 1], x);
    const double share = 0.5 + 0.5 * (x.z() - *above) / transition;
    const double step = q.value - below.value;
    q.value = below.value + share * step;
    q.gradient = below.gradient + share * (q.gradient - below.gradient);
    q.gradient.z() += 0.5 * step / transition;
  }
  const double steepness = std::max(q.gradient.norm(), kTiny);
  return {q.value / steepness, q.gradient / steepness};
}

Sample cutAt(const Region& region, const Vec3& x) {
  return cutAt(*region.quadric, region.transition, x);
}

Side sideOfCut(const Region& region, const Vec3& x, double radius) {
  const LayeredQuadric& layered = *region.quadric;
  const std::size_t first = layered.layerAt(x.z() - radius - region.transition);
  const std::size_t last = layered.layerAt(x.z() + radius + region.transition);
  bool isPositive = false;
  bool isNegative = false;
  for (std::size_t layer = first; layer <= last; ++layer) {
    const Moments& quadric = layered.quadrics[layer];
    const QuadricAt q = quadricAt(quadric, x);
    const double change = radius * (q.gradient.norm() + 0.5 * radius * curvatureOf(quadric));
    isPositive = isPositive || q.value > -change;
    isNegative = isNegative || q.value < change;
  }
  return isPositive && isNegative ? Side::Both : isPositive ? Side::Positive : Side::Negative;
}

InsetProbe::InsetProbe(const Region& region, double slack)
    : region_(region), slack_(slack), inside_(region.surface) {
  if (region.opening) opening_.emplace(region.surface, *region.opening, slack);
}

Sample InsetProbe::at(const Vec3& x, double horizon, bool isInside) {
  return filled(x, opened(x, behindWalls(x, horizon, isInside), horizon), horizon);
}

Sample InsetProbe::roughlyAt(const Vec3& x, double horizon, bool isInside) {
  Sample inset = behindWalls(x, horizon, isInside);
  const bool fits = !opening_ || region_.wall + inset.value >= region_.opening->fits;
  if (!fits) inset.value = std::min(inset.value, 0.0);
  return filled(x, inset, horizon);
}

Sample InsetProbe::filled(const Vec3& x, const Sample& inset, double horizon) {
  if (region_.fill == nullptr || inset.value <= -horizon) return inset;
  Sample fill = region_.fill->at(x);
  if (fill.value >= inset.value) return inset;
  isOfSurface_ = false;
  return fill;
}

Sample InsetProbe::behindWalls(const Vec3& x, double horizon, bool isInside) {
  constexpr double kAnywhere = std::numeric_limits<double>::infinity();
  const TriangleTree& surface = region_.surface;
  const double exact = (opening_ ? region_.opening->fits : region_.wall) + horizon;
  const bool isNearLast = (x - last_.centre).squaredNorm() < last_.radius * last_.radius;
  const bool isSideKnown = isInside || isNearLast;
  // Only the very nearest face tells the side.
  const double slack = isSideKnown ? slack_ : 0.0;
  nearest_ = surface.nearest(x, kAnywhere, nearest_.face, exact * exact, slack);
  const double found = std::sqrt(nearest_.squaredDistance);
  const bool isFar = found > exact;
  if (isSideKnown) {
    last_.isInside = isInside || last_.isInside;
  } else {
    last_.isInside =
        inside_.contains(x, isFar ? surface.nearest(x, kAnywhere, nearest_.face) : nearest_);
  }
  // It may be another point than the nearest one, which the ball must not reach.
  last_.centre = x;
  last_.radius = isFar ? std::max(exact, found / TriangleTree::kSlack) : found / (1.0 + slack);
  const TriangleTree::Hit clear = region_.surface.clearance(x, nearest_);
  const double distance = std::sqrt(clear.squaredDistance);
  const double sign = last_.isInside ? 1.0 : -1.0;
  Sample inset{sign * distance - region_.wall,
               sign * (x - clear.point) / std::max(distance, kTiny)};
  isOfSurface_ = true;
  isInDoubt_ = false;
  return inset;
}

Sample InsetProbe::opened(const Vec3& x, const Sample& inset, double horizon) {
  if (!opening_ || inset.value <= -horizon) return inset;
  const Sample depth{region_.wall + inset.value, inset.slope};
  const std::optional<Sample> value = opening_->at(x, depth, inset.value, horizon);
  if (value && value->value >= inset.value) return inset;
  isOfSurface_ = false;
  isInDoubt_ = !value;
  return value ? *value : Sample{std::min(inset.value, -horizon), inset.slope};
}

} // namespace massprops
