#include "core/answer/wall_at_vertices.h"

#include "core/base/infinity.h"
#include "core/base/parallel.h"
#include "core/query/triangle_distance.h"

#include <cmath>

namespace massprops {

Vector wallAtVertices(const Points& points, const TriangleTree& outer,
                      const Inspection& inspection) {
  Vector wall(points.rows());
  constexpr Eigen::Index kChunk = 256;
  forChunks(points.rows(), kChunk, [&](const Chunk& chunk) {
    for (Eigen::Index v = chunk.begin; v < chunk.end; ++v) {
      const Vec3 x = points.row(v).transpose();
      const int face = inspection.nearestFace[static_cast<std::size_t>(v)];
      double& distance = wall[v];
      distance = face < 0 ? kInfinity : std::sqrt(outer.nearestOn(face, x).squaredDistance);
      if (distance <= (1.0 + kMeasured) * inspection.wallOfVertexAtLeast[v]) continue;
      distance = std::sqrt(outer.nearest(x, kInfinity, face).squaredDistance);
    }
  });
  return wall;
}

} // namespace massprops
