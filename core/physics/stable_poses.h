// On which faces a body comes to rest.
#pragma once

#include "core/physics/half_spaces.h"

#include <vector>

namespace massprops {

/// The convex hull of a body, with what is needed to roll it.
struct RollingHull {
  struct Edge {
    int face, other; ///< on its two sides
    int from, to;    ///< vertices, in the order of `face`
  };
  Points vertices; ///< h×3
  Faces faces;     ///< outward
  std::vector<Edge> edges;
};

/// \throw InvalidInput when all points lie in one plane
RollingHull rollingHull(const Points& vertices);

struct StablePoses {
  /// Minima of the height of the centre of mass that a push over less than `barrier` does not
  /// leave: the unit vector of the body that points down in each, the lowest pose last.
  std::vector<Vec3> rests;
  /// The same for the pose it rolls to when it is set down upright.
  Vec3 down = -Vec3::UnitZ();
};

/// Poses in which the hull rests stably on level ground with its centre of mass at `centre`,
/// inside of the hull. `barrier` > 0: heights over which the body rolls by its own unrest, same
/// unit; without it every facet of a round foot would count. docs/math.md "Roll upright"
StablePoses stablePoses(const RollingHull& hull, const Vec3& centre, double barrier);

/// Sets of centres of mass, inside of the hull, for which the body does not always come back
/// upright, −z pointing down: from a pose that is more than `away` radians off upright every way
/// there leads over `barrier` or more, or no pose nearer to upright is as low. For each stable pose
/// at `centre` one that is wide around it, where there is one. docs/math.md "Roll upright"
std::vector<HalfSpaces> restingWells(const RollingHull& hull, const Vec3& centre, double barrier,
                                     double away);

} // namespace massprops
