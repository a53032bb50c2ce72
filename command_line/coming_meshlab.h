// What the coming MeshLab is told of its filters.
#pragma once

#include <string>

namespace massprops {

/// Its file `filters.json` with our filter: docs/hosts.md.
std::string filtersOfComingMeshLab();

} // namespace massprops
