// Where holes drain a cavity best.
#pragma once

#include "core/drill/drill_site.h"

#include <optional>
#include <vector>

namespace massprops {

/// The place from which a pool drains best: what stays below the hole, and what it takes out of the
/// wall, are least together. It is clear of edges, unless such a place would leave much more than
/// is tolerated, and another one much less than that. `taken`: keeps away from these. Empty: no
/// drill fits. `pool`: one of the cavity; heights are those along `up`.
std::optional<DrillSite> bestSite(const Workpiece& piece, const Pool& pool, const Vec3& up,
                                  const std::vector<DrillSite>& taken, double toleratedPool);

/// What is asked of a cavity's holes.
struct HoleWishes {
  Vec3 up = Vec3::UnitZ();  ///< unit, in the build pose
  int fewest = 1;           ///< for every cavity
  double toleratedPool = 0; ///< volume that may stay without a hole of its own
};

/// Of a cavity of one component: the first lets most out at the bottom, the second most air in at
/// the top or, in a print that hangs, liquid out there; more where pools stand, and for the wish.
/// Fewer where no drill fits; none: nowhere.
std::vector<DrillSite> holesFor(const Workpiece& piece, const HoleWishes& wishes);

} // namespace massprops
