// Triangles without area.
#pragma once

#include "core/base/types.h"

#include <vector>

namespace massprops {

/// Share of the product of two lengths, far above the rounding of their cross product: beyond it
/// the sign of a determinant is known.
constexpr double kSafe = 1e-11;

/// Faces without area, ascending. Exact.
std::vector<int> facesWithoutArea(const Points& vertices, const Faces& faces);

} // namespace massprops
