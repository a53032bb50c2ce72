#include "core/goals/tipping.h"

#include "core/base/angles.h"
#include "core/base/soft_maximum.h"

#include <cmath>
#include <cstddef>

namespace massprops {
namespace {

/// Neighbouring edges of a polygon with more count as one where they turn by no more than a full
/// turn through this number: the solver's time grows with them.
constexpr std::size_t kMostSides = 64;
constexpr int kAround = 72;

std::vector<Vec2> edgeNormals(const std::vector<Vec2>& polygon) {
  std::vector<Vec2> normals;
  normals.reserve(polygon.size());
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    normals.push_back(Vec2(edge.y(), -edge.x()).normalized());
  }
  return normals;
}

} // namespace

double tippingAngleOf(const ContactArea& area, const Moments& massMoments) {
  return tippingAngle(area, massProperties(massMoments).centerOfMass);
}

std::vector<TippingDirection> tippingDirections(const ContactArea& area) {
  std::vector<TippingDirection> directions;
  const auto add = [&](const Vec2& unit) { directions.push_back({unit, extent(area, unit)}); };
  if (!area.radii) {
    const std::vector<Vec2> normals = edgeNormals(area.polygon);
    const double turn = normals.size() > kMostSides ? 2.0 * kPi / kMostSides : 0.0;
    for (const Vec2& normal : normals) {
      const bool isNext =
          turn == 0.0 || directions.empty() || directions.back().unit.dot(normal) < std::cos(turn);
      if (isNext) add(normal);
    }
  }
  for (int i = 0; i < kAround; ++i) {
    const double angle = 2.0 * kPi * i / kAround;
    add({std::cos(angle), std::sin(angle)});
  }
  return directions;
}

GoalValue negativeSmoothTipping(const std::vector<TippingDirection>& directions,
                                const Moments& massMoments) {
  // (u·c − extent)/c_z = (u·S − extent m)/S_z
  const auto count = static_cast<Eigen::Index>(directions.size());
  Vector beyond(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const TippingDirection& d = directions[static_cast<std::size_t>(i)];
    beyond[i] =
        (d.unit.dot(massMoments.segment<2>(1)) - d.extent * massMoments[0]) / massMoments[3];
  }
  const SoftMaximum worst = softMaximum(beyond, kTippingSharpness);
  GoalValue f;
  f.value = worst.value;
  for (Eigen::Index i = 0; i < count; ++i) {
    const TippingDirection& d = directions[static_cast<std::size_t>(i)];
    const double factor = worst.shares[i] / massMoments[3];
    f.gradient[0] -= factor * d.extent;
    f.gradient.segment<2>(1) += factor * d.unit.transpose();
    f.gradient[3] -= factor * beyond[i];
  }
  return f;
}

LinearConditions standingConditions(const std::vector<TippingDirection>& directions) {
  const auto count = static_cast<Eigen::Index>(directions.size());
  LinearConditions conditions{AffineRows::Zero(count, 11), AffineRows::Zero(count, 11)};
  for (Eigen::Index i = 0; i < count; ++i) {
    const TippingDirection& d = directions[static_cast<std::size_t>(i)];
    conditions.atZero(i, 0) = -d.extent;
    conditions.atZero.row(i).segment<2>(1) = d.unit.transpose();
  }
  conditions.slopes.col(3).setOnes();
  return conditions;
}

} // namespace massprops
