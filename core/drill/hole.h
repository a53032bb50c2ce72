// A hole through the wall, as the drill that makes it.
#pragma once

#include "core/base/types.h"

namespace massprops {

/// Round, a little wider outside than inside, so that its plug cannot fall into the cavity.
struct Hole {
  Vec3 centre = Vec3::Zero();               ///< of the narrow end, inside of the cavity
  Vec3 direction = Vec3::UnitZ();           ///< unit, outwards
  double radius = 0.0;                      ///< of the narrow end
  double length = 0.0;                      ///< to the wide end, outside of the body
  static constexpr double kWidening = 0.25; ///< radius per length
  static constexpr int kSides = 24;         ///< of the drill, and rays along it

  double radiusAt(double along) const { return radius + kWidening * along; }
};

/// The drill, with sides that touch its cone, or what is a clearance smaller all round: closed,
/// outward.
TriangleMesh drillOf(const Hole& hole, double clearance);

/// Least distance between the axes of two holes.
double axisDistance(const Hole& a, const Hole& b);

} // namespace massprops
