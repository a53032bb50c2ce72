#include "core/query/surface_deviation.h"

#include "core/base/parallel.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace massprops {

double greatestDistance(const Points& vertices, const Faces& faces, const TriangleTree& other) {
  constexpr Eigen::Index kChunk = 256;
  std::vector<double> squared(static_cast<std::size_t>(chunkCount(faces.rows(), kChunk)), 0.0);
  forChunks(faces.rows(), kChunk, [&](const Chunk& chunk) {
    double& most = squared[static_cast<std::size_t>(chunk.number)];
    int hint = -1;
    const auto measure = [&](const Vec3& p) {
      const auto hit = other.nearest(p, std::numeric_limits<double>::infinity(), hint);
      hint = hit.face;
      most = std::max(most, hit.squaredDistance);
    };
    for (Eigen::Index f = chunk.begin; f < chunk.end; ++f) {
      Vec3 middle = Vec3::Zero();
      for (const int v : faces.row(f)) {
        const Vec3 p = vertices.row(v).transpose();
        measure(p);
        middle += p / 3.0;
      }
      measure(middle);
    }
  });
  double most = 0.0;
  for (const double part : squared) most = std::max(most, part);
  return std::sqrt(most);
}

} // namespace massprops
