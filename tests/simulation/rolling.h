// Where a body comes to rest that is set down any way round.
#pragma once

#include "simulation/world.h"

#include <vector>

namespace simulation {

/// The body's direction that points down at rest, for each of `count` orientations spread over all
/// of them in which it is dropped from 2 % of its diagonal. It rolls without slip; air takes its
/// motion, for facets alone would let it rock for long.
std::vector<Vector3d> restsAfterDrops(const Body& body, int count);

/// The same when it is set down upright and nudged.
Vector3d restWhenSetDown(const Body& body);

} // namespace simulation
