// Triangles without area.
#pragma once

#include "core/base/types.h"

#include <vector>

namespace massprops {

/// Faces without area, ascending. Exact.
std::vector<int> facesWithoutArea(const Points& vertices, const Faces& faces);

} // namespace massprops
