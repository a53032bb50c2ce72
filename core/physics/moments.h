// The ten integrals over a closed surface's inside, and how they change when its vertices move.
#pragma once

#include "core/base/types.h"

namespace massprops {

/// ∫dV of (1, x, y, z, xx, yy, zz, xy, yz, zx); units: length³, length⁴ (3 of them), length⁵ (6).
using Moments = Eigen::Matrix<double, 10, 1>;

/// n×10 or n×4: row i is the rate of the moments, all or those of degree 0 and 1, while vertex i
/// moves with unit speed along its direction and all others rest.
using MomentRates = RowMatrix;

/// Positive volume for outward orientation. The surface must be closed; the origin should be near
/// it, for the integrals cancel far away. [Ton05, docs/math.md "Moments"]
/// `withSecond`: if not, those of degree 2 are left 0, which saves half of the time.
Moments moments(const Points& vertices, const Faces& faces, bool withSecond = true);

struct MomentsWithRates {
  Moments moments;
  MomentRates rates; ///< n×10 or n×4
};

/// `moments`, and their exact derivative when vertex i moves along row i of `directions` (n×3, any
/// length). docs/math.md "Derivative of the moments".
/// `withSecond`: with the moments of degree 2 and their rates.
MomentsWithRates momentsWithRates(const Points& vertices, const Faces& faces,
                                  const Points& directions, bool withSecond = true);

/// The 3×3 matrix ∫ x xᵀ dV in the last six entries.
Mat3 secondMoment(const Moments& moments);

} // namespace massprops
