// A signed length sampled at the nodes of a grid, where it vanishes and next to that.
#pragma once

#include "core/query/grid_function.h"

#include <functional>
#include <vector>

namespace massprops {

/// At a point, positive inside, exact up to a horizon; lengths in the unit of x.
using SignedLength = std::function<double(const Vec3& x, double horizon)>;

/// Values are known up to so many edges from where they vanish.
constexpr float kSampledBand = 4.0F;

/// Around the points, with the band on each side. `edge`: a length in their unit, made longer
/// where there would be more than about `mostNodes` nodes.
Grid gridAround(const Points& points, const Mat3& rotation, double edge, double mostNodes);

/// At every node, in edges, at most `kSampledBand`. `makeLength`: for each block of nodes anew, for
/// it may remember the last point.
std::vector<float> sampled(const Grid& grid, const std::function<SignedLength()>& makeLength);

} // namespace massprops
