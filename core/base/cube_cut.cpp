#include "core/base/cube_cut.h"

#include <cmath>

namespace massprops {
namespace {

/// Smaller components would make the simplices so long that their differences cancel.
constexpr double kLeastComponent = 0.01;

/// Of the points x of the unit cube [0, 1]³ with n·x ≤ depth, all components of n positive.
CubeCut cornerCut(const Vec3& n, double depth) {
  CubeCut cut;
  Vec3 first = Vec3::Zero();
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 v(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
    const double rest = depth - n.dot(v);
    if (rest <= 0.0) continue;
    const double sign = (static_cast<int>(v.sum()) & 1) == 0 ? 1.0 : -1.0;
    const double volume = sign * rest * rest * rest / (6.0 * n.prod());
    cut.volume += volume;
    first += volume * (v + 0.25 * rest * n.cwiseInverse());
  }
  cut.centroid = first / cut.volume;
  return cut;
}

} // namespace

CubeCut cubeCut(const Vec3& normal, double depth) {
  const Vec3 n = normal.cwiseAbs().cwiseMax(kLeastComponent);
  const double half = 0.5 * n.sum();
  if (depth <= -half) return {1.0, Vec3::Zero()};
  if (depth >= half) return {};
  // The smaller part is at a corner, seen from which the normal points inwards.
  const CubeCut corner = cornerCut(n, half - std::abs(depth));
  // At the corner that the normal points to where depth > 0, else at the opposite one.
  const double towards = depth > 0.0 ? 1.0 : -1.0;
  Vec3 centroid = towards * (Vec3::Constant(0.5) - corner.centroid);
  for (int i = 0; i < 3; ++i) {
    if (normal[i] < 0.0) centroid[i] = -centroid[i];
  }
  if (depth > 0.0) return {corner.volume, centroid};
  return {1.0 - corner.volume, -corner.volume / (1.0 - corner.volume) * centroid};
}

} // namespace massprops
