// Solids as implicit functions: negative inside, positive outside, about the signed distance near
// the surface. Only +, −, ×, ÷ and square roots are used, so every machine computes the same bits.
#pragma once

#include <Eigen/Core>

#include <functional>

namespace samples {

using Vec3 = Eigen::Vector3d;
using Implicit = std::function<double(const Vec3&)>;

Implicit ellipsoid(const Vec3& center, const Vec3& radii);
inline Implicit ball(const Vec3& center, double radius) {
  return ellipsoid(center, Vec3::Constant(radius));
}
/// The convex hull of two balls.
Implicit roundCone(const Vec3& a, double radiusA, const Vec3& b, double radiusB);
/// Box centred at the origin whose edges and corners are rounded by `radius`.
Implicit roundedBox(const Vec3& size, double radius);
/// A chain link about the y axis, centred at the origin: a torus cut in half and drawn apart along
/// z by straight pieces of length `straight`.
Implicit chainLink(double majorRadius, double minorRadius, double straight);

/// Union whose seam is blended twice differentiably over a width of about `blend`.
Implicit smoothUnion(Implicit a, Implicit b, double blend);
/// Smooth union of the solid and its mirror image at y = 0.
Implicit mirroredY(const Implicit& solid, double blend);
/// The solid seen from a frame whose axes are the columns of `rotation` and whose origin is
/// `translation`.
Implicit moved(Implicit solid, const Eigen::Matrix3d& rotation, const Vec3& translation);

/// Rotation about `axis` by the angle whose tangent of the half is `tangentOfHalf`.
Eigen::Matrix3d rotation(const Vec3& axis, double tangentOfHalf);

/// Central differences.
Vec3 gradient(const Implicit& solid, const Vec3& p);

} // namespace samples
