// The sample meshes of the repository.
#pragma once

#include "core/base/types.h"

#include <string>
#include <vector>

namespace massprops::testing {

/// `name`: without folder and ending.
/// \throw std::runtime_error when there is no such file
TriangleMesh sampleMesh(const std::string& name);

/// Any model in a format that CGAL reads, by its ending. \throw std::runtime_error as above
TriangleMesh meshFile(const std::string& path);

/// Paths of all sample meshes, by name.
std::vector<std::string> sampleFiles();

} // namespace massprops::testing
