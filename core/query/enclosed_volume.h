// The volume that triangles enclose which need not be closed.
#pragma once

#include "core/base/types.h"

namespace massprops {

/// Where the triangles go round, either way and however often, length³: measured along 128 × 128
/// lines parallel to an axis. A line that enters the surface more often than it leaves it passes
/// through a gap and counts as the mean of the others. Of the three axes the one with the most area
/// of other lines tells.
double enclosedVolume(const TriangleMesh& mesh);

} // namespace massprops
