// The surface of a cavity that leaves walls and lies on one side of a quadric.
#pragma once

#include "core/contour/dual_contour.h"
#include "core/contour/opened_set.h"
#include "core/query/surface_distance.h"

#include <optional>

namespace massprops {

struct CavityContour {
  Contour contour;
  double edge; ///< of the cubes that it was made with
  /// Has measured it.
  ClearanceQuery clearance;
};

/// The points of the opened set where the quadric is positive, if one is given. Closed components,
/// outward, that do not cross themselves, no point of which is nearer to the surface than the set's
/// wall; no faces where there is no such point. Empty: it was not found, which happens on surfaces
/// far too uneven.
std::optional<CavityContour> cavityContour(const OpenedSet& set,
                                           const std::optional<LayeredQuadric>& quadric);

} // namespace massprops
