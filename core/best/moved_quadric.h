// The quadric whose cut is where vertices of another one's cut went.
#pragma once

#include "core/contour/dual_contour.h"
#include "core/optimum/layered_quadric.h"

#include <optional>

namespace massprops {

/// The sum of squares of the distances, of first order, between `vertices` on the cut and the
/// result's cut is least; elsewhere it changes little. `contour`: of `quadric`, working frame, with
/// its vertices where they were. `vertices`: where they are, n×3. A layer without any keeps its
/// quadric. Empty: no quadric's cut is near to where they went.
std::optional<LayeredQuadric> quadricThrough(const LayeredQuadric& quadric, const Contour& contour,
                                             const Points& vertices);

} // namespace massprops
