// The mean curvature skeleton, as the point that every surface vertex shrinks to.
#pragma once

#include "core/solid.h"
#include "core/types.h"

namespace massprops {

/// n×3: row i is the skeleton point to which vertex i contracts under mean curvature flow,
/// medially centred. [TAOZ12]
/// Two calls with the same coordinates give the same bytes, whatever the program did before.
/// \pre the coordinates are of order one and far fewer digits than a double has (see `snapped`)
/// \throw std::runtime_error when the flow leaves a vertex without a skeleton point
Points meanCurvatureSkeleton(const Points& vertices, const Faces& faces);

} // namespace massprops
