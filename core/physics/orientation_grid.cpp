#include "core/physics/orientation_grid.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace massprops {
namespace {

using Index = std::size_t;

/// The icosahedron's 12 corners and 20 faces, each face cut in four as often as said.
OrientationGrid gridOf(int cuts) {
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  OrientationGrid grid;
  for (const double s : {1.0, -1.0}) {
    for (const double t : {g, -g}) {
      grid.ups.push_back(Vec3(0.0, s, t).normalized());
      grid.ups.push_back(Vec3(s, t, 0.0).normalized());
      grid.ups.push_back(Vec3(t, 0.0, s).normalized());
    }
  }
  using Corners = std::array<Index, 3>;
  std::vector<Corners> faces;
  // Edges span an angle with the cosine 1/√5.
  const auto touch = [&](Index i, Index j) { return grid.ups[i].dot(grid.ups[j]) > 0.4; };
  for (Index i = 0; i < 12; ++i) {
    for (Index j = i + 1; j < 12; ++j) {
      for (Index k = j + 1; k < 12; ++k) {
        if (touch(i, j) && touch(j, k) && touch(k, i)) faces.push_back({i, j, k});
      }
    }
  }
  std::map<std::pair<Index, Index>, Index> middles;
  const auto middle = [&](Index i, Index j) {
    const auto [at, isNew] = middles.try_emplace(std::minmax(i, j), grid.ups.size());
    if (isNew) grid.ups.push_back((grid.ups[i] + grid.ups[j]).normalized());
    return at->second;
  };
  for (int cut = 0; cut < cuts; ++cut) {
    std::vector<Corners> finer;
    for (const auto& [i, j, k] : faces) {
      const Corners m{middle(i, j), middle(j, k), middle(k, i)};
      finer.insert(finer.end(), {{i, m[0], m[2]}, {j, m[1], m[0]}, {k, m[2], m[1]}, m});
    }
    faces = std::move(finer);
  }
  for (const Corners& f : faces) {
    for (Index k = 0; k < 3; ++k) {
      const Index i = f[k];
      const Index j = f[(k + 1) % 3];
      // Each edge comes in both of its faces; their orientations differ from face to face.
      if (!middles.try_emplace(std::minmax(i, j), 0).second) continue;
      grid.edges.push_back({i, j});
      grid.spacing = std::max(grid.spacing, (grid.ups[i] - grid.ups[j]).norm());
    }
  }
  return grid;
}

} // namespace

const OrientationGrid& orientationGrid() {
  static const OrientationGrid grid = gridOf(4);
  return grid;
}

} // namespace massprops
