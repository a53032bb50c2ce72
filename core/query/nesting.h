// Which parts of a surface lie inside of which.
#pragma once

#include "core/mesh/components.h"

#include <vector>

namespace massprops {

/// For every component how many others enclose it: 0 is outermost. Exact.
/// \pre the components are closed and do not cross each other
std::vector<int> nestingDepths(const Points& vertices, const Components& components);

} // namespace massprops
