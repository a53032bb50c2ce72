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
