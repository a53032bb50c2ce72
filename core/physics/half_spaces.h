// Convex sets of points, such as the centres of mass that bodies can have.
#pragma once

#include "core/base/types.h"

namespace massprops {

/// The points p with normals·p ≤ limits, a row each.
struct HalfSpaces {
  Points normals; ///< r×3
  Vector limits;  ///< r

  bool contain(const Vec3& p) const { return (normals * p - limits).maxCoeff() <= 0.0; }
  bool contain(const Eigen::AlignedBox3d& box) const { return reachOf(box, 1.0).maxCoeff() <= 0.0; }
  /// How far beyond each border the box lies as a whole; ≤ 0 where it does not.
  Vector distancesTo(const Eigen::AlignedBox3d& box) const { return reachOf(box, -1.0); }
  /// Whether one of the half-spaces has nothing of the box: then the set has nothing of it.
  bool miss(const Eigen::AlignedBox3d& box) const { return distancesTo(box).maxCoeff() > 0.0; }

private:
  /// How far beyond each border the box's farthest (1) or nearest (−1) corner lies.
  Vector reachOf(const Eigen::AlignedBox3d& box, double side) const {
    return normals * box.center() + side * 0.5 * normals.cwiseAbs() * box.sizes() - limits;
  }
};

} // namespace massprops
