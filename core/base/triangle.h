// One triangle (a, b, c).
#pragma once

#include "core/base/types.h"

namespace massprops {

/// Normal to the triangle, as long as twice its area, to the side from which it is
/// counter-clockwise.
inline Vec3 areaNormal(const Vec3& a, const Vec3& b, const Vec3& c) {
  return (b - a).cross(c - a);
}

/// Of row f of `faces`.
inline Vec3 areaNormal(const Points& vertices, const Faces& faces, Eigen::Index f) {
  return areaNormal(vertices.row(faces(f, 0)).transpose(), vertices.row(faces(f, 1)).transpose(),
                    vertices.row(faces(f, 2)).transpose());
}

/// Of all faces, in squares of the vertices' unit.
inline double surfaceArea(const Points& vertices, const Faces& faces) {
  double area = 0.0;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    area += 0.5 * areaNormal(vertices, faces, f).norm();
  }
  return area;
}

/// Unit normals of a surface's vertices, outward: means of the faces' by their areas. n×3; 0 where
/// there is no face.
Points vertexNormals(const Points& vertices, const Faces& faces);

/// Degrees; 0 where the triangle has no area.
double leastAngle(const Vec3& a, const Vec3& b, const Vec3& c);

/// The point of the triangle (a, b, c) next to p, by its weights at the corners. [Eri05,
/// Sec. 5.1.5]
Vec3 nearestWeights(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

} // namespace massprops
