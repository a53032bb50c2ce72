// The surface of a cavity that leaves walls and lies on one side of a quadric.
#pragma once

#include "core/contour/dual_contour.h"

#include <optional>

namespace massprops {

struct CavityContour {
  Contour contour;
  /// Of the cubes that it was made with.
  double edge = 0.0;
};

/// The points at least `wall` behind the surface where a ball as wide as the wall fits, a little
/// more at edges, and the quadric (1, x, y, z, xx, yy, zz, xy, yz, zx)·quadric is positive, if one
/// is given. Closed components, outward, that do not cross themselves, no point of which is nearer
/// to the surface than `wall`; no faces where there is no such point. Empty: it was not found,
/// which happens on surfaces far too uneven. `surface`: closed, outward. `cubes`: about how many
/// the border passes through.
std::optional<CavityContour> cavityContour(const TriangleTree& surface, double wall,
                                           const std::optional<Moments>& quadric, double cubes);

} // namespace massprops
