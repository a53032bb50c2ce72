// What a body displaces, held at some level in the water.
#pragma once

#include "core/base/types.h"

#include <utility>
#include <vector>

namespace massprops {

/// The part of a body below the plane `up`·x = `level`, and the plane's cut through the body.
struct Displacement {
  double volume = 0.0;
  Vec3 centre = Vec3::Zero(); ///< centre of buoyancy; meaningless without volume
  double waterplaneArea = 0.0;
  /// ∫(x − x̄)(x − x̄)ᵀdA over the waterplane, x̄ its centroid; `up` is in the kernel. length⁴
  Mat3 waterplaneMoment = Mat3::Zero();
};

/// Exact for a closed polyhedron: the triangles are clipped by the plane. `up`: unit.
/// docs/math.md "Displaced volume"
Displacement displacement(const Points& vertices, const Faces& faces, const Vec3& up, double level);

/// Where the plane cuts the surface: a segment a face.
std::vector<std::pair<Vec3, Vec3>> levelLines(const Points& vertices, const Faces& faces,
                                              const Vec3& up, double level);

/// The level at which the body displaces `volume`, between 0 and the body's own.
double levelFor(const Points& vertices, const Faces& faces, const Vec3& up, double volume);

} // namespace massprops
