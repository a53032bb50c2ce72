// What may be hollow, as the integrals over small cells.
#pragma once

#include "core/optimum/feasible_region.h"

#include <vector>

namespace massprops {

/// c×10, a row a cell: the integrals of (1, x, y, z, xx, yy, zz, xy, yz, zx) over the part of it
/// that may be hollow, which is not empty. Working frame.
using AdmissibleCells = Eigen::Matrix<double, Eigen::Dynamic, 10, Eigen::RowMajor>;

/// What belongs to it.
enum class Admissible {
  BehindWalls, ///< all that lies behind the walls
  Reached,     ///< of that what the ball reaches
};

/// In the model's bounding box: half as wide they change the limit by a tenth of a per cent.
constexpr double kCells = 20000.0;

/// Equal cubes of as many of the region's edges as makes about `most` of them in its bounding box.
/// In the cubes on the border the function whose sign tells the region is taken as trilinear.
AdmissibleCells admissibleCells(const FeasibleRegion& region, Admissible which, double most);

/// Heights between layers of these cells, ascending: none of them cuts a cell. All of them, or some
/// where there are very many.
std::vector<double> layerHeights(const FeasibleRegion& region, double most);

} // namespace massprops
