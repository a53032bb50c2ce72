// The largest ball within a closed surface.
#pragma once

#include "core/query/triangle_tree.h"

namespace massprops {

/// Working frame. No radius: none was found.
struct InscribedBall {
  Vec3 centre = Vec3::Zero();
  double radius = 0.0;
};

/// About the largest ball that keeps clear of the surface from within; its radius is exact. Balls
/// that touch the surface at points all over it shrink until they meet it nowhere else [MBC12,
/// Alg. 1]; from the largest ones on, cutting planes look for places of larger ones. The same for
/// any number of threads. `apart`: about how far these points are from each other, unless that were
/// very many, or few; much smaller balls may be overlooked. \pre closed and outward
InscribedBall largestInscribedBall(const TriangleTree& surface, double apart);

} // namespace massprops
