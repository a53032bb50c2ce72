#include "core/query/nesting.h"

#include "core/mesh/signed_volume.h"
#include "core/query/point_in_mesh.h"

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
  for (std::size_t c = 0; c < components.size(); ++c) {
    std::vector<std::size_t> candidates;
    for (std::size_t other = 0; other < components.size(); ++other) {
      if (other != c && boxes[c].contains(boxes[other])) candidates.push_back(other);
    }
    if (candidates.empty()) continue;
    Faces outward = components[c];
    if (signedVolume(vertices, outward) < 0.0) {
      flip(outward);
    }
    const TriangleTree tree(vertices, outward);
    for (const std::size_t other : candidates) {
      if (isInside(vertices, components[other], tree)) ++depths[other];
    }
  }
  return depths;
}

} // namespace massprops
