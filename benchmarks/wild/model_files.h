// Models in files, as the host opens them.
#pragma once

#include "core/base/types.h"

#include <string>
#include <vector>

namespace massprops::wild {

/// STL, OBJ, OFF and PLY files, sorted; folders with all that is in them.
std::vector<std::string> modelFiles(const std::vector<std::string>& paths);

/// Equal vertices merged, longest side 100, coordinates as a float mesh stores them; empty where it
/// cannot be read. name.obj:2 is the model with every triangle cut in four, twice.
TriangleMesh readModel(const std::string& file);

} // namespace massprops::wild
