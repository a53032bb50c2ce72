// All poses in which a body can float at rest.
#pragma once

#include "core/physics/floating_pose.h"

#include <vector>

namespace massprops {

/// Poses that are nearer to each other than this, radians, are one.
constexpr double kSame = 0.02;

/// Of a few hundred vertices; itself where it has no more.
TriangleMesh coarseSurface(const Points& vertices, const Faces& faces);

/// Like `body` and as heavy in the water, but with this surface for its own.
FloatingBody withSurface(const FloatingBody& body, const TriangleMesh& surface);

/// One stable pose, or a connected family of equal ones: of a cylinder that lies in the water all
/// those that it rolls through.
struct FloatingRest {
  FloatingPose pose; ///< of the family the lowest one found
  bool isDry = true; ///< else an opening is under water: the body would fill instead
  /// Between the body's z axis and up, over the family, radians.
  double leastTilt = 0.0, greatestTilt = 0.0;
};

struct FloatingEquilibria {
  std::vector<FloatingRest> rests; ///< by least tilt; none when the body sinks
  std::size_t upright = 0;         ///< the one it comes to when it is set into the water upright
};

/// `barrier` > 0, a length: poses between which the potential energy over the weight rises by no
/// more than this above the higher one are of one family; without it every facet of a cylinder
/// would count. `copy`: the body with a coarse
/// surface, which is searched. A pose whose surroundings, those from which the body
/// comes to it, are narrower than some 4° may be missed. docs/math.md "All floating poses"
FloatingEquilibria floatingEquilibria(const FloatingBody& body, const FloatingBody& copy,
                                      double barrier);

/// Whether all orientations `heel` (radians) away from the pose next to `up` lie more than
/// `barrier` above it, so that its family ends before: the answer in most cases, at little cost.
bool isHeldWithin(const FloatingBody& copy, const Vec3& up, double heel, double barrier);

} // namespace massprops
