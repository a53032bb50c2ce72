// How much hollowing out could be worth at most, whatever the cavity.
#pragma once

#include "core/optimum/layered_quadric.h"
#include "core/query/triangle_tree.h"

namespace massprops {

/// Distances, sums and cuts are calculated to more digits than this; all are rounded outwards by
/// it.
constexpr double kOutwards = 1e-9;

/// At least the integral of the positive part of q over the points that keep the wall, and below
/// `enough` if the effort reaches.
double positivePartBound(const LayeredQuadric& q, const TriangleTree& surface, double wall,
                         double enough);

} // namespace massprops
