#include "core/answer/wall_at_vertices.h"

#include "core/base/parallel.h"

#include <cmath>
#include <limits>

namespace massprops {
namespace {

constexpr double kRounding = 1e-9;
constexpr double kAnywhere = std::numeric_limits<double>::infinity();

} // namespace

Vector wallAtVertices(const Points& points, const TriangleTree& outer,
                      const Inspection& inspection) {
  Vector wall(points.rows());
  constexpr Eigen::Index kChunk = 256;
  forChunks(points.rows(), kChunk, [&](const Chunk& chunk) {
    for (Eigen::Index v = chunk.begin; v < chunk.end; ++v) {
      const Vec3 x = points.row(v).transpose();
      const int face = inspection.nearestFace[static_cast<std::size_t>(v)];
      double& distance = wall[v];
      distance = face < 0 ? kAnywhere : std::sqrt(outer.nearestOn(face, x).squaredDistance);
      if (distance <= (1.0 + kRounding) * inspection.wallOfVertexAtLeast[v]) continue;
      distance = std::sqrt(outer.nearest(x, kAnywhere, face).squaredDistance);
    }
  });
  return wall;
}

} // namespace massprops
