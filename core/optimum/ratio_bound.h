// How small a ratio of moments can be made under linear conditions.
#pragma once

#include "core/optimum/extreme_bodies.h"

#include <functional>

namespace massprops {

/// The least |across·(M,1)| / divisor·(M,1) over bodies with the moments M that have
/// equal·(M,1) = 0, less·(M,1) ≤ 0, and the matrix ((c₀, c₂), (c₂, c₁)) of c = cone·(M,1) without a
/// positive eigenvalue. A convex problem for each level of the ratio.
struct RatioProblem {
  AffineRows across; ///< 3×11, the first two positive for all bodies; or 1×11, taken with its sign
  AffineRow divisor; ///< positive for all bodies
  AffineRows equal = AffineRows(0, 11), less = AffineRows(0, 11);
  AffineRows cone = AffineRows(0, 11); ///< 3×11 or empty
  double open = 0.0;                   ///< the last of `equal` may be anything from −open to open
};

/// What is to be high, a function of the least ratios at the two ends of what is open, and its
/// derivatives.
struct Worth {
  double value, byLow, byHigh;
};

/// By weak duality: with a unit vector u, multipliers μ of any sign, ν ≥ 0 and a positive
/// semidefinite Y, u·across + μ·equal + ν·less + Y:cone is no more than |across| for the bodies
/// that meet the conditions, and what has the least ratio of that to the divisor is hollow on one
/// side of a quadric. [docs/math.md "How low Spin and Yo-yo can be"]
struct RatioBound {
  double value = 0.0;           ///< worth of the ratios that the dual variables prove
  double low = 0.0, high = 0.0; ///< these: no body within the cells has less at −open and open
  AffineRow dividend;           ///< that sum, what is open being in the middle
  Vec3 unit = Vec3::UnitX();    ///< u
  Moments body;                 ///< with the least ratio at −open
  Vector roots = {};            ///< the dual variables, for the start of a similar problem
};

/// The dual variables with the highest worth. `roots`: of a problem with as many rows, or empty.
/// `start`: any body.
RatioBound ratioBound(const RatioProblem& problem,
                      const std::function<Worth(double low, double high)>& worth,
                      const ExtremeBodies& bodies, const Vector& roots, const Moments& start);

} // namespace massprops
