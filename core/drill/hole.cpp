#include "core/drill/hole.h"

#include "core/base/angles.h"
#include "core/query/triangle_distance.h"

#include <cmath>

namespace massprops {

TriangleMesh drillOf(const Hole& hole, double clearance) {
  // Radians, no share of a side's angle: sides along those of a box would make cuts that CGAL
  // sometimes cannot tell.
  constexpr double kTurn = 0.0371;
  const Vec3 u = hole.direction.unitOrthogonal();
  const Vec3 v = hole.direction.cross(u);
  // The cone's own normal leans by the widening; the sides' middles touch it.
  const double inwards = clearance * std::hypot(1.0, Hole::kWidening);
  const double outwards = 1.0 / std::cos(kPi / Hole::kSides);
  TriangleMesh drill{Points(2 * Hole::kSides + 2, 3), Faces(4 * Hole::kSides, 3)};
  const Vec3 far = hole.centre + hole.length * hole.direction;
  for (int i = 0; i < Hole::kSides; ++i) {
    const double angle = kTurn + 2.0 * kPi * i / Hole::kSides;
    const Vec3 spoke = outwards * (std::cos(angle) * u + std::sin(angle) * v);
    drill.vertices.row(i) = hole.centre + (hole.radius - inwards) * spoke;
    drill.vertices.row(Hole::kSides + i) = far + (hole.radiusAt(hole.length) - inwards) * spoke;
    const int j = (i + 1) % Hole::kSides;
    drill.faces.row(4 * i) << 2 * Hole::kSides, j, i;
    drill.faces.row(4 * i + 1) << i, j, Hole::kSides + j;
    drill.faces.row(4 * i + 2) << i, Hole::kSides + j, Hole::kSides + i;
    drill.faces.row(4 * i + 3) << 2 * Hole::kSides + 1, Hole::kSides + i, Hole::kSides + j;
  }
  drill.vertices.row(2 * Hole::kSides) = hole.centre;
  drill.vertices.row(2 * Hole::kSides + 1) = far;
  return drill;
}

double axisDistance(const Hole& a, const Hole& b) {
  return std::sqrt(squaredDistanceOfSegments(a.centre, a.centre + a.length * a.direction, b.centre,
                                             b.centre + b.length * b.direction));
}

} // namespace massprops
