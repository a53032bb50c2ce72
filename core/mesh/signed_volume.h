// The volume that a surface encloses, with the sign of its orientation.
#pragma once

#include "core/base/types.h"

#include <utility>

namespace massprops {

/// Positive when the closed surface is oriented outwards; length³. Summed from the first face's
/// first corner, so that it does not cancel far from the origin. `vertices` may have more than the
/// faces use. \pre closed
double signedVolume(const Points& vertices, const Faces& faces);

/// Turns every triangle over: counter-clockwise becomes clockwise.
inline void flip(Faces& faces) {
  for (Eigen::Index f = 0; f < faces.rows(); ++f) std::swap(faces(f, 1), faces(f, 2));
}

} // namespace massprops
