// A contour moved a little, so that the body of its triangles does what the cells' body does.
#pragma once

#include "core/contour/dual_contour.h"
#include "core/reduced/cavity_search.h"

namespace massprops {

/// Integrals over triangles differ from those over cells, and cells are hollow in part. Where the
/// goal is the level of linear conditions, moves the vertices on the cut along their normals by the
/// polynomial of degree 1 or 2 that raises it most. Else, where the constraints do not hold, by the
/// one of the least mean square that keeps them, or where that does not do the vertices behind the
/// walls inwards. `farthest`: root mean square of the displacements, a length. Number of
/// evaluations; 0: nothing moved.
int adjustOnTriangles(const CavityTask& task, double farthest, Contour& contour);

} // namespace massprops
