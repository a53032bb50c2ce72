// A surface that is known to bound a solid: validated once, so later stages need no checks.
#pragma once

#include "core/repair.h"
#include "core/types.h"

namespace massprops {

/// One or more disjoint bodies, each bounded by a closed 2-manifold of its own with triangles
/// counter-clockwise seen from outside; no crossings, every vertex used, positive volume. Only
/// `makeSolid` makes one.
class Solid {
public:
  const Points& vertices() const { return mesh_.vertices; }
  const Faces& faces() const { return mesh_.faces; }
  /// Surfaces of cavities that the model has already, oriented into them; often empty.
  const TriangleMesh& cavities() const { return cavities_; }
  /// Length of the bounding box's diagonal.
  double diagonal() const { return diagonal_; }
  const Repairs& repairs() const { return repairs_; }

private:
  friend Solid makeSolid(const TriangleMesh& input);
  TriangleMesh mesh_;
  TriangleMesh cavities_;
  double diagonal_ = 0.0;
  Repairs repairs_;
};

/// Mends what `repair.h` mends, turns components round that face the wrong way throughout, and sets
/// components that lie inside of another one aside as existing cavities.
/// \throw InvalidInput with the number of defects and the MeshLab filter that mends them
Solid makeSolid(const TriangleMesh& input);

} // namespace massprops
