// Where a floating body comes to rest.
#pragma once

#include "core/physics/inclination.h"

namespace massprops {

struct FloatingPose {
  bool floats = false; ///< else it sinks, and all below is that of the sinking body
  bool submerged = false;
  Vec3 up = Vec3::UnitZ(); ///< of the water, in the body's frame
  double draught = 0.0;    ///< of the lowest point below the water's surface
  double energy = 0.0;     ///< over the weight, less a constant: length, comparable between poses
  /// Least and greatest metacentric height over all axes; negative: unstable.
  double leastMetacentricHeight = 0.0, greatestMetacentricHeight = 0.0;
};

/// Follows the potential energy down from the body set into the water with `up` (unit) upwards: an
/// unstable equilibrium is left. docs/math.md "Floating pose"
FloatingPose floatingPose(const FloatingBody& body, const Vec3& up = Vec3::UnitZ());

} // namespace massprops
