// Defects that no slicer minds, mended in the filter's own copy.
#pragma once

#include "core/model/mending_step.h"
#include "core/model/repair.h"

namespace massprops {

/// The model as a solid, if it can be made one: seams joined, faces oriented, touching parts
/// parted, holes closed, crossings removed, overlapping bodies united; the rest wrapped. Every step
/// only where it is needed, and checked by exact predicates. What was done is in the repairs. A
/// model that defies all of it comes back as far as it could be mended. \throw InvalidInput where
/// an opening is too large to be a hole
RepairedMesh mended(const TriangleMesh& input, const MendingTask& task);

} // namespace massprops
