// A place for a hole, tried with rays along the sides of the drill.
#pragma once

#include "core/drill/hole.h"
#include "core/drill/pools.h"
#include "core/query/triangle_tree.h"

#include <functional>
#include <optional>
#include <vector>

namespace massprops {

/// Where holes may be drilled; lengths in one unit.
struct Workpiece {
  const TriangleTree& outer;  ///< closed, outward
  const TriangleTree& cavity; ///< closed, outward, inside of the other; one component
  const TriangleTree* others; ///< further cavities, which no drill may meet; null: none
  double diameter;            ///< of the narrowest part of a hole
  /// Whether no hole may open at a point of the outer surface.
  std::function<bool(const Vec3&)> isKeptClear;
};

/// How smooth the surfaces must be around a hole.
enum class Demands {
  Clear, ///< no edges within half a radius of the rims
  Bare,  ///< the drill goes through
};

struct DrillSite {
  Hole hole;
  double removed = 0.0; ///< volume, about
  Points innerRim, outerRim;
  std::vector<int> innerFaces; ///< of the cavity, at the inner rim's points
};

/// Empty where the drill does not cut both surfaces in one round line each, passes another cavity,
/// or ends within the body. `entry`: a point of the cavity's surface; `normal`: outward there;
/// `direction`: unit, outwards.
std::optional<DrillSite> drillSite(const Workpiece& piece, const Vec3& entry, const Vec3& normal,
                                   const Vec3& direction, Demands demands);

/// The way out that a hole is: liquid must stand higher than the lowest points of both rims.
Outlet outletAt(const DrillSite& site, const TriangleTree& cavity, const Vec3& up);

} // namespace massprops
