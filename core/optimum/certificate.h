// A proof that no cavity can do what is asked for.
#pragma once

#include "core/goals/goal.h"
#include "core/optimum/level_bound.h"
#include "core/query/triangle_tree.h"

#include <optional>

namespace massprops {

/// A functional w of (M, 1), working frame, density 1, that is at least `margin` > 0 for every body
/// that is hollow where the wall allows it; and yet ≤ 0 for every one that meets some conditions,
/// for it is their sum with the multipliers. [docs/math.md "Out of reach"]
struct Certificate {
  Eigen::Matrix<double, 11, 1> functional;
  Vector multipliers; ///< ≥ 0, a condition each; none: w itself says where centres of mass are
  AffineRows rows;    ///< the conditions at the wanted level
  double margin;
};

/// The proof with the multipliers of the bound, for bodies that keep the wall from a closed outward
/// surface. What the surface's cells contribute is bounded from above: distances bound how much of
/// a cube may be hollow, values at its corners how much that is worth; cubes are divided until the
/// sum is small enough. Empty: not proved with the effort that is worth its time.
/// `solid`, `fillDensity`: as in `greatestLevel`. `wall`: working length.
std::optional<Certificate> certificate(const LinearConditions& conditions, double wantedLevel,
                                       const LevelBound& bound, const Moments& solid,
                                       double fillDensity, const TriangleTree& surface,
                                       double wall);

/// The proof that no centre of mass is outside of a half-space, w being limit m − normal·S.
std::optional<Certificate> certificate(const Vec3& normal, double limit, const Moments& solid,
                                       double fillDensity, const TriangleTree& surface,
                                       double wall);

/// At least ∫ max(0, q) over the points that keep the wall, q(x) = (1, x, y, z, xx, yy, zz, xy, yz,
/// zx)·quadric, and below `enough` if the effort reaches.
double positivePartBound(const Moments& quadric, const TriangleTree& surface, double wall,
                         double enough);

} // namespace massprops
