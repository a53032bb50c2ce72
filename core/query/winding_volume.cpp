#include "core/query/winding_volume.h"

#include "core/base/parallel.h"
#include "core/query/winding_number.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace massprops {

WindingVolume windingVolumes(const TriangleMesh& mesh, const TriangleMesh& other) {
  constexpr double kCubes = 48.0; // along the longest side
  Eigen::AlignedBox3d box;
  for (const TriangleMesh* part : {&mesh, &other}) {
    if (part->vertices.rows() == 0) continue;
    box.extend(Vec3(part->vertices.colwise().minCoeff().transpose()));
    box.extend(Vec3(part->vertices.colwise().maxCoeff().transpose()));
  }
  if (box.isEmpty()) return {};
  const double side = box.sizes().maxCoeff() / kCubes;
  Eigen::Index count[3];
  for (int k = 0; k < 3; ++k) {
    count[k] =
        std::max<Eigen::Index>(1, static_cast<Eigen::Index>(std::ceil(box.sizes()[k] / side)));
  }
  const WindingNumber one(mesh.vertices, mesh.faces);
  const WindingNumber two(other.vertices, other.faces);
  std::vector<Eigen::Index> inside(static_cast<std::size_t>(count[2]), 0);
  std::vector<Eigen::Index> insideOther = inside;
  forChunks(count[2], 1, [&](const Chunk& chunk) {
    const auto z = static_cast<std::size_t>(chunk.begin);
    for (Eigen::Index y = 0; y < count[1]; ++y) {
      for (Eigen::Index x = 0; x < count[0]; ++x) {
        const Vec3 cube(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5,
                        static_cast<double>(z) + 0.5);
        const Vec3 p = box.min() + side * cube;
        if (std::abs(one.at(p)) >= 0.5) ++inside[z];
        if (std::abs(two.at(p)) >= 0.5) ++insideOther[z];
      }
    }
  });
  WindingVolume result;
  const double cube = side * side * side;
  for (const Eigen::Index n : inside) result.volume += cube * static_cast<double>(n);
  for (const Eigen::Index n : insideOther) result.otherVolume += cube * static_cast<double>(n);
  return result;
}

} // namespace massprops
