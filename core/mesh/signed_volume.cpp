#include "core/mesh/signed_volume.h"

#include "core/base/triangle.h"

namespace massprops {

double signedVolume(const Points& vertices, const Faces& faces) {
  if (faces.rows() == 0) return 0.0;
  // Tetrahedra (o, a, b, c) of volume (a−o)·((b−o)×(c−o))/6.
  const Vec3 o = vertices.row(faces(0, 0)).transpose();
  double sixfold = 0.0;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const Vec3 a = vertices.row(faces(f, 0)).transpose() - o;
    const Vec3 b = vertices.row(faces(f, 1)).transpose() - o;
    const Vec3 c = vertices.row(faces(f, 2)).transpose() - o;
    sixfold += a.dot(areaNormal(a, b, c));
  }
  return sixfold / 6.0;
}

} // namespace massprops
