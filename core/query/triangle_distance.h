// How far two triangles are from each other.
#pragma once

#include "core/base/types.h"

namespace massprops {

/// Distances are measured to a billionth.
constexpr double kMeasured = 1e-9;

/// Of pq and rs. [Eri05, Sec. 5.1.9]
double squaredDistanceOfSegments(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s);

/// The point of the triangle (a, b, c) next to p.
Vec3 nearestOnTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// The squared distance of s and t where it is below the bound, else no less than the bound, up to
/// `kMeasured`. Going to the nearest point back and forth between the two ends at their shortest
/// way, which a gap along it proves [CG59]; where that takes long, or the way is too short for its
/// direction to be known, all features are compared.
double squaredDistanceBelow(double squaredBound, const Vec3 (&s)[3], const Vec3 (&t)[3]);

} // namespace massprops
