#include "core/drill/hole.h"

#include "core/base/angles.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace massprops {

TriangleMesh drillOf(const Hole& hole, double clearance, double turn) {
  constexpr int kSides = 32;
  const Vec3 u = hole.direction.unitOrthogonal();
  const Vec3 v = hole.direction.cross(u);
  // The cone's own normal leans by the widening; the sides' middles touch it.
  const double inwards = clearance * std::hypot(1.0, Hole::kWidening);
  const double outwards = 1.0 / std::cos(kPi / kSides);
  TriangleMesh drill{Points(2 * kSides + 2, 3), Faces(4 * kSides, 3)};
  const Vec3 far = hole.centre + hole.length * hole.direction;
  for (int i = 0; i < kSides; ++i) {
    const double angle = turn + 2.0 * kPi * i / kSides;
    const Vec3 spoke = outwards * (std::cos(angle) * u + std::sin(angle) * v);
    drill.vertices.row(i) = hole.centre + (hole.radius - inwards) * spoke;
    drill.vertices.row(kSides + i) = far + (hole.radiusAt(hole.length) - inwards) * spoke;
    const int j = (i + 1) % kSides;
    drill.faces.row(4 * i) << 2 * kSides, j, i;
    drill.faces.row(4 * i + 1) << i, j, kSides + j;
    drill.faces.row(4 * i + 2) << i, kSides + j, kSides + i;
    drill.faces.row(4 * i + 3) << 2 * kSides + 1, kSides + i, kSides + j;
  }
  drill.vertices.row(2 * kSides) = hole.centre;
  drill.vertices.row(2 * kSides + 1) = far;
  return drill;
}

double axisDistance(const Hole& a, const Hole& b) {
  constexpr int kSteps = 32;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= kSteps; ++i) {
    const Vec3 p = a.centre + a.length * i / kSteps * a.direction;
    const double along = std::clamp((p - b.centre).dot(b.direction), 0.0, b.length);
    least = std::min(least, (p - b.centre - along * b.direction).norm());
  }
  return least;
}

} // namespace massprops
