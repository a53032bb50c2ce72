// What a simulation has to know of a body, from its triangles.
#pragma once

#include "simulation/mesh.h"

#include <limits>

namespace simulation {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// Mass, centre of mass and inertia tensor about it, in the units of lengths and densities.
struct MassProperties {
  double mass = 0.0;
  Vector3d centre = Vector3d::Zero();
  Matrix3d inertia = Matrix3d::Zero();
};

/// Of the material between `outer` and `inner`, whose normals point into the cavity, and of what
/// fills the cavity. Every triangle makes a signed tetrahedron with a point nearby, integrated by
/// the four-point rule that is exact for quadratic polynomials [HMS56].
/// \param level contents reach this height
MassProperties massProperties(const Mesh& outer, const Mesh& inner, double density,
                              double fillDensity,
                              double level = std::numeric_limits<double>::infinity());

/// In natural units: lengths in diagonals of the bounding box, mass 1, up = +z, gravity 1. A unit
/// of time is then √(diagonal/g).
struct Body {
  Mesh surface; ///< the outer one
  Vector3d centre;
  Matrix3d inertia; ///< about the centre
};

/// \param unit the diagonal
Body inNaturalUnits(const Mesh& outer, const MassProperties& properties, double unit);

/// Of the bounding box.
double diagonal(const Mesh& mesh);

} // namespace simulation
