#include "core/query/winding_volume.h"

#include "core/base/parallel.h"
#include "core/query/winding_number.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace massprops {

namespace {

/// A low-discrepancy sequence in the unit cube: no grid, which would miss plates between its
/// layers.
Vec3 scattered(Eigen::Index i) {
  constexpr double kPlastic = 1.2207440846057596; // root of x⁴ = x + 1
  const auto turn = [&](int power) {
    return std::fmod(0.5 + static_cast<double>(i) / std::pow(kPlastic, power), 1.0);
  };
  return {turn(1), turn(2), turn(3)};
}

} // namespace

WindingVolume windingVolumes(const TriangleMesh& mesh, const TriangleMesh& other) {
  constexpr Eigen::Index kPoints = 16384;
  constexpr Eigen::Index kRun = 512;
  Eigen::AlignedBox3d box;
  for (const TriangleMesh* part : {&mesh, &other}) {
    if (part->vertices.rows() == 0) continue;
    box.extend(Vec3(part->vertices.colwise().minCoeff().transpose()));
    box.extend(Vec3(part->vertices.colwise().maxCoeff().transpose()));
  }
  if (box.isEmpty()) return {};
  const WindingNumber one(mesh.vertices, mesh.faces);
  const WindingNumber two(other.vertices, other.faces);
  std::vector<Eigen::Index> inside(static_cast<std::size_t>(chunkCount(kPoints, kRun)), 0);
  std::vector<Eigen::Index> insideOther = inside;
  forChunks(kPoints, kRun, [&](const Chunk& chunk) {
    const auto run = static_cast<std::size_t>(chunk.number);
    for (Eigen::Index i = chunk.begin; i < chunk.end; ++i) {
      const Vec3 p = box.min() + box.sizes().cwiseProduct(scattered(i));
      if (std::abs(one.at(p)) >= 0.5) ++inside[run];
      if (std::abs(two.at(p)) >= 0.5) ++insideOther[run];
    }
  });
  const double share = box.volume() / static_cast<double>(kPoints);
  WindingVolume result;
  for (const Eigen::Index n : inside) result.volume += share * static_cast<double>(n);
  for (const Eigen::Index n : insideOther) result.otherVolume += share * static_cast<double>(n);
  return result;
}

} // namespace massprops
