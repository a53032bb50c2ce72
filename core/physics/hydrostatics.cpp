#include "core/physics/hydrostatics.h"

#include "core/base/interruption.h"
#include "core/base/triangle.h"
#include "core/physics/immersion.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace massprops {
namespace {

/// A frame whose third row is `up`.
Mat3 frameOf(const Vec3& up) {
  Mat3 rows;
  rows.row(2) = up.transpose();
  rows.row(0) = up.unitOrthogonal().transpose();
  rows.row(1) = up.cross(rows.row(0).transpose()).transpose();
  return rows;
}

/// Sums over the wet part of the surface, in a frame with the water's surface at z = 0.
class WetSurface {
public:
  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    // Tetrahedra to the origin, which lies on the waterplane, so that the plane adds nothing.
    const double D = a.dot(areaNormal(a, b, c));
    const Vec3 s = a + b + c;
    volume += D / 6.0;
    first += D / 24.0 * s;
    // ∫q dA over the waterplane = −∫q n_z dA over the wet surface, for q does not depend on z.
    const Vec2 p = a.head<2>();
    const Vec2 q = b.head<2>();
    const Vec2 r = c.head<2>();
    const Vec2 sum = p + q + r;
    const double twice = (q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x());
    area -= twice / 2.0;
    areaFirst -= twice / 6.0 * sum;
    areaSecond -=
        twice / 24.0 *
        (sum * sum.transpose() + p * p.transpose() + q * q.transpose() + r * r.transpose());
  }

  double volume = 0.0;
  Vec3 first = Vec3::Zero();
  double area = 0.0;
  Vec2 areaFirst = Vec2::Zero();
  Eigen::Matrix2d areaSecond = Eigen::Matrix2d::Zero();
};

} // namespace

Displacement displacement(const Points& vertices, const Faces& faces, const Vec3& up,
                          double level) {
  checkpoint();
  const Mat3 frame = frameOf(up);
  // Near the body, lest the integrals cancel.
  const Vec3 mean = vertices.colwise().mean().transpose();
  const Vec3 origin = mean + (level - up.dot(mean)) * up;
  const Points x = (vertices.rowwise() - origin.transpose()) * frame.transpose();
  WetSurface wet;
  const auto isWet = [&](int v) { return x(v, 2) <= 0.0; };
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const int wetCorners = isWet(faces(f, 0)) + isWet(faces(f, 1)) + isWet(faces(f, 2));
    if (wetCorners == 0) continue;
    if (wetCorners == 3) {
      wet.add(x.row(faces(f, 0)).transpose(), x.row(faces(f, 1)).transpose(),
              x.row(faces(f, 2)).transpose());
      continue;
    }
    std::array<Vec3, 4> part;
    std::size_t corners = 0;
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = x.row(faces(f, k)).transpose();
      const Vec3 q = x.row(faces(f, (k + 1) % 3)).transpose();
      if (p.z() <= 0.0) part[corners++] = p;
      if ((p.z() <= 0.0) == (q.z() <= 0.0)) continue;
      // From the lower end, so that both triangles at the edge get the same point.
      const Vec3& low = p.z() <= 0.0 ? p : q;
      const Vec3& high = p.z() <= 0.0 ? q : p;
      Vec3 cut = low + low.z() / (low.z() - high.z()) * (high - low);
      cut.z() = 0.0;
      part[corners++] = cut;
    }
    for (std::size_t k = 2; k < corners; ++k) wet.add(part[0], part[k - 1], part[k]);
  }
  Displacement result;
  result.volume = wet.volume;
  result.centre = origin;
  if (wet.volume > 0.0) result.centre += frame.transpose() * (wet.first / wet.volume);
  result.waterplaneArea = std::max(0.0, wet.area);
  if (wet.area > 0.0) {
    Mat3 moment = Mat3::Zero();
    moment.topLeftCorner<2, 2>() =
        wet.areaSecond - wet.areaFirst * wet.areaFirst.transpose() / wet.area;
    result.waterplaneMoment = frame.transpose() * moment * frame;
  }
  return result;
}

std::vector<std::pair<Vec3, Vec3>> levelLines(const Points& vertices, const Faces& faces,
                                              const Vec3& up, double level) {
  const Vector heights = (vertices * up).array() - level;
  std::vector<std::pair<Vec3, Vec3>> lines;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    std::array<Vec3, 2> ends;
    std::size_t found = 0;
    for (int k = 0; k < 3; ++k) {
      const int p = faces(f, k);
      const int q = faces(f, (k + 1) % 3);
      if ((heights[p] <= 0.0) == (heights[q] <= 0.0)) continue;
      const double share = heights[p] / (heights[p] - heights[q]);
      ends[found++] = ((1.0 - share) * vertices.row(p) + share * vertices.row(q)).transpose();
    }
    if (found == 2) lines.emplace_back(ends[0], ends[1]);
  }
  return lines;
}

double levelFor(const Points& vertices, const Faces& faces, const Vec3& up, double volume) {
  return Immersion(vertices, faces, up).levelFor(volume);
}

} // namespace massprops
