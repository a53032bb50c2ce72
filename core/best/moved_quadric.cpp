#include "core/best/moved_quadric.h"

#include <Eigen/QR>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace massprops {
namespace {

/// Of one layer: the cut is to go through some points, those of what else there is stay on their
/// side.
Moments quadricThrough(const Moments& quadric, const Points& onCut, const Points& others) {
  constexpr double kOthers = 0.03; // of the weight of points on the cut
  constexpr double kFlat = 0.05;   // of the mean gradient: next to where it vanishes
  const Eigen::Index count = onCut.rows() + others.rows();
  RowMatrix rows(count, 10);
  Vector wanted = Vector::Zero(count);
  double mean = 0.0;
  for (Eigen::Index i = 0; i < count; ++i) {
    const bool isOnCut = i < onCut.rows();
    const Vec3 x = (isOnCut ? onCut.row(i) : others.row(i - onCut.rows())).transpose();
    const double steepness = gradientAt(quadric, x).norm();
    if (isOnCut) mean += steepness / static_cast<double>(onCut.rows());
    const double weight = (isOnCut ? 1.0 : kOthers) / std::max(steepness, kFlat * mean);
    rows.row(i) = weight * monomials(x).transpose();
    if (isOnCut) wanted[i] = -weight * quadric.dot(monomials(x));
  }
  return quadric + Moments(rows.completeOrthogonalDecomposition().solve(wanted));
}

double squaredDistance(const Moments& quadric, const Vec3& x) {
  const double value = quadric.dot(monomials(x));
  const double squaredSteepness = gradientAt(quadric, x).squaredNorm();
  return value * value / std::max(squaredSteepness, std::numeric_limits<double>::min());
}

} // namespace

std::optional<LayeredQuadric> quadricThrough(const LayeredQuadric& quadric, const Contour& contour,
                                             const Points& vertices) {
  constexpr double kNear = 0.5; // of how far they went, root mean squares
  double moved = 0.0;
  double left = 0.0;
  LayeredQuadric result = quadric;
  for (std::size_t layer = 0; layer < quadric.quadrics.size(); ++layer) {
    std::vector<Eigen::Index> onCut, others;
    for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
      if (quadric.layerAt(vertices(v, 2)) != layer) continue;
      const bool isOnCut = contour.on[static_cast<std::size_t>(v)] == On::Cut;
      (isOnCut ? onCut : others).push_back(v);
    }
    if (onCut.empty()) continue;
    result.quadrics[layer] = quadricThrough(quadric.quadrics[layer], vertices(onCut, Eigen::all),
                                            vertices(others, Eigen::all));
    for (const Eigen::Index v : onCut) {
      moved += (vertices.row(v) - contour.mesh.vertices.row(v)).squaredNorm();
      left += squaredDistance(result.quadrics[layer], vertices.row(v).transpose());
    }
  }
  if (left > kNear * kNear * moved) return {};
  return result;
}

} // namespace massprops
