// The volume that triangles enclose which need not be closed.
#pragma once

#include "core/base/types.h"

namespace massprops {

/// Counted at 16,384 points scattered in the box: a tenth of the box to 2 %.
struct WindingVolume {
  double volume =
      0.0; ///< where the first mesh goes round at least half of a time, either way, length³
  double otherVolume = 0.0; ///< the same of the second mesh, at the same places
};

/// Both in the same box, so that their difference is better than either.
WindingVolume windingVolumes(const TriangleMesh& mesh, const TriangleMesh& other);

} // namespace massprops
