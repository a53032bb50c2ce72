// What may be hollow, cut into small cells.
#pragma once

#include "core/query/grid_function.h"
#include "core/query/triangle_tree.h"

#include <deque>
#include <vector>

namespace massprops {

/// What may be hollow: the points of the body that are at least a wall away from its surface, in
/// small cells. c×10, a row a cell: the integrals of (1, x, y, z, xx, yy, zz, xy, yz, zx) over the
/// part of it that may be hollow. Working frame.
using AdmissibleCells = Eigen::Matrix<double, Eigen::Dynamic, 10, Eigen::RowMajor>;

/// A cube whose points may be hollow, or part of them. Working frame.
struct RegionPart {
  Vec3 centre;
  double depth;            ///< behind the surface, negative outside
  Eigen::Vector3f inwards; ///< unit, where the depth grows
  /// Above 0 a cube of 2^(level − 1) cells a side, all hollow; else 2^(level − 1) as wide as a
  /// cell.
  int level;
  int cell; ///< of level ≤ 0: number of the cell that it is part of; those of a cell follow on
  int opposite = -1; ///< another border's index in `opposites`; −1 where there is none
};
struct RegionParts {
  double edge = 0.0;            ///< of a cell
  double wall = 0.0;            ///< what may be hollow is deeper
  std::deque<RegionPart> parts; ///< so many that a vector's growth would matter
  /// Of parts of level ≤ 0: how far the middle is from another border, whose slope is against
  /// theirs.
  std::vector<Sample> opposites = {};
};

/// Whether parts at the region's edges are divided once more: for sums alone they need not be.
enum class AtEdges { Finer, AsElsewhere };

/// The cubes that `admissibleCells` are made of, see there. `slack`: the share by which depths may
/// be found too large, which is quicker.
RegionParts admissibleParts(const TriangleTree& surface, double wall, int cells = 20000,
                            double slack = 0.0, AtEdges atEdges = AtEdges::Finer);

/// The same with smaller cells where the rooms are narrow, a few across their mean width, as long
/// as their parts take no more than about 17 MB.
RegionParts resolvedParts(const TriangleTree& surface, double wall);

/// The border is taken as a plane in each part of a cell, or as two where it has another one.
AdmissibleCells cellsOf(const RegionParts& region);

/// A surface of area A passes through about so many times A/h² cubes of edge h.
constexpr double kCubesPerArea = 1.5;

/// About the area of what bounds the region, less where it is narrower than a cell.
double borderArea(const RegionParts& region);

/// Cubes, about `cells` of them in the model's bounding box. Those at the border of the region are
/// divided once more, twice where its parts do not face the same way, and the border is taken as a
/// plane in each part: the region comes out too large at its edges, if anything, never too small.
/// \pre the surface is closed and outward
AdmissibleCells admissibleCells(const TriangleTree& surface, double wall, int cells = 20000);

/// Heights between layers of cells of the given edge, ascending: none of them cuts a cell. All of
/// them, or some where there are very many.
std::vector<double> layerHeights(const TriangleTree& surface, double edge);

} // namespace massprops
