// The sample meshes of the repository.
#pragma once

#include "core/base/types.h"

#include <string>

namespace massprops::testing {

/// `name`: without folder and ending.
/// \throw std::runtime_error when there is no such file
TriangleMesh sampleMesh(const std::string& name);

} // namespace massprops::testing
