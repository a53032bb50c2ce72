// Where the centre of mass of a rolling body must lie to draw it upright from every pose.
#pragma once

#include "core/base/types.h"

namespace massprops {

/// Half-spaces, one for each small roll of the body towards upright along a meridian, −z being the
/// direction that points down when it is upright: its centre of mass c sinks in that roll exactly
/// if c_z + slopes·(c_x, c_y) < heights. For a centre on the axis the height is that of the
/// metacentre. Where all hold the body has no resting pose but upright, as far as the grid of
/// poses sees it. docs/math.md "Roll upright"
struct RollingMetacentres {
  Eigen::Matrix<double, Eigen::Dynamic, 2> slopes; ///< r×2
  Vector heights;                                  ///< r, same unit as the points
};

/// On a grid of tilts and meridians. `points`: n×3, of which the convex hull rolls.
RollingMetacentres rollingMetacentres(const Points& points);

} // namespace massprops
