#include "core/query/nesting.h"

#include "core/mesh/signed_volume.h"
#include "core/query/point_in_mesh.h"

#include <algorithm>
#include <numeric>

namespace massprops {

std::vector<int> nestingDepths(const Points& vertices, const Components& components) {
  std::vector<int> depths(components.size(), 0);
  if (components.size() < 2) return depths;
  // Without crossings a component lies inside of another one with all its points or with none, and
  // then its box does, too.
  std::vector<Eigen::AlignedBox3d> boxes(components.size());
  for (std::size_t c = 0; c < components.size(); ++c) {
    for (Eigen::Index i = 0; i < components[c].size(); ++i) {
      boxes[c].extend(Vec3(vertices.row(components[c].data()[i]).transpose()));
    }
  }
  // From left to right, so that few boxes need a look.
  std::vector<std::size_t> order(components.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto leftOf = [&](std::size_t c) { return boxes[c].min().x(); };
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return leftOf(a) < leftOf(b); });
  for (auto outer = order.begin(); outer != order.end(); ++outer) {
    const std::size_t c = *outer;
    std::vector<std::size_t> candidates;
    const auto first = std::partition_point(
        order.begin(), outer, [&](std::size_t other) { return leftOf(other) < leftOf(c); });
    for (auto i = first; i != order.end() && leftOf(*i) <= boxes[c].max().x(); ++i) {
      if (*i != c && boxes[c].contains(boxes[*i])) candidates.push_back(*i);
    }
    if (candidates.empty()) continue;
    Faces outward = components[c];
    if (signedVolume(vertices, outward) < 0.0) flip(outward);
    const TriangleTree tree(vertices, outward);
    const PointInMesh inside(tree);
    for (const std::size_t other : candidates) {
      if (inside.contains(vertices, components[other])) ++depths[other];
    }
  }
  return depths;
}

} // namespace massprops
