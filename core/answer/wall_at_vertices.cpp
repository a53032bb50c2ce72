#include "core/answer/wall_at_vertices.h"

#include "core/base/parallel.h"

#include <cmath>
#include <limits>

namespace massprops {

Vector wallAtVertices(const Points& points, const TriangleTree& outer,
                      const std::vector<int>& near) {
  Vector wall(points.rows());
  constexpr Eigen::Index kChunk = 256;
  forChunks(points.rows(), kChunk, [&](const Chunk& chunk) {
    for (Eigen::Index v = chunk.begin; v < chunk.end; ++v) {
      constexpr double kAnywhere = std::numeric_limits<double>::infinity();
      const int face = near[static_cast<std::size_t>(v)];
      wall[v] =
          std::sqrt(outer.nearest(points.row(v).transpose(), kAnywhere, face).squaredDistance);
    }
  });
  return wall;
}

} // namespace massprops
