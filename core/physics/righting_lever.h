// How a floating body answers when it is heeled, and how far it comes back from.
#pragma once

#include "core/base/angles.h"
#include "core/physics/floating_equilibria.h"

#include <vector>

namespace massprops {

/// Between points of the curve of levers, radians; tilts that differ by less count as one, and an
/// opening that is under water on less of the way is not seen.
constexpr double kHeelStep = 5.0 / kDegrees;

struct RightingLever {
  double heel;  ///< radians
  double lever; ///< GZ, length; positive: it turns back
};

/// Angles in radians, of `up` off that of the pose; π where the body comes back from everywhere.
struct Stability {
  /// Angle of vanishing stability: of the nearest unstable equilibrium through which the body can
  /// leave its pose, trim being free; or less, where an opening gets under water.
  double vanishing = 0.0;
  /// From every heel below this, in whatever direction and without trimming first, the lever turns
  /// the body back. Not above `vanishing`.
  double safe = 0.0;
  bool floods = false;   ///< whether it is an opening that gets under water there
  double flooding = kPi; ///< the least heel at which one does before the lever vanishes
  /// Potential energy over the weight there, less that of the pose; 0 where it never vanishes.
  double barrier = 0.0;
  Vec3 direction = Vec3::UnitX(); ///< towards which up turns there; unit, horizontal in the pose
};

/// Around the pose that the upright body comes to, of all its poses; `copy`: the body with a coarse
/// surface, which is searched. docs/math.md "Righting lever"
Stability stability(const FloatingBody& body, const FloatingBody& copy,
                    const FloatingEquilibria& all);

/// The lever while the body is heeled so that up turns towards `towards` by `step`, 2·`step` … and
/// `last`, and trims freely about the axis in that direction.
std::vector<RightingLever> rightingLevers(const FloatingBody& body, const FloatingBody& copy,
                                          const FloatingPose& pose, const Vec3& towards,
                                          double step, double last);

} // namespace massprops
