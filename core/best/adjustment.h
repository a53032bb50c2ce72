// A contour moved a little, so that the body of its triangles keeps the constraints.
#pragma once

#include "core/contour/dual_contour.h"
#include "core/reduced/cavity_search.h"

namespace massprops {

/// Integrals over triangles differ from those over cells, so that constraints hold nearly only.
/// Moves the vertices on the cut along its normals by the polynomial of degree 2 that keeps them
/// with the least mean square; where that does not do, those behind the walls inwards. `farthest`:
/// root mean square, a length. Number of evaluations; nothing moves where the constraints hold.
int adjustToConstraints(const CavityTask& task, double farthest, Contour& contour);

} // namespace massprops
