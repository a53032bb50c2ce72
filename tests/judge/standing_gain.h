// What hollowing can do for standing, counted in cubes without any code of core/.
#pragma once

#include "core/base/types.h"

namespace massprops::testing {

/// Tipping angles about the hull of the lowest vertices, in degrees; negative: the centre of mass
/// is outside of it. NaN where that hull has no area.
struct StandingGain {
  double solid;
  double best; ///< with the best cavity
};

/// Of all that is deeper than `wall` and in balls as wide as it, in cubes of at most `side` and in
/// doubt too much, the cavity is what lies on one side of a plane, as the best one does [HLW24]:
/// 2,000 directions are tried, each at every distance. `model`: closed, +z is up.
StandingGain standingGain(const TriangleMesh& model, double wall, double side);

} // namespace massprops::testing
