#include "core/mesh/vertex_adjacency.h"

#include "core/mesh/connectivity.h"

#include <algorithm>

namespace massprops {

VertexAdjacency vertexAdjacency(Eigen::Index vertexCount, const Faces& faces) {
  const VertexCorners corners = vertexCorners(vertexCount, faces);
  const int* corner = faces.data();
  VertexAdjacency result;
  result.begin_.assign(1, 0);
  result.begin_.reserve(static_cast<std::size_t>(vertexCount) + 1);
  result.all_.reserve(static_cast<std::size_t>(faces.size()));
  std::vector<int> list;
  for (Eigen::Index v = 0; v < vertexCount; ++v) {
    list.clear();
    for (const int c : corners.at(v)) {
      list.push_back(corner[nextHalfEdge(c)]);
      list.push_back(corner[previousHalfEdge(c)]);
    }
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    result.all_.insert(result.all_.end(), list.begin(), list.end());
    result.begin_.push_back(static_cast<int>(result.all_.size()));
  }
  return result;
}

} // namespace massprops
