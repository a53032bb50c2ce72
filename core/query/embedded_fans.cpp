#include "core/query/embedded_fans.h"

#include "core/base/parallel.h"
#include "core/base/triangle.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/degenerate_faces.h"

#include <algorithm>
#include <cmath>

namespace massprops {
namespace {

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

/// \param fan all corners of the vertex, closed
bool isEmbedded(const Points& x, const Faces& faces, Eigen::Index v, const std::vector<int>& fan) {
  Vec3 axis = Vec3::Zero();
  for (const int corner : fan) {
    const Vec3 n = areaNormal(x, faces, corner / 3);
    const double length = n.norm();
    if (length > 0.0) axis += n / length;
  }
  axis.normalize();
  if (!std::all_of(fan.begin(), fan.end(), [&](int corner) {
        return facesTowards(faceNormal(x, faces, corner / 3), axis);
      })) {
    return false;
  }
  // In projection every triangle turns to the left by less than half a turn: the link passes from
  // below to above a line through the vertex, on its right, once a turn.
  const Vec3 across = axis.unitOrthogonal();
  int turns = 0;
  for (const int corner : fan) {
    const double from = (x.row(faces.data()[nextHalfEdge(corner)]) - x.row(v)).dot(across);
    const double to = (x.row(faces.data()[previousHalfEdge(corner)]) - x.row(v)).dot(across);
    if (from < 0.0 && to >= 0.0) ++turns;
  }
  return turns == 1;
}

} // namespace

FaceNormal faceNormal(const Points& vertices, const Faces& faces, Eigen::Index f) {
  const Vec3 a = vertices.row(faces(f, 0)).transpose();
  const Vec3 ab = vertices.row(faces(f, 1)).transpose() - a;
  const Vec3 ac = vertices.row(faces(f, 2)).transpose() - a;
  return {ab.cross(ac), std::sqrt(ab.squaredNorm() * ac.squaredNorm())};
}

bool facesTowards(const FaceNormal& normal, const Vec3& unit) {
  return normal.vector.dot(unit) > kSafe * normal.length;
}

std::vector<char> embeddedFans(const Points& vertices, const Faces& faces,
                               const std::vector<int>& opposite) {
  // A corner of each vertex, and how many there are: those of two fans that meet in it do not form
  // one.
  std::vector<int> cornerOf(at(vertices.rows()), -1);
  std::vector<int> count(at(vertices.rows()), 0);
  for (int corner = 0; corner < static_cast<int>(faces.size()); ++corner) {
    const std::size_t v = at(faces.data()[corner]);
    cornerOf[v] = corner;
    ++count[v];
  }
  std::vector<char> isEmbeddedFan(at(vertices.rows()));
  constexpr Eigen::Index kChunk = 4096;
  forChunks(vertices.rows(), kChunk, [&](const Chunk& chunk) {
    std::vector<int> fan;
    for (Eigen::Index v = chunk.begin; v < chunk.end; ++v) {
      const auto corners = static_cast<std::size_t>(count[at(v)]);
      fan.clear();
      int corner = cornerOf[at(v)];
      while (corner >= 0 && fan.size() < corners && (fan.empty() || corner != fan.front())) {
        fan.push_back(corner);
        corner = opposite[at(previousHalfEdge(corner))];
      }
      const bool isAll = fan.size() == corners && !fan.empty() && corner == fan.front();
      isEmbeddedFan[at(v)] = isAll && isEmbedded(vertices, faces, v, fan) ? 1 : 0;
    }
  });
  return isEmbeddedFan;
}

} // namespace massprops
