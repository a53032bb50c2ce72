// The volume that a surface encloses, with the sign of its orientation.
#pragma once

#include "core/base/types.h"

namespace massprops {

/// Positive when the closed surface is oriented outwards; length³. Summed from the first face's
/// first corner, so that it does not cancel far from the origin. `vertices` may have more than the
/// faces use. \pre closed
double signedVolume(const Points& vertices, const Faces& faces);

/// Turns every triangle over: counter-clockwise becomes clockwise.
inline void flip(Faces& faces) {
  faces.col(1).swap(faces.col(2));
}

} // namespace massprops
