// Mending: faces that agree which side is outside.
#pragma once

#include "core/model/mending_step.h"

namespace massprops {

/// Turns faces over so that neighbours across edges of two faces agree; a connected patch that this
/// concerns, or that ends where more than two faces meet, faces outward by the parity of crossings
/// from its faces outwards, where that is clear.
MendedMesh orientedShells(const TriangleMesh& input, const MendingTask& task);

} // namespace massprops
