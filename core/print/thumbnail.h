// A small picture of a body cut open.
#pragma once

#include "core/base/types.h"

#include <string>

namespace massprops {

/// A square PNG image, transparent around the body, which is seen from the front and cut along the
/// vertical plane through `point` (up is z). `material`: closed, outward; faces from `cavityFaces`
/// on bound its cavities, oriented into them.
std::string thumbnail(const TriangleMesh& material, Eigen::Index cavityFaces, const Vec3& point);

} // namespace massprops
