// The quadric that bounds a cavity, as a length.
#pragma once

#include "core/optimum/layered_quadric.h"
#include "core/query/grid_function.h"

namespace massprops {

/// What a cavity is cut by: it lies on the positive side.
struct QuadricCut {
  LayeredQuadric quadric;
  /// Within this of a height between layers one quadric passes linearly into the other, so that a
  /// step there is no jump; length.
  double transition = 0.0;
};

/// The quadric over the length of its gradient, about a signed distance, and the unit gradient.
Sample cutAt(const QuadricCut& cut, const Vec3& x);

/// Its sign within `radius` of x; Both where it may vanish there.
enum class Side { Positive, Negative, Both };
Side sideOfCut(const QuadricCut& cut, const Vec3& x, double radius);

} // namespace massprops
