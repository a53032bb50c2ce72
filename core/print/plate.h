// A body as it stands in the printer.
#pragma once

#include "core/base/options.h"
#include "core/base/types.h"

namespace massprops {

/// x_plate = R x_model + shift, millimetres; the plate is the plane z = 0.
struct PlatePose {
  Mat3 rotation = Mat3::Identity();
  Vec3 shift = Vec3::Zero();

  Points operator()(const Points& model) const;
  Vec3 operator()(const Vec3& model) const { return rotation * model + shift; }
};

/// Turned so that the build axis is up, set down with the middle of its bounding box over the
/// origin.
PlatePose poseOnPlate(const Points& model, const Options& options);

} // namespace massprops
