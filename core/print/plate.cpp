#include "core/print/plate.h"

#include "core/model/frame.h"

namespace massprops {
Points PlatePose::operator()(const Points& model) const {
  return (model * rotation.transpose()).rowwise() + shift.transpose();
}

PlatePose poseOnPlate(const Points& model, const Options& options) {
  PlatePose pose;
  pose.rotation = rotationToUp(buildAxisOf(options));
  const Points turned = pose(model);
  const Vec3 lowest = turned.colwise().minCoeff().transpose();
  const Vec3 highest = turned.colwise().maxCoeff().transpose();
  pose.shift = -0.5 * (lowest + highest);
  pose.shift.z() = -lowest.z();
  return pose;
}

} // namespace massprops
