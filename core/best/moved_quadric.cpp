#include "core/best/moved_quadric.h"

#include "core/contour/region.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace massprops {
namespace {

/// Of one layer: its cut through some points, its values at others as they are, as far as that
/// goes.
Moments quadricThrough(const Moments& quadric, const Points& onCut, const Points& others) {
  constexpr double kOthers = 0.03; // of the weight of points on the cut
  constexpr double kFlat = 0.05;   // of the mean gradient: next to where it vanishes
  const Eigen::Index count = onCut.rows() + others.rows();
  const auto at = [&](Eigen::Index i) {
    return Vec3((i < onCut.rows() ? onCut.row(i) : others.row(i - onCut.rows())).transpose());
  };
  Vector steepness(count);
  for (Eigen::Index i = 0; i < count; ++i) steepness[i] = gradientAt(quadric, at(i)).norm();
  const double least = kFlat * steepness.head(onCut.rows()).mean();
  RowMatrix rows(count, 10);
  Vector wanted = Vector::Zero(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const bool isOnCut = i < onCut.rows();
    const double weight = (isOnCut ? 1.0 : kOthers) / std::max(steepness[i], least);
    const Moments ofPoint = monomials(at(i));
    rows.row(i) = weight * ofPoint.transpose();
    if (isOnCut) wanted[i] = -weight * quadric.dot(ofPoint);
  }
  return quadric + Moments(rows.completeOrthogonalDecomposition().solve(wanted));
}

/// How far most vertices of the cut went at most. What is next to them stayed.
double stepOf(const Contour& contour, const Points& vertices) {
  constexpr double kMost = 0.95;
  std::vector<double> steps;
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    if (contour.on[static_cast<std::size_t>(v)] == On::Cut)
      steps.push_back((vertices.row(v) - contour.mesh.vertices.row(v)).norm());
  }
  if (steps.empty()) return 0.0;
  const auto most =
      steps.begin() + static_cast<std::ptrdiff_t>(kMost * static_cast<double>(steps.size() - 1));
  std::nth_element(steps.begin(), most, steps.end());
  return *most;
}

} // namespace

std::optional<LayeredQuadric> quadricThrough(const LayeredQuadric& quadric, const Contour& contour,
                                             const Points& vertices) {
  constexpr double kNoTransition = 0.0;
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
      left += std::pow(cutAt(result, kNoTransition, vertices.row(v).transpose()).value, 2);
    }
  }
  if (left > kNear * kNear * moved) return {};
  return result;
}

bool MovingQuadric::isAsMeant(const Contour& contour) {
  constexpr double kAbout = 0.05; // of the volume
  if (!last_) return true;
  const double volume = moments(contour.mesh.vertices, contour.mesh.faces)[0];
  const bool isIt = std::abs(volume - last_->volume) <= kAbout * last_->volume;
  if (!isIt) takeBack();
  last_.reset();
  return isIt;
}

bool MovingQuadric::follow(const Contour& contour, const Points& vertices, double edge) {
  constexpr double kFar = 0.25; // edges
  if (isAtRest() || stepOf(contour, vertices) <= kFar * edge) return false;
  std::optional<LayeredQuadric> moved = quadricThrough(quadric_, contour, vertices);
  if (!moved) return false;
  const double volume = moments(vertices, contour.mesh.faces)[0];
  last_ = Move{std::exchange(quadric_, *std::move(moved)), volume};
  ++moves_;
  hasMoved_ = true;
  return true;
}

void MovingQuadric::takeBack() {
  if (!last_) return;
  quadric_ = std::move(last_->before);
  last_.reset();
  moves_ = kMoves;
  hasMoved_ = true;
}

} // namespace massprops
