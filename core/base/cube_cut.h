// The part of a cube behind a plane.
#pragma once

#include "core/base/types.h"

namespace massprops {

struct CubeCut {
  double volume = 0.0;          ///< 0…1
  Vec3 centroid = Vec3::Zero(); ///< meaningless without volume
};

/// Of the points x of the unit cube about the origin with normal·x ≥ depth. `normal`: unit; one
/// nearer to a face's plane than 0.6° is turned off it by that. By inclusion and exclusion of the
/// simplices at the eight corners. [SZ00, Eq. 13]
CubeCut cubeCut(const Vec3& normal, double depth);

} // namespace massprops
