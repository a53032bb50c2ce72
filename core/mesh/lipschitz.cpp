#include "core/mesh/lipschitz.h"

#include <functional>
#include <queue>
#include <utility>

namespace massprops {

Vector lipschitzBelow(const Points& vertices, const VertexAdjacency& neighbours,
                      const Vector& values) {
  // Dijkstra's algorithm with every vertex a source of its own value; it starts from those that
  // limit a neighbour, most often few.
  Vector result = values;
  using Entry = std::pair<double, int>;
  std::vector<Entry> start;
  const auto limitFor = [&](Eigen::Index v, int w) {
    return result[v] + (vertices.row(v) - vertices.row(w)).norm();
  };
  for (Eigen::Index v = 0; v < values.size(); ++v) {
    for (const int w : neighbours[static_cast<std::size_t>(v)]) {
      if (limitFor(v, w) < values[w]) {
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
      const double reached = limitFor(v, w);
      if (reached < result[w]) {
        result[w] = reached;
        queue.emplace(reached, w);
      }
    }
  }
  return result;
}

Vector lipschitzAbove(const Points& vertices, const VertexAdjacency& neighbours,
                      const Vector& values) {
  return -lipschitzBelow(vertices, neighbours, -values);
}

} // namespace massprops
