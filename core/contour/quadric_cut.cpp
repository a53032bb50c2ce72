#include "core/contour/quadric_cut.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
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

Sample cutAt(const QuadricCut& cut, const Vec3& x) {
  const std::vector<double>& heights = cut.quadric.heights;
  const std::vector<Moments>& quadrics = cut.quadric.quadrics;
  QuadricAt q = quadricAt(quadrics[cut.quadric.layerAt(x.z())], x);
  const auto above = std::lower_bound(heights.begin(), heights.end(), x.z() - cut.transition);
  if (above != heights.end() && *above < x.z() + cut.transition) {
    // Of heights nearer to each other than that the lowest is taken.
    const auto layer = static_cast<std::size_t>(above - heights.begin());
    const QuadricAt below = quadricAt(quadrics[layer], x);
    q = quadricAt(quadrics[layer + 1], x);
    const double share = 0.5 + 0.5 * (x.z() - *above) / cut.transition;
    const double step = q.value - below.value;
    q.value = below.value + share * step;
    q.gradient = below.gradient + share * (q.gradient - below.gradient);
    q.gradient.z() += 0.5 * step / cut.transition;
  }
  const double steepness = std::max(q.gradient.norm(), kTiny);
  return {q.value / steepness, q.gradient / steepness};
}

Side sideOfCut(const QuadricCut& cut, const Vec3& x, double radius) {
  const std::size_t first = cut.quadric.layerAt(x.z() - radius - cut.transition);
  const std::size_t last = cut.quadric.layerAt(x.z() + radius + cut.transition);
  bool isPositive = false;
  bool isNegative = false;
  for (std::size_t layer = first; layer <= last; ++layer) {
    const Moments& quadric = cut.quadric.quadrics[layer];
    const QuadricAt q = quadricAt(quadric, x);
    const double change = radius * (q.gradient.norm() + 0.5 * radius * curvatureOf(quadric));
    isPositive = isPositive || q.value > -change;
    isNegative = isNegative || q.value < change;
  }
  return isPositive && isNegative ? Side::Both : isPositive ? Side::Positive : Side::Negative;
}

} // namespace massprops
