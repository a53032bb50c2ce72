// From an implicit solid standing on the ground to a closed surface of well-shaped triangles.
#pragma once

#include "implicit.h"

#include <array>
#include <vector>

namespace samples {

/// Coordinates as they are stored in the file.
struct Mesh {
  std::vector<std::array<float, 3>> vertices;
  std::vector<std::array<int, 3>> faces; ///< counter-clockwise seen from outside
};

struct MeshingProblem {
  Implicit solid;      ///< what lies below z = 0 is cut away; that makes the flat contact areas
  Vec3 lower, upper;   ///< a box around the part above the ground
  int vertexCount = 0; ///< reached exactly
  /// Relative edge length at a point; 1 everywhere is uniform.
  Implicit relativeEdgeLength = [](const Vec3&) { return 1.0; };
};

/// Marching tetrahedra, then isotropic remeshing [Botsch and Kobbelt 2004] that keeps the outline
/// of the contact areas as a crease. The same bits on every run.
/// \throw std::runtime_error when the result is not one closed surface without self-intersections
Mesh meshAboveGround(const MeshingProblem& problem);

} // namespace samples
