// A surface that is known to bound a solid: validated once, so later stages need no checks.
#pragma once

#include "core/types.h"

namespace massprops {

/// Closed, 2-manifold, one component, triangles counter-clockwise seen from outside, every vertex
/// used, positive volume. Only `makeSolid` makes one.
class Solid {
public:
  const Points& vertices() const { return mesh_.vertices; }
  const Faces& faces() const { return mesh_.faces; }
  /// Length of the bounding box's diagonal.
  double diagonal() const { return diagonal_; }
  /// Whether the input's triangles faced inwards and were turned round.
  bool wasInverted() const { return inverted_; }

private:
  friend Solid makeSolid(const TriangleMesh& mesh);
  TriangleMesh mesh_;
  double diagonal_ = 0.0;
  bool inverted_ = false;
};

/// Vertices that no face uses are left out; a surface that faces inwards throughout is turned
/// round. Whether the surface crosses itself is not examined here (see validity.h).
/// \throw InvalidInput with the number of defects and the MeshLab filter that mends them
Solid makeSolid(const TriangleMesh& mesh);

} // namespace massprops
