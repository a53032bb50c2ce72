// Whether a body that was tilted comes back.
#pragma once

#include "simulation/comparison.h"
#include "simulation/hull.h"
#include "simulation/world.h"

#include <string>

namespace simulation {

struct WeakestSide {
  Vector2d direction; ///< unit: over there it falls first
  double angle;       ///< by which it has to be tilted for that, degrees; negative: it falls anyway
};

/// From the distance between the plumb line of the centre of mass and the polygon's border.
WeakestSide weakestSide(const std::vector<Vector3d>& polygon, const Vector3d& centre);

/// Whether the body, tilted by `angle` (degrees) towards `direction` and let go, falls.
bool falls(const Body& body, const Contacts& contacts, const Vector2d& direction, double angle,
           const Settings& settings = {});

/// The angle from which on it falls, between `low` and `high`, by bisection; these where it falls
/// at `low` or comes back at `high`.
double tippingAngle(const Body& body, const Contacts& contacts, const Vector2d& direction,
                    double low, double high, const Settings& settings = {});

/// Tilts the body over its weakest side and others; `reported`: the tipping angle.
void compareStanding(const Body& body, double reported, const std::string& state,
                     Comparison& comparison);

} // namespace simulation
