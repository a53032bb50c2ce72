#include "core/mesh/signed_volume.h"

namespace massprops {

double signedVolume(const Points& vertices, const Faces& faces) {
  if (faces.rows() == 0) return 0.0;
  // Tetrahedra (o, a, b, c) of volume (a−o)·((b−o)×(c−o))/6.
  const Eigen::RowVector3d o = vertices.row(faces(0, 0));
  double sixfold = 0.0;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const Eigen::RowVector3d a = vertices.row(faces(f, 0)) - o;
    const Eigen::RowVector3d b = vertices.row(faces(f, 1)) - o;
    const Eigen::RowVector3d c = vertices.row(faces(f, 2)) - o;
    sixfold += a.dot((b - a).cross(c - a));
  }
  return sixfold / 6.0;
}

void flip(Faces& faces) {
  faces.col(1).swap(faces.col(2));
}

} // namespace massprops
