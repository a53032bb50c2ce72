// Mending: holes that are defects, not openings.
#pragma once

#include "core/model/mending_step.h"

namespace massprops {

/// An opening that is no defect.
class LargeOpening : public InvalidInput {
public:
  using InvalidInput::InvalidInput;
};

/// Closes boundary loops by fair patches, or plainer ones where these cross their component: those
/// near the ground, as scans have them, by a taut one, and those whose patch has at most 5 % of the
/// area. Loops that run along another component, or whose patch would enclose nothing, stay open:
/// they are seams of a surface in pieces. \pre a coherently oriented 2-manifold
/// \throw LargeOpening where another loop is left: an opening as a vase has it
MendedMesh closedHoles(const TriangleMesh& input, const MendingTask& task);

/// The same with all loops, however large, but those whose patch would enclose nothing.
MendedMesh closedOpenings(const TriangleMesh& input, const MendingTask& task);

} // namespace massprops
