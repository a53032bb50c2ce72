// How much hollowing out could be worth at most, whatever the cavity.
#pragma once

#include "core/optimum/layered_quadric.h"
#include "core/query/triangle_tree.h"

#include <cstddef>

namespace massprops {

/// Distances, sums and cuts are calculated to more digits than this; all are rounded outwards by
/// it.
constexpr double kOutwards = 1e-9;

/// Of the cubes that such a bound may look at, each about a microsecond.
constexpr std::size_t kMostCubes = 1500000;

/// At least the integral of the positive part of q over the points that keep the wall, and below
/// `enough` if the effort reaches. \pre the surface is closed and outward
double positivePartBound(const LayeredQuadric& q, const TriangleTree& surface, double wall,
                         double enough, std::size_t mostCubes = kMostCubes);

} // namespace massprops
