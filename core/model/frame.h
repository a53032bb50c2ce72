// The working frame: up is +z, the reference point is the origin, the diagonal is 1.
#pragma once

#include "core/base/options.h"
#include "core/base/types.h"

namespace massprops {

/// x_work = R (x_model − origin) / length
struct Frame {
  Mat3 rotation = Mat3::Identity(); ///< R, a permutation of the axes with determinant +1
  Vec3 origin = Vec3::Zero();       ///< in model coordinates
  double length = 1.0;              ///< model units per working unit
};

/// The rotation that takes `up` to +z and permutes the axes cyclically.
Mat3 rotationToUp(UpAxis up);

Points toWorking(const Frame& frame, const Points& model);
Points toModel(const Frame& frame, const Points& working);

/// Rounds to multiples of 2⁻³² (0.2 nanometres on a metre): scaling or moving a model changes the
/// last bits of its working coordinates, and the skeleton's comparisons must not see that.
Points snapped(Points working);
/// The next greater one on the same grid.
double snappedUp(double working);

/// By how much, in working lengths, a distance in model coordinates may fall short of the same one
/// between snapped vertices and points that came from working coordinates: each is moved by at most
/// √3·2⁻³³ by `snapped`, and its way between the frames is rounded.
double roundOff(const Frame& frame);

} // namespace massprops
