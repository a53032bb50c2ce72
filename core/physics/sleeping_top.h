// From which speed on a top spins upright on its tip without falling: it "sleeps".
#pragma once

#include <optional>

namespace massprops {

/// A rigid body that turns about a fixed point, its tip, with the centre of mass straight above.
/// The vertical axis through both is a principal one. Any consistent units.
struct Top {
  double acrossA, acrossB; ///< principal moments of inertia about the tip, across the axis
  double axial;            ///< about the axis
  double weightMoment;     ///< m g h, h the height of the centre of mass above the tip
};

/// Whether the upright spin at this angular speed is spectrally stable: every small disturbance
/// oscillates, none grows. docs/math.md "Sleeping speed"
bool sleepsAt(const Top& top, double speed);

/// The least angular speed above which it is stable at every speed, by the roots of polynomials,
/// none is sampled; there may be a window of stable speeds below. Bands so narrow that friction, in
/// 1000 turns for a factor of e, takes a top through them before what grows there has doubled do
/// not count. Empty where no speed is the last unstable one: the axial moment lies between the
/// other two. [LRSM92]
/// \pre all moments of inertia are positive
std::optional<double> sleepingSpeed(const Top& top);

} // namespace massprops
