// How far two triangles are from each other.
#pragma once

#include "core/base/types.h"

namespace massprops {

/// The squared distance of s and t where it is below the bound, else no less than the bound, up to
/// a billionth. Going to the nearest point back and forth between the two ends at their shortest
/// way, which a gap along it proves [CG59]; where that takes long, or the way is too short for its
/// direction to be known, all features are compared.
double squaredDistanceBelow(double squaredBound, const Vec3 (&s)[3], const Vec3 (&t)[3]);

} // namespace massprops
