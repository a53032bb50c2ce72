#include "core/answer/wall_at_vertices.h"

#include "core/base/parallel.h"

#include <cmath>

namespace massprops {

Vector wallAtVertices(const Points& points, const TriangleTree& outer) {
  Vector wall(points.rows());
  constexpr Eigen::Index kChunk = 256;
  forChunks(points.rows(), kChunk, [&](const Chunk& chunk) {
    for (Eigen::Index v = chunk.begin; v < chunk.end; ++v) {
      wall[v] = std::sqrt(outer.nearest(points.row(v).transpose()).squaredDistance);
    }
  });
  return wall;
}

} // namespace massprops
