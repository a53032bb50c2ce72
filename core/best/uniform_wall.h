// A cavity of a given volume behind a wall as thick everywhere.
#pragma once

#include "core/base/types.h"
#include "core/contour/opened_set.h"
#include "core/query/triangle_tree.h"

#include <functional>
#include <optional>

namespace massprops {

/// What is asked of such a cavity; working frame.
struct VolumeTask {
  const TriangleTree& surface; ///< closed, outward
  double volume;               ///< of the cavity, > 0
  double tolerance;            ///< of the volume, that of what is delivered
  double leastWall;            ///< length
  double ball;                 ///< width of the one that opens the level sets
  double edge;                 ///< of the cubes that the cavity is made with at most, length
  /// Rounds positions to those that can be delivered.
  std::function<Points(const Points&)> deliverable;
};

/// A level set of the distance to the surface, opened, at the
/// distance where it has that volume: closed components, outward, not inspected, before rounding.
/// What a contour's triangles miss is made up for by moving all of its vertices along their
/// normals, a small part of a cube. Empty: there is not so much room behind the least wall, or it
/// was not found.
std::optional<TriangleMesh> cavityOfVolume(const VolumeTask& task);

} // namespace massprops
