// What may be hollow, cut into small cells.
#pragma once

#include "core/query/triangle_tree.h"

#include <vector>

namespace massprops {

/// What may be hollow: the points of the body that are at least a wall away from its surface, in
/// small cells. c×10, a row a cell: the integrals of (1, x, y, z, xx, yy, zz, xy, yz, zx) over the
/// part of it that may be hollow. Working frame.
using AdmissibleCells = Eigen::Matrix<double, Eigen::Dynamic, 10, Eigen::RowMajor>;

/// Cubes, about `cells` of them in the model's bounding box. Those at the border of the region are
/// divided once more, and the border is taken as a plane in each part: the region comes out too
/// large at its edges, if anything, never too small.
/// \pre the surface is closed and outward
AdmissibleCells admissibleCells(const TriangleTree& surface, double wall, int cells = 20000);

/// The heights between the layers of these cells, ascending: none of them cuts a cell.
std::vector<double> layerHeights(const TriangleTree& surface, int cells = 20000);

} // namespace massprops
