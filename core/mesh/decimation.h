// A surface with fewer triangles.
#pragma once

#include "core/base/types.h"

#include <limits>
#include <vector>

namespace massprops {

/// How coarse: about `most` vertices, and fewer, down to `least`, where those that go are within
/// `distance` of the planes of the faces that they belonged to, in the mean square; a length in the
/// vertices' unit.
struct DecimationTarget {
  Eigen::Index most, least;
  double distance;
  double leastAngle = 0.0; ///< degrees; no triangle gets a smaller one that had a larger
  /// No edge becomes longer; a length in the vertices' unit.
  double longestEdge = std::numeric_limits<double>::infinity();
  /// The surface itself where it has not so many times as many vertices: a copy would not pay.
  double leastFactor = 1.4;
};

struct DecimatedMesh {
  /// Closed manifolds, as many as the surface has components; may cross themselves a little.
  TriangleMesh mesh;
  /// For every vertex of `mesh` the vertex of the surface that it is.
  std::vector<int> vertexOf;
  /// For every vertex of the surface that of `mesh` that it fell together with.
  std::vector<int> vertexFor;

  /// Whether it is the surface itself.
  bool isWhole() const { return vertexOf.size() == vertexFor.size(); }
};

/// Collapses edges, those first that change the shape least [GH97] and are shortest.
/// \pre closed manifold components
DecimatedMesh decimated(const Points& vertices, Faces faces, const DecimationTarget& target);

} // namespace massprops
