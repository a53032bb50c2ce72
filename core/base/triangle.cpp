#include "core/base/triangle.h"

#include "core/base/angles.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace massprops {

Points vertexNormals(const Points& vertices, const Faces& faces) {
  Points normals = Points::Zero(vertices.rows(), 3);
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const Vec3 normal = areaNormal(vertices, faces, f);
    for (const int v : faces.row(f)) normals.row(v) += normal.transpose();
  }
  for (Eigen::Index v = 0; v < normals.rows(); ++v) {
    const double length = normals.row(v).norm();
    if (length > 0.0) normals.row(v) /= length;
  }
  return normals;
}

double leastAngle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double ab = (b - a).squaredNorm();
  const double bc = (c - b).squaredNorm();
  const double ca = (a - c).squaredNorm();
  // Opposite to the shortest side: its cosine times the two others.
  const double product = 0.5 * (ab + bc + ca) - std::min({ab, bc, ca});
  return std::atan2(areaNormal(a, b, c).norm(), product) * kDegrees;
}

Vec3 nearestWeights(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a;
  const Vec3 ac = c - a;
  const Vec3 ap = p - a;
  const double d1 = ab.dot(ap);
  const double d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return {1.0, 0.0, 0.0};
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp);
  const double d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return {0.0, 1.0, 0.0};
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp);
  const double d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return {0.0, 0.0, 1.0};
  // Twice the areas of the triangles that the foot makes with the sides, times the normal's length;
  // from the vectors to the corners, for differences of the products above cancel on slivers.
  const Vec3 normal = ab.cross(ac);
  const double va = normal.dot(bp.cross(cp));
  const double vb = normal.dot(cp.cross(ap));
  const double vc = normal.dot(ap.cross(bp));
  if (va > 0.0 && vb > 0.0 && vc > 0.0) {
    const double sum = va + vb + vc;
    return {va / sum, vb / sum, vc / sum};
  }
  // Outside: the nearest point of the three sides.
  const auto along = [](double from, double to) {
    return from + to > 0.0 ? std::clamp(from / (from + to), 0.0, 1.0) : 0.0;
  };
  const double onAb = along(d1, -d3);
  const double onAc = along(d2, -d6);
  const double onBc = along(d4 - d3, d5 - d6);
  const Vec3 candidates[3] = {
      {1.0 - onAb, onAb, 0.0}, {1.0 - onAc, 0.0, onAc}, {0.0, 1.0 - onBc, onBc}};
  int best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const Vec3& w = candidates[i];
    const double distance = (w[0] * ap + w[1] * bp + w[2] * cp).squaredNorm();
    if (distance < least) {
      least = distance;
      best = i;
    }
  }
  return candidates[best];
}

} // namespace massprops
