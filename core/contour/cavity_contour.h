// The surface of a cavity that leaves walls and lies on one side of a quadric.
#pragma once

#include "core/contour/dual_contour.h"
#include "core/contour/opened_set.h"
#include "core/query/surface_distance.h"

#include <functional>
#include <optional>
#include <vector>

namespace massprops {

/// A surface of more triangles is made with fewer where that costs next to nothing of its volume
/// and of what it is for.
constexpr Eigen::Index kEnoughTriangles = 60000;

struct CavityContour {
  Contour contour;
  double edge;              ///< of the cubes that it was made with
  ClearanceQuery clearance; ///< has measured it
  bool isFinished = true;
};

/// What it is for, asked about a surface whose walls are still too thin here and there.
struct ContourUse {
  std::function<bool(const Contour&)> isWorthIt; ///< whether to finish it; none: it is
  std::function<double(const Contour&)> loss;    ///< share of what is possible; none: not known
};

/// The points of the opened set where the quadric is positive, if one is given. Closed components,
/// outward, that do not cross themselves, no point of which is nearer to the surface than the set's
/// wall; no faces where there is no such point. Empty: it was not found, which happens on surfaces
/// far too uneven. What is not worth it is returned, not finished. `solid`: points in cubes of
/// which nothing shall be hollow.
std::optional<CavityContour> cavityContour(const OpenedSet& set,
                                           const std::optional<LayeredQuadric>& quadric,
                                           const ContourUse& use = {},
                                           const std::vector<Vec3>& solid = {});

} // namespace massprops
