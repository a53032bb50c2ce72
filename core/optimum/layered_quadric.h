// What it is worth to hollow out a point, where contents stand at several levels.
#pragma once

#include "core/physics/moments.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace massprops {

/// The monomials (1, x, y, z, xx, yy, zz, xy, yz, zx) at a point.
inline Moments monomials(const Vec3& p) {
  Moments m;
  m << 1.0, p, p.cwiseAbs2(), p.x() * p.y(), p.y() * p.z(), p.z() * p.x();
  return m;
}

/// Of the quadric with these coefficients of the monomials.
inline Vec3 gradientAt(const Moments& quadric, const Vec3& p) {
  Mat3 hessian;
  hessian << 2.0 * quadric[4], quadric[7], quadric[9], //
      quadric[7], 2.0 * quadric[5], quadric[8],        //
      quadric[9], quadric[8], 2.0 * quadric[6];
  return quadric.segment<3>(1) + hessian * p;
}

/// A quadric in each of the horizontal layers between some heights, one at least.
struct LayeredQuadric {
  std::vector<double> heights; ///< ascending; one less than layers
  /// From below, by the coefficients of the monomials.
  std::vector<Moments> quadrics{Moments::Zero()};

  std::size_t layerAt(double z) const {
    return static_cast<std::size_t>(std::upper_bound(heights.begin(), heights.end(), z) -
                                    heights.begin());
  }
  static LayeredQuadric ofOneLayer(const Moments& quadric) { return {{}, {quadric}}; }

  double valueAt(const Vec3& x) const { return quadrics[layerAt(x.z())].dot(monomials(x)); }
};

} // namespace massprops
