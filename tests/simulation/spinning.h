// The top that sleeps.
#pragma once

#include "simulation/comparison.h"
#include "simulation/world.h"

#include <string>

namespace simulation {

/// A top with its centre of mass above its tip, on the principal axis of C.
struct Top {
  double A, B, C; ///< moments of inertia about the tip
  double k;       ///< weight times height of the centre above the tip
};

/// Greatest real part of an exponent of small wobbles about upright at the angular speed ω; 0: it
/// sleeps. The linearised equations in axes of the body, p and q the tilts:
/// A q̈ + (A + B − C) ω ṗ + ((C − B) ω² − k) q = 0,
/// B p̈ − (A + B − C) ω q̇ + ((C − A) ω² − k) p = 0.
double growthRate(const Top& top, double speed);

/// The least ω above which it sleeps; infinite when it never does.
double sleepingSpeed(const Top& top);

/// Steps in which it turns by `turn` radians. With half the default the critical speed of the
/// sample top differs by 0.1 %.
Settings spinSettings(double speed, double turn = 4e-3);

/// How many times its first tilt the axis leans at most while it spins about its point `tip`, which
/// is pinned to the ground. Ends where it is clear that it wobbles.
double amplification(const Body& body, const Vector3d& tip, double speed, double duration,
                     const Settings& settings);

/// From this amplification on a top wobbles. What sleeps 1 % above its critical speed reaches 7,
/// and what wobbles 1 % below it reaches 2,000 in `kSpinDuration`.
constexpr double kWobbles = 30.0;
/// In units of √(A/k).
constexpr double kSpinDuration = 60.0;

/// The speed above which it sleeps in the simulation, near `expected`, by bisection.
double criticalSpeed(const Body& body, const Vector3d& tip, const Top& top, double expected,
                     const Settings& settings);

/// About the point, and weight times height of the centre of mass.
Top topOf(const Body& body, const Vector3d& tip);

/// Spins the body below and above its sleeping speed; one that is not `balanced`, whose axis is no
/// principal axis through its centre of mass, wobbles at any speed.
void compareSpinning(const Body& body, const Vector3d& tip, bool balanced, const std::string& state,
                     Comparison& comparison);

} // namespace simulation
