// What a cavity may take: the points behind the walls, without channels too narrow for a ball.
#pragma once

#include "core/contour/region.h"
#include "core/optimum/admissible_cells.h"

#include <memory>

namespace massprops {

/// The points at least `wall` behind the surface, opened by a ball: docs/math.md "The best possible
/// cavity". Working frame.
struct OpenedSet {
  const TriangleTree& surface; ///< closed, outward
  double wall;                 ///< a little more than the wanted one: what rounding takes
  double ball;                 ///< its width
  double edge;                 ///< of the cubes that its border is to be made with
  Opening opening;
  std::shared_ptr<const GridFunction> fill = {}; ///< null, or positive where they belong to it
};

/// The edge of cubes about `count` of which a surface of this area passes through; a length.
double edgeOfCubes(double area, double count);

/// The surface must outlive the set. Lengths; the ball is as wide as the wall if it is not given.
OpenedSet openedSet(const TriangleTree& surface, double wall, double edge);
OpenedSet openedSet(const TriangleTree& surface, double wall, double ball, double edge);

/// The wall up to which there is room for a ball as wide as the wall behind it, where the surface
/// has room for one of this radius.
double wallWithRoomFor(double radius);

/// What belongs to it of the cubes behind the walls, as `cellsOf` has it.
AdmissibleCells cellsWithin(const OpenedSet& set, const RegionParts& all);

} // namespace massprops
