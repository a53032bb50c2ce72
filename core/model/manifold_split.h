// Mending: edges and vertices where parts of the surface touch.
#pragma once

#include "core/model/mending_step.h"

namespace massprops {

/// Parts the surface along edges of more than two faces and at vertices with more than one fan, so
/// that each wedge of material has a surface of its own, and moves these edges and vertices apart,
/// into the material, by little. \pre neighbours agree in orientation, as far as they can
MendedMesh splitToManifold(const TriangleMesh& given, const MendingTask& task);

} // namespace massprops
