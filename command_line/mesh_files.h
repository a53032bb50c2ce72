// Files of meshes.
#pragma once

#include "core/answer/picture.h"
#include "core/base/types.h"

#include <string>
#include <vector>

namespace massprops {

struct MeshFile {
  TriangleMesh mesh;         ///< in STL, which knows no common corners, equal ones are merged
  std::vector<int> selected; ///< faces that a PLY file has selected, ascending
};

/// STL, PLY, OBJ or OFF by the name's suffix.
/// \throw InvalidInput when it cannot be read
MeshFile readMesh(const std::string& path);

/// Vertices at the same place become one.
TriangleMesh withoutEqualVertices(const TriangleMesh& mesh);

/// \throw InvalidInput when the suffix is that of no format that can be written
void requireMeshFormat(const std::string& path);

/// Whether the format keeps coordinates in double precision: STL does not.
bool keepsDoubles(const std::string& path);

/// `quality`: a value for every vertex, which PLY keeps, or none.
/// \throw std::runtime_error when it cannot be written
void writeMesh(const std::string& path, const TriangleMesh& mesh, const Vector& quality = {});
void writeMesh(const std::string& path, const ColouredMesh& mesh);

} // namespace massprops
