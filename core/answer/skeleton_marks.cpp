#include "core/answer/skeleton_marks.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace massprops {
namespace {

constexpr Eigen::Index kMostLines = 300;

/// Rows of which each is as far as can be from those before it.
std::vector<int> evenlySpread(const Points& points, Eigen::Index count) {
  std::vector<int> chosen;
  Vector distance = Vector::Constant(points.rows(), std::numeric_limits<double>::infinity());
  Eigen::Index next = 0;
  while (static_cast<Eigen::Index>(chosen.size()) < std::min(count, points.rows())) {
    chosen.push_back(static_cast<int>(next));
    distance = distance.cwiseMin((points.rowwise() - points.row(next)).rowwise().squaredNorm());
    distance.maxCoeff(&next);
  }
  return chosen;
}

} // namespace

ColouredMesh skeletonMarks(const TriangleMesh& surface, const Skeleton& skeleton) {
  Annotations marks(surface.vertices);
  for (Eigen::Index s = 0; s < skeleton.segments.rows(); ++s) {
    marks.addLine(skeleton.nodes.row(skeleton.segments(s, 0)).transpose(),
                  skeleton.nodes.row(skeleton.segments(s, 1)).transpose(), kSkeletonColour);
  }
  for (const int v : evenlySpread(surface.vertices, kMostLines)) {
    marks.addLine(surface.vertices.row(v).transpose(), skeleton.points.row(v).transpose(),
                  kCorrespondenceColour, Pen::Fine);
  }
  return marks.mesh();
}

} // namespace massprops
