// A closed surface along the border of a region.
#pragma once

#include "core/contour/border_lattice.h"

#include <vector>

namespace massprops {

/// What a vertex of the surface lies on: what the walls leave, the quadric, both, or where both
/// come together at an acute angle and the edge between them is cut off.
enum class On : char { Inset, Cut, Crease, Chamfer };

struct Contour {
  /// Closed manifold components, outward, free of crossings: each quadrilateral around an edge of
  /// the lattice stays within the tetrahedra between that edge and the sides that it passes, and
  /// these do not overlap. [JU06]
  TriangleMesh mesh;
  std::vector<On> on; ///< for every vertex
  /// Share of the lattice's corners at which its cubes are too large for the region.
  double unresolved = 0.0;
};

/// Some vertices of a contour and the faces between them. `vertexOf`: for every vertex of `mesh`
/// its number in the contour.
Contour partOf(const Contour& contour, TriangleMesh mesh, const std::vector<int>& vertexOf);

/// Dual contouring: a vertex in each cube that the border cuts, where the planes along it meet, so
/// that creases come out sharp; a quadrilateral across each edge with one end inside. [JLSW02]
Contour dualContour(const BorderLattice& lattice);

} // namespace massprops
