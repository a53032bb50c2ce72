// How often triangles that need not be closed go round a point.
#pragma once

#include "core/base/types.h"

#include <vector>

namespace massprops {

/// The generalised winding number of oriented triangles: 1 inside of a closed surface, 0 outside,
/// in between near gaps. [JKS13] Far triangles are taken together as a dipole, so that it
/// is right within a few hundredths. [BDSLJ18] Refers to nothing.
class WindingNumber {
public:
  WindingNumber(const Points& vertices, const Faces& faces);

  double at(const Vec3& p) const;

private:
  struct Node {
    Vec3 centre;
    Vec3 areaNormal; ///< sum of the triangles' normals, as long as their areas
    double radius;   ///< of a ball around the centre that holds the triangles
    Eigen::Index begin, end;
    int right; ///< the left child follows the node; −1: a leaf
  };
  int build(Eigen::Index begin, Eigen::Index end);

  Points corners_; ///< of all triangles, three rows each, in spatial order
  std::vector<Node> nodes_;
};

} // namespace massprops
