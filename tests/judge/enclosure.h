// What a surface encloses and how deep that is, counted in cubes: slow and simple, without any code
// of core/.
#pragma once

#include "core/base/types.h"

#include <vector>

namespace massprops::testing {

struct Enclosure {
  double volume = 0.0; ///< length³
  double share = 0.0;  ///< of the box around the surface
};

/// Where triangles that need not be closed go round at least half of a time, either way, counted at
/// 100,000 places that are spread evenly over the box: within some thousandths of it. [JKS13]
Enclosure enclosedBy(const TriangleMesh& mesh);

/// The greatest distance of a point inside from the surface, between bounds.
struct Depth {
  double atLeast; ///< at a point that was found
  double atMost;  ///< no point is deeper
};

/// Cubes are halved, those first that may hold the deepest point, until it is known within a
/// fiftieth or there are too many. Nothing is looked for that is no deeper than `least`.
/// `mesh`: any triangles; inside is as above.
Depth depthOf(const TriangleMesh& mesh, double least);

struct Cell {
  Vec3 middle;
  double volume; ///< length³
  double depth;  ///< of its middle
};

/// Cubes of at most this side whose middles are inside and at least that far from the surface.
std::vector<Cell> cellsDeeperThan(const TriangleMesh& mesh, double depth, double side);

} // namespace massprops::testing
