// A body cut open, so that one sees its cavity.
#pragma once

#include "core/base/types.h"
#include "core/mesh/annotations.h"

#include <optional>

namespace massprops {

constexpr Colour kOuterColour{158, 184, 204};
constexpr Colour kCavityColour{143, 128, 194};
constexpr Colour kCutColour{242, 168, 64};

/// The half of the material on the side of the plane that `normal` points away from: what is left
/// of the outer surface and of the cavity, and the cut through the material, each in its colour and
/// with vertices of its own, so that it is shaded on its own. Closed where vertices that lie on
/// each other are merged; without faces when the half is empty. The plane is moved by 10⁻¹¹ of the
/// size off vertices that lie on it, and by up to a thousandth where it cannot be cut along; empty
/// where that does not help. `material`: closed, outward oriented, free of crossings. Faces with a
/// corner among the first `cavityVertices` vertices bound the cavity.
std::optional<ColouredMesh> cutaway(const TriangleMesh& material, Eigen::Index cavityVertices,
                                    const Vec3& point, const Vec3& normal);

} // namespace massprops
