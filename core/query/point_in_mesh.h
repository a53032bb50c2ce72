// Whether a point or a surface lies inside of a closed surface.
#pragma once

#include "core/base/types.h"
#include "core/query/triangle_tree.h"

namespace massprops {

/// The inside of a closed surface. Exact: by the parity of crossings along a few dozen ways out;
/// a point from which none of them stays off the surface's edges counts as outside. Refers to the
/// tree it was made from.
class PointInMesh {
public:
  explicit PointInMesh(const TriangleTree& surface);

  /// Whether p lies strictly inside.
  bool contains(const Vec3& p) const;

  /// The same, quicker, for a point whose nearest one of the surface is known. \pre outward
  /// orientation
  bool contains(const Vec3& p, const TriangleTree::Hit& nearest) const;

  /// Whether a component that does not cross the surface lies inside; decided by one of its
  /// vertices. \pre outward orientation
  bool contains(const Points& vertices, const Faces& component) const;

private:
  enum class Way { Inside, Outside, Unknown };
  /// What the way from one point to another that lies outside tells; one that meets an edge tells
  /// nothing.
  Way walk(const Vec3& from, const Vec3& to) const;

  const TriangleTree& surface_;
  Vec3 lower_, upper_; ///< corners of a box around the surface
  double length_;      ///< of a way that leads out of the box
};

} // namespace massprops
