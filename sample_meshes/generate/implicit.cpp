#include "implicit.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <utility>

namespace samples {

Implicit ellipsoid(const Vec3& center, const Vec3& radii) {
  return [=](const Vec3& p) {
    // First-order distance: the implicit equation over the length of its gradient.
    const Vec3 q = (p - center).cwiseQuotient(radii);
    const double k0 = q.norm();
    const double k1 = q.cwiseQuotient(radii).norm();
    return k1 > 0 ? k0 * (k0 - 1) / k1 : -radii.minCoeff();
  };
}

Implicit roundCone(const Vec3& a, double radiusA, const Vec3& b, double radiusB) {
  // The nearest ball of the family between a and b lies ahead of the foot of the perpendicular by
  // a constant slope.
  const double length = (b - a).norm();
  const Vec3 axis = (b - a) / length;
  const double sine = (radiusB - radiusA) / length;
  const double slope = sine / std::sqrt(1 - sine * sine);
  return [=](const Vec3& p) {
    const double along = (p - a).dot(axis);
    const double across = (p - a - along * axis).norm();
    const double t = std::clamp(along + slope * across, 0.0, length);
    const double radius = radiusA + (radiusB - radiusA) * t / length;
    return (p - a - t * axis).norm() - radius;
  };
}

Implicit roundedBox(const Vec3& size, double radius) {
  const Vec3 inner = size / 2 - Vec3::Constant(radius);
  return [=](const Vec3& p) {
    const Vec3 q = p.cwiseAbs() - inner;
    return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0) - radius;
  };
}

Implicit chainLink(double majorRadius, double minorRadius, double straight) {
  return [=](const Vec3& p) {
    const double z = p.z() - std::clamp(p.z(), -straight / 2, straight / 2);
    const double ring = std::sqrt(p.x() * p.x() + z * z) - majorRadius;
    return std::sqrt(ring * ring + p.y() * p.y()) - minorRadius;
  };
}

Implicit smoothUnion(Implicit a, Implicit b, double blend) {
  return [a = std::move(a), b = std::move(b), blend](const Vec3& p) {
    const double da = a(p);
    const double db = b(p);
    const double h = std::max(blend - std::abs(da - db), 0.0) / blend;
    return std::min(da, db) - h * h * h * blend / 6;
  };
}

Implicit mirroredY(const Implicit& solid, double blend) {
  const Implicit image = [solid](const Vec3& p) { return solid(Vec3(p.x(), -p.y(), p.z())); };
  return smoothUnion(solid, image, blend);
}

Implicit moved(Implicit solid, const Eigen::Matrix3d& rotation, const Vec3& translation) {
  return [solid = std::move(solid), rotation, translation](const Vec3& p) {
    return solid(rotation.transpose() * (p - translation));
  };
}

Eigen::Matrix3d rotation(const Vec3& axis, double tangentOfHalf) {
  const Vec3 v = axis.normalized() * tangentOfHalf;
  return Eigen::Quaterniond(1, v.x(), v.y(), v.z()).normalized().toRotationMatrix();
}

Vec3 gradient(const Implicit& solid, const Vec3& p) {
  constexpr double step = 1e-4;
  Vec3 g;
  for (int i = 0; i < 3; ++i) {
    const Vec3 d = step * Vec3::Unit(i);
    g[i] = (solid(p + d) - solid(p - d)) / (2 * step);
  }
  return g;
}

} // namespace samples
