// Around which vertices a surface does not cross itself.
#pragma once

#include "core/base/types.h"

#include <vector>

namespace massprops {

struct FaceNormal {
  Vec3 vector;   ///< `areaNormal`
  double length; ///< product of the lengths of two edges, the scale of the vector's rounding
};
FaceNormal faceNormal(const Points& vertices, const Faces& faces, Eigen::Index f);

/// Whether the angle to a unit vector is certainly less than a right one.
bool facesTowards(const FaceNormal& normal, const Vec3& unit);

/// For every vertex 1 where its fan is certainly embedded: all its triangles face one direction and
/// go round it once, seen from there. `opposite`: `oppositeHalfEdges`.
std::vector<char> embeddedFans(const Points& vertices, const Faces& faces,
                               const std::vector<int>& opposite);

} // namespace massprops
