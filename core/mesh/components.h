// The connected parts of a surface.
#pragma once

#include "core/base/types.h"

#include <vector>

namespace massprops {

/// One closed component: rows of the mesh's faces, still indexing the mesh's vertices.
using Components = std::vector<Faces>;

/// For every vertex the number of its component, by the order of their first faces; −1 for a vertex
/// that no face uses.
std::vector<int> componentNumbers(Eigen::Index vertexCount, const Faces& faces);

/// The faces of each connected component, in the order of their first face.
Components connectedComponents(Eigen::Index vertexCount, const Faces& faces);

/// The mesh that some faces describe, without vertices they do not use; order is kept.
struct Submesh {
  TriangleMesh mesh;
  std::vector<int> vertexOf; ///< for every vertex its number in the whole mesh
};
Submesh submesh(const Points& vertices, const Faces& faces);

/// Each connected component as a mesh of its own, in the order of their first face. All together
/// take time linear in the mesh's size, however many they are.
std::vector<Submesh> componentMeshes(const Points& vertices, const Faces& faces);

/// All rows, one part after the other.
Faces joined(const std::vector<Faces>& parts);

/// All of them side by side in one, nothing merged.
TriangleMesh assembled(const std::vector<TriangleMesh>& parts);

} // namespace massprops
