// The moments of a moved body in closed form, for comparison.
#pragma once

#include "core/physics/moments.h"

namespace massprops::testing {

/// Moments of the same body moved by t: ∫(x+t)(x+t)ᵀ = ∫xxᵀ + S tᵀ + t Sᵀ + V t tᵀ.
inline Moments translated(const Moments& moments, const Vec3& t) {
  const double V = moments[0];
  const Vec3 S = moments.segment<3>(1);
  const Mat3 added = S * t.transpose() + t * S.transpose() + V * t * t.transpose();
  Moments shift;
  shift << 0.0, V * t, added.diagonal(), added(0, 1), added(1, 2), added(2, 0);
  return moments + shift;
}

} // namespace massprops::testing
