// Liquid that stays in a cavity when its outlets are open.
#pragma once

#include "core/base/types.h"

#include <vector>

namespace massprops {

/// A way out: liquid of the pool next to a vertex runs off as long as it stands higher than a
/// level. The vertex lies below it, and so does a way along the surface from it to the outlet.
struct Outlet {
  int vertex = 0;
  double level = 0.0; ///< a height
};

/// Liquid that stays, or all of a cavity that has no outlet.
struct Pool {
  double level = 0.0; ///< height of its surface; infinity: full, there is no outlet
  double volume = 0.0;
  std::vector<int> vertices; ///< of the cavity's surface below its own, ascending by height
};

/// What stands in a cavity that was full, and keeps its pose, once its outlets have run dry. Air
/// takes the place of what runs off. Where basins join below their surface they are one pool. Exact
/// up to roundings: docs/math.md "Pools". Heights are those along `up` (unit). By their lowest
/// vertices, the lowest pool first.
/// \pre closed, outward, without crossings; no component lies inside of another
std::vector<Pool> standingPools(const TriangleMesh& cavity, const Vec3& up,
                                const std::vector<Outlet>& outlets);

/// How much of some liquid is left when its surface sinks.
class PoolProfile {
public:
  /// `vertices`: of the cavity's surface below the liquid's.
  PoolProfile(const TriangleMesh& cavity, const Vec3& up, const std::vector<int>& vertices);

  /// Volume of what those vertices bound below a height that is not above the liquid's surface.
  double below(double height) const;

private:
  struct Part {
    Vec3 heights;         ///< of a triangle's corners
    double projectedArea; ///< seen from below positive where it is a floor
  };
  std::vector<Part> parts_;
  double highest_ = 0.0; ///< of the cavity
};

} // namespace massprops
