// Who is next to whom on a closed surface.
#pragma once

#include "core/base/types.h"

#include <cstddef>
#include <vector>

namespace massprops {

/// Half-edges are numbered as the corners that they begin at.
inline int nextHalfEdge(int h) {
  return h % 3 == 2 ? h - 2 : h + 1;
}
inline int previousHalfEdge(int h) {
  return h % 3 == 0 ? h + 2 : h - 1;
}

/// The corners of the faces at each vertex: those of vertex v are
/// corners[begin[v]] … corners[begin[v+1] − 1], ascending, corner k of face f being 3f + k.
struct VertexCorners {
  std::vector<int> begin;
  std::vector<int> corners;

  IndexRange at(Eigen::Index v) const {
    const auto i = static_cast<std::size_t>(v);
    return {corners.data() + begin[i], corners.data() + begin[i + 1]};
  }
};
VertexCorners vertexCorners(Eigen::Index vertexCount, const Faces& faces);

/// Half-edge 3f + k runs from corner k of face f to the next one. For each the half-edge that runs
/// the other way; −1 where the surface has no such. \pre no directed edge is there twice
/// `corners`: those of `faces`, for callers that have them.
std::vector<int> oppositeHalfEdges(const VertexCorners& corners, const Faces& faces);
std::vector<int> oppositeHalfEdges(Eigen::Index vertexCount, const Faces& faces);

/// Edges that a closed, coherently oriented manifold does not have; each is counted once.
struct EdgeCounts {
  std::size_t boundary = 0;    ///< of one face
  std::size_t nonManifold = 0; ///< of more than two faces
  std::size_t incoherent = 0;  ///< of two faces that run along it in the same direction
};
/// No need for a manifold; corners of a face must differ.
EdgeCounts countEdges(Eigen::Index vertexCount, const Faces& faces);

} // namespace massprops
