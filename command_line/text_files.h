// OBJ and OFF in full precision: VCG writes the first with six decimals and the second with 16
// digits, and its OBJ reader of 2020.09 loses the faces at the first vertex.
#pragma once

#include "core/base/types.h"

#include <string>

namespace massprops {

/// Polygons are cut into triangles that share their first corner. False when it cannot be read.
bool readObj(const std::string& path, TriangleMesh& mesh);

/// False when it cannot be written.
bool writeObj(const std::string& path, const TriangleMesh& mesh);
bool writeOff(const std::string& path, const TriangleMesh& mesh);

} // namespace massprops
