// Defects that no slicer minds, mended in the filter's own copy.
#pragma once

#include "core/model/mending_step.h"
#include "core/model/solid.h"

#include <optional>

namespace massprops {

/// The model as a solid: seams joined, faces oriented, touching parts parted, holes closed,
/// crossings removed, overlapping bodies united; the rest wrapped. Every step only where it is
/// needed; nothing crosses, by exact predicates. What was done is in the repairs. Empty where the
/// model defies all of it. \throw InvalidInput where an opening is too large to be a hole
std::optional<Solid> mended(const TriangleMesh& input, const MendingTask& task);

} // namespace massprops
