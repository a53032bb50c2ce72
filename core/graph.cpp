#include "core/graph.h"

#include <algorithm>
#include <functional>
#include <queue>
#include <utility>

namespace massprops {

Neighbours vertexNeighbours(Eigen::Index vertexCount, const Faces& faces) {
  Neighbours neighbours(static_cast<std::size_t>(vertexCount));
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int from = faces(f, k);
      const int to = faces(f, (k + 1) % 3);
      neighbours[static_cast<std::size_t>(from)].push_back(to);
      neighbours[static_cast<std::size_t>(to)].push_back(from);
    }
  }
  for (std::vector<int>& list : neighbours) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return neighbours;
}

Vector lipschitzBelow(const Points& vertices, const Neighbours& neighbours, const Vector& values,
                      double slope) {
  // Dijkstra's algorithm with every vertex a source of its own value.
  Vector result = values;
  using Entry = std::pair<double, int>;
  std::vector<Entry> start;
  start.reserve(static_cast<std::size_t>(values.size()));
  for (Eigen::Index v = 0; v < values.size(); ++v)
    start.emplace_back(values[v], static_cast<int>(v));
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue(std::greater<>{},
                                                                       std::move(start));
  while (!queue.empty()) {
    const auto [value, v] = queue.top();
    queue.pop();
    if (value > result[v]) continue;
    for (const int w : neighbours[static_cast<std::size_t>(v)]) {
      const double reached = value + slope * (vertices.row(v) - vertices.row(w)).norm();
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
