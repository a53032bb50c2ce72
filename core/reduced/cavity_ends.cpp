#include "core/reduced/cavity_ends.h"

#include "core/base/triangle.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace massprops {
namespace {

using Marks = std::vector<char>;

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

/// Vertices most of whose faces have turned away from where they were.
Marks turnedAway(const CavityTask& task, const CavityResult& found) {
  constexpr double kCosine = 0.5; // 60°
  const Points& before = task.model.surface->vertices;
  const Faces& faces = task.model.surface->faces;
  const Marks& solid = found.cavity.solid;
  std::vector<int> excess(solid.size(), 0);
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const auto corners = faces.row(f);
    if (std::any_of(corners.begin(), corners.end(), [&](int v) { return solid[at(v)] != 0; }))
      continue;
    const Vec3 was = areaNormal(before, faces, f);
    const Vec3 is = areaNormal(found.inner, faces, f);
    const bool isTurned = was.dot(is) < kCosine * was.norm() * is.norm();
    for (const int v : corners) excess[at(v)] += isTurned ? 1 : -1;
  }
  Marks turned(solid.size(), 0);
  std::transform(excess.begin(), excess.end(), turned.begin(),
                 [](int more) { return static_cast<char>(more > 0 ? 1 : 0); });
  return turned;
}

/// Goes from the vertices on the stack to neighbours for which visit(neighbour) is true, and on.
template <class Visit>
void flood(const VertexAdjacency& neighbours, std::vector<int> stack, const Visit& visit) {
  while (!stack.empty()) {
    const int v = stack.back();
    stack.pop_back();
    for (const int w : neighbours[at(v)]) {
      if (visit(w)) stack.push_back(w);
    }
  }
}

/// Offsets near the greatest, next to such vertices, are part of the same fan.
void spread(const CavityTask& task, const CavityResult& found, const VertexAdjacency& neighbours,
            Marks& turned) {
  constexpr double kShare = 0.75;
  const OffsetBounds& bounds = task.model.inner;
  std::vector<int> seeds;
  for (std::size_t v = 0; v < turned.size(); ++v) {
    if (turned[v] != 0) seeds.push_back(static_cast<int>(v));
  }
  flood(neighbours, std::move(seeds), [&](int w) {
    const double range = bounds.upper[w] - bounds.lower[w];
    if (turned[at(w)] != 0 || found.cavity.solid[at(w)] != 0 ||
        found.innerOffsets[w] - bounds.lower[w] < kShare * range)
      return false;
    turned[at(w)] = 1;
    return true;
  });
}

/// What turned, vertices with edges that became long as far as they hang together with it or with
/// what is solid, and the neighbours of these.
Marks fans(const CavityTask& task, const CavityResult& found, const VertexAdjacency& neighbours,
           const Marks& turned) {
  constexpr double kLong = 2.0; // times what it was
  const Points& before = task.model.surface->vertices;
  const Marks& solid = found.cavity.solid;
  const auto hasLongEdge = [&](int v) {
    const IndexRange around = neighbours[at(v)];
    return std::any_of(around.begin(), around.end(), [&](int w) {
      return solid[at(w)] == 0 && (found.inner.row(v) - found.inner.row(w)).squaredNorm() >
                                      kLong * kLong * (before.row(v) - before.row(w)).squaredNorm();
    });
  };
  std::vector<int> seeds;
  for (std::size_t v = 0; v < turned.size(); ++v) {
    if (turned[v] != 0 || solid[v] != 0) seeds.push_back(static_cast<int>(v));
  }
  Marks marks = turned;
  flood(neighbours, std::move(seeds), [&](int w) {
    if (marks[at(w)] != 0 || solid[at(w)] != 0 || !hasLongEdge(w)) return false;
    marks[at(w)] = 1;
    return true;
  });
  Marks all = marks;
  for (std::size_t v = 0; v < marks.size(); ++v) {
    if (marks[v] == 0) continue;
    for (const int w : neighbours[v]) {
      if (solid[at(w)] == 0) all[at(w)] = 1;
    }
  }
  return all;
}

} // namespace

CavityEnds cavityEnds(const CavityTask& task, const CavityResult& found,
                      const VertexAdjacency& neighbours) {
  const Marks& solid = found.cavity.solid;
  CavityEnds ends;
  ends.turned = turnedAway(task, found);
  spread(task, found, neighbours, ends.turned);
  const Marks fan = fans(task, found, neighbours, ends.turned);
  const auto goes = [&](int v) { return fan[at(v)] != 0 || solid[at(v)] != 0; };
  const auto belongs = [&](int v) {
    const IndexRange around = neighbours[at(v)];
    return solid[at(v)] == 0 && (goes(v) || std::any_of(around.begin(), around.end(), goes));
  };
  ends.end.assign(solid.size(), -1);
  for (int seed = 0; seed < static_cast<int>(solid.size()); ++seed) {
    if (ends.end[at(seed)] >= 0 || !belongs(seed)) continue;
    ends.end[at(seed)] = ends.count;
    flood(neighbours, {seed}, [&](int w) {
      if (ends.end[at(w)] >= 0 || !belongs(w)) return false;
      ends.end[at(w)] = ends.count;
      return true;
    });
    ++ends.count;
  }
  return ends;
}

} // namespace massprops
