#include "core/graph.h"

#include "core/half_edges.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

namespace massprops {

Neighbours vertexNeighbours(Eigen::Index vertexCount, const Faces& faces) {
  const VertexCorners corners = vertexCorners(vertexCount, faces);
  const int* corner = faces.data();
  Neighbours result;
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

Vector lipschitzBelow(const Points& vertices, const Neighbours& neighbours, const Vector& values,
                      double slope) {
  // Dijkstra's algorithm with every vertex a source of its own value; it starts from those that
  // limit a neighbour, most often few.
  Vector result = values;
  using Entry = std::pair<double, int>;
  std::vector<Entry> start;
  const auto limitOf = [&](Eigen::Index v, int w) {
    return result[v] + slope * (vertices.row(v) - vertices.row(w)).norm();
  };
  for (Eigen::Index v = 0; v < values.size(); ++v) {
    for (const int w : neighbours[static_cast<std::size_t>(v)]) {
      if (limitOf(v, w) < values[w]) {
        start.emplace_back(values[v], static_cast<int>(v));
        break;
      }
    }
  }
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue(std::greater<>{},
                                                                       std::move(start));
  while (!queue.empty()) {
    const auto [value, v] = queue.top();
    queue.pop();
    if (value > result[v]) continue;
    for (const int w : neighbours[static_cast<std::size_t>(v)]) {
      const double reached = limitOf(v, w);
      if (reached < result[w]) {
        result[w] = reached;
        queue.emplace(reached, w);
      }
    }
  }
  return result;
}

Vector lipschitzAbove(const Points& vertices, const Neighbours& neighbours, const Vector& values,
                      double slope) {
  return -lipschitzBelow(vertices, neighbours, -values, slope);
}

} // namespace massprops
