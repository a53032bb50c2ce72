// How a body lies in the water.
#pragma once

#include "simulation/world.h"

namespace simulation {

/// The part of a body below z = 0, in world coordinates.
struct Submerged {
  double volume = 0.0;
  Vector3d first = Vector3d::Zero(); ///< ∫x over it
};

/// Of a mesh in world coordinates. Adds the tetrahedra that the triangles make with a point nearby,
/// each with its sign and cut by z = 0 on its own.
Submerged submerged(const Mesh& mesh, const Vector3d& apex);

struct Floated {
  double heel;    ///< between the body's +z and up, degrees
  double draught; ///< of its lowest point, diagonals; infinite when it sinks
};

/// Let go heeled by `heel` degrees about the horizontal axis at `azimuth` (radians), at the height
/// at which it displaces its weight. The water is so dense that the body's weight is that of
/// `displaced` cubic units. Damped, to settle.
Floated floated(const Body& body, double displaced, double heel, double azimuth);

} // namespace simulation
