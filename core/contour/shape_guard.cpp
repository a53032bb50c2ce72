#include "core/contour/shape_guard.h"

#include "core/base/triangle.h"
#include "core/mesh/connectivity.h"

#include <algorithm>

namespace massprops {
namespace {

bool staysSound(const Points& vertices, const Faces& faces, IndexRange corners, const Vec3& x) {
  constexpr double kLeastCosine = 0.34;
  constexpr double kSmallAngle = 6.0;
  return std::all_of(corners.begin(), corners.end(), [&](int h) {
    const Vec3 a = vertices.row(faces(h / 3, h % 3)).transpose();
    const int next = nextHalfEdge(h);
    const int last = nextHalfEdge(next);
    const Vec3 b = vertices.row(faces(h / 3, next % 3)).transpose();
    const Vec3 c = vertices.row(faces(h / 3, last % 3)).transpose();
    const Vec3 before = areaNormal(a, b, c);
    const Vec3 after = areaNormal(x, b, c);
    if (!(before.dot(after) > kLeastCosine * before.norm() * after.norm())) return false;
    const double angle = leastAngle(x, b, c);
    return angle >= kSmallAngle || angle >= leastAngle(a, b, c);
  });
}

} // namespace

void moveSoundly(const Points& targets, const Faces& faces, Points& vertices) {
  const VertexCorners corners = vertexCorners(vertices.rows(), faces);
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    const Vec3 from = vertices.row(v).transpose();
    const Vec3 way = targets.row(v).transpose() - from;
    if (way.isZero(0.0)) continue;
    for (const double share : {1.0, 0.5}) {
      const Vec3 x = from + share * way;
      if (!staysSound(vertices, faces, corners.at(v), x)) continue;
      vertices.row(v) = x.transpose();
      break;
    }
  }
}

} // namespace massprops
