// A closed surface along the border of a region.
#pragma once

#include "core/contour/border_lattice.h"

#include <vector>

namespace massprops {

/// What a vertex of the surface lies on: what the wall leaves, what the ball reaches, the quadric's
/// cut, or cut and another of these.
enum class On : char { Wall, Reach, Cut, Crease };

struct Contour {
  /// Closed manifold components, outward, free of crossings: each quadrilateral around an edge of
  /// the lattice stays within the tetrahedra between that edge and the sides that it passes, and
  /// these do not overlap. [JU06] Vertex i is that of the lattice's cube i, so that it keeps its
  /// number when corners are taken out; those of cubes that the border does not cut have no face.
  TriangleMesh mesh;
  std::vector<On> on; ///< for every vertex
};

/// Dual contouring: a vertex in each cube that the border cuts, where the planes along it meet, so
/// that creases come out sharp; a quadrilateral across each edge with one end inside. [JLSW02]
Contour dualContour(const BorderLattice& lattice);

} // namespace massprops
