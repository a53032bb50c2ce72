// Closed surfaces cut off by a horizontal plane.
#pragma once

#include "core/base/types.h"

#include <functional>
#include <optional>
#include <vector>

namespace massprops {

/// What is left above a plane z = level.
struct PlaneCut {
  TriangleMesh mesh; ///< closed where the surface was; faces above keep their order and come first
  /// For every face of `mesh` the one of the surface that it is a part of; -1: a cap's.
  std::vector<int> faceOf;
  double spread; ///< of the heights of the cut's points: 0 where what stores them allows
};

/// Leaves the part of a surface above the plane and closes it by flat caps, one for each polygon
/// that the plane cuts out, with its holes; the caps' triangles are about as large as the edges of
/// their border. Corners nearer to each other than `merged`, of which one is cut, become one: that
/// leaves no slivers, and moves the surface by no more. `representable`: rounds points of the mesh
/// to what the caller can store. Empty where rounding makes polygons cross or corners meet; a
/// finished mesh may still cross itself. \pre coherently oriented 2-manifolds, borders and all
/// vertices off the plane, the former above it
std::optional<PlaneCut> cutAbove(const Points& vertices, const Faces& faces, double level,
                                 double merged,
                                 const std::function<Points(const Points&)>& representable);

} // namespace massprops
