#include "core/physics/rolling_metacentres.h"

#include "core/base/circle.h"
#include "core/base/interruption.h"

#include <cmath>

namespace massprops {
namespace {

/// Steps of 4°, the first ones asking for a rest no farther than 2° off upright, up to 148°: from
/// its highest poses a body rolls off to one side or another. docs/math.md "Roll upright"
constexpr double kStep = kPi / 45.0;
constexpr Eigen::Index kTilts = 37;

} // namespace

RollingMetacentres rollingMetacentres(const Points& points) {
  RollingMetacentres result;
  result.slopes.resize(kTilts * kAround, 2);
  result.heights.resize(kTilts * kAround);
  for (int meridian = 0; meridian < kAround; ++meridian) {
    checkpoint();
    const Vec2 outwards = onCircle(meridian);
    const Vector along = points.leftCols<2>() * outwards;
    const auto support = [&](double tilt) {
      return (std::sin(tilt) * along - std::cos(tilt) * points.col(2)).maxCoeff();
    };
    double below = support(0.0);
    for (Eigen::Index t = 0; t < kTilts; ++t) {
      // h(u) = H(u) − u·c, u = (sin ϑ e, −cos ϑ): the rise over a step, by its length in −cos ϑ.
      const double middle = (static_cast<double>(t) + 0.5) * kStep;
      const double above = support(static_cast<double>(t + 1) * kStep);
      const Eigen::Index row = meridian * kTilts + t;
      result.slopes.row(row) = outwards.transpose() / std::tan(middle);
      result.heights[row] = (above - below) / (2.0 * std::sin(middle) * std::sin(0.5 * kStep));
      below = above;
    }
  }
  return result;
}

} // namespace massprops
