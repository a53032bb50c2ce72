#include "core/goals/tipping.h"

#include "core/base/circle.h"
#include "core/base/soft_maximum.h"

#include <cmath>
#include <cstddef>

namespace massprops {

std::vector<Vec2> edgeNormals(const std::vector<Vec2>& polygon) {
  std::vector<Vec2> normals;
  normals.reserve(polygon.size());
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    normals.push_back(Vec2(edge.y(), -edge.x()).normalized());
  }
  return normals;
}

std::vector<PolygonSide> polygonSides(const std::vector<Vec2>& normals) {
  const double alike = normals.size() > kAround ? onCircle(1).x() : 1.0;
  std::vector<PolygonSide> sides;
  for (std::size_t e = 0; e < normals.size(); ++e) {
    if (sides.empty() || alike == 1.0 || normals[sides.back().first].dot(normals[e]) < alike)
      sides.push_back({e, e});
    sides.back().last = e + 1;
  }
  return sides;
}

double tippingAngleOf(const ContactArea& area, const Moments& massMoments) {
  return tippingAngle(area, massProperties(massMoments).centerOfMass);
}

std::vector<TippingDirection> tippingDirections(const ContactArea& area) {
  std::vector<TippingDirection> directions;
  const auto add = [&](const Vec2& unit) { directions.push_back({unit, extent(area, unit)}); };
  if (!area.radii) {
    const std::vector<Vec2> normals = edgeNormals(area.polygon);
    for (const PolygonSide& side : polygonSides(normals)) add(normals[side.first]);
  }
  for (int i = 0; i < kAround; ++i) add(onCircle(i));
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
