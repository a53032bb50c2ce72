// What a cavity may take: the points behind the walls, without channels too narrow for a ball.
#pragma once

#include "core/contour/region.h"
#include "core/optimum/admissible_cells.h"

#include <memory>

namespace massprops {

/// What opens a set.
struct OpeningBall {
  double width;
  double edge; ///< of the cubes that tell where it fits: in rooms as narrow as the ball only small
               ///< ones do
};

/// The points at least `wall` behind the surface, opened by a ball, by default one as wide as the
/// wall: docs/math.md "The best possible cavity". Working frame.
struct OpenedSet {
  const TriangleTree& surface; ///< closed, outward
  double wall;                 ///< a little more than the wanted one: what rounding takes
  OpeningBall ball;
  double edge;                          ///< of the cubes that its border is to be made with
  std::shared_ptr<const DeepPart> deep; ///< null: no such ball fits, there are no points
  std::shared_ptr<const GridFunction> fill = {}; ///< null, or positive where they belong to it
};

/// The edge of cubes about `count` of which a surface of this area passes through; a length.
double edgeOfCubes(double area, double count);

/// The surface must outlive the set. `wall`, `edge` of the cubes: lengths.
OpenedSet openedSet(const TriangleTree& surface, double wall, double edge);
OpenedSet openedSet(const TriangleTree& surface, double wall, const OpeningBall& ball, double edge);

/// What belongs to it of the cubes behind the walls, as `cellsOf` has it.
AdmissibleCells cellsWithin(const OpenedSet& set, const RegionParts& all);

/// What the set leaves out, a volume, of the cubes behind the walls that may hold the ball's
/// middle. Where there is much of it the ball's own cubes may be too large for the thin sheets that
/// its middle goes along.
double volumeInDoubt(const OpenedSet& set, const RegionParts& all);

} // namespace massprops
