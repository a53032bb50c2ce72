// Parts of a surface that need not be a manifold.
#pragma once

#include "core/base/types.h"

#include <vector>

namespace massprops {

/// Faces that are connected across edges of two faces which agree in orientation; in the order of
/// their first faces.
std::vector<std::vector<int>> manifoldPatches(const Faces& faces);

} // namespace massprops
