// On which faces a body comes to rest.
#pragma once

#include "core/base/types.h"

namespace massprops {

/// The convex hull of a body, with what is needed to roll it.
struct RollingHull {
  Points vertices; ///< h×3
  Faces faces;     ///< outward
};

/// \throw InvalidInput when all points lie in one plane
RollingHull rollingHull(const Points& vertices);

struct StablePoses {
  /// Minima of the height of the centre of mass that a push over less than `barrier` does not
  /// leave.
  int count = 0;
  /// Unit vector of the body that points down in the pose it rolls to when it is set down upright.
  Vec3 down = -Vec3::UnitZ();
};

/// Poses in which the hull rests stably on level ground with its centre of mass at `centre`,
/// inside of the hull. `barrier` > 0: heights over which the body rolls by its own unrest, same
/// unit; without it every facet of a round foot would count. docs/math.md "Roll upright"
StablePoses stablePoses(const RollingHull& hull, const Vec3& centre, double barrier);

} // namespace massprops
