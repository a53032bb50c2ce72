#include "core/reduced/closing_in.h"

#include "core/base/tolerances.h"
#include "core/base/triangle.h"
#include "core/mesh/lipschitz.h"
#include "core/query/triangle_tree.h"

#include <algorithm>
#include <cmath>

namespace massprops {
namespace {

/// Correcting a missing wall by a little more needs fewer rounds; by twice as much each time that
/// the same vertex fails, for its offset may lead along the surface.
constexpr double kOverstep = 1.1;
/// Of a step along an offset that leads to the side: no more than 1/0.6 times what is missing.
constexpr double kLeastGain = 0.6;
/// An offset beyond this share of its range is as good as the greatest; where the cavity is
/// narrower than so many walls there, it is a thread that the goal does without.
constexpr double kUnwanted = 0.75;
constexpr double kUnwantedWidth = 3.0;
/// Filling less than this share of the cavity's vertices is not worth another round.
constexpr double kWorthTrimming = 0.01;

/// Of what the cavity keeps the wall from, to one of its vertices that is too near.
Vec3 nearestPoint(const CavityTask& task, const CavityResult& result, int v) {
  const Vec3 y = result.inner.row(v).transpose();
  const int face = result.inspection.nearestFace[static_cast<std::size_t>(v)];
  const auto corners = task.surface.faces().row(face);
  const Vec3 a = result.outer.row(corners[0]).transpose();
  const Vec3 b = result.outer.row(corners[1]).transpose();
  const Vec3 c = result.outer.row(corners[2]).transpose();
  const Vec3 weights = nearestWeights(y, a, b, c);
  const Vec3 onFace = weights[0] * a + weights[1] * b + weights[2] * c;
  return task.surface.clearance(y, {(y - onFace).squaredNorm(), face, onFace}).point;
}

/// Goes deeper by what is missing of the wall, or less deep where that leads nearer.
void correctWall(const CavityTask& task, const CavityResult& result, int v, SearchLimits& limits) {
  OffsetBounds& bounds = limits.inner;
  const Vec3 y = result.inner.row(v).transpose();
  const Vec3 away = (y - nearestPoint(task, result, v)).normalized();
  const double missing = kBeyondWall * task.wall - result.inspection.wall[v];
  const double gain = -away.dot(task.model.field.directions.row(v).transpose());
  const double step = std::ldexp(kOverstep * missing / std::max(std::abs(gain), kLeastGain),
                                 limits.thinRounds[static_cast<std::size_t>(v)]++);
  if (gain > 0.0) {
    bounds.lower[v] = std::max(bounds.lower[v], result.innerOffsets[v] + step);
  } else {
    bounds.upper[v] = std::min(bounds.upper[v], result.innerOffsets[v] - step);
  }
}

} // namespace

void closeIn(const CavityTask& task, const CavityResult& result, const VertexAdjacency& neighbours,
             bool isPatient, SearchLimits& limits) {
  const Points& vertices = task.model.surface->vertices;
  const Inspection& found = result.inspection;
  std::vector<char>& solid = limits.solid;
  const auto fill = [&](int v) {
    solid[static_cast<std::size_t>(v)] = 1;
    for (const int w : neighbours[static_cast<std::size_t>(v)])
      solid[static_cast<std::size_t>(w)] = 1;
  };
  OffsetBounds& inner = limits.inner;
  for (const int v : found.crossing) {
    solid[static_cast<std::size_t>(v)] = 1;
    if (!isPatient) fill(v);
  }
  for (const int v : found.thin) {
    if (!isPatient) fill(v);
    correctWall(task, result, v, limits);
  }
  inner.lower = lipschitzAbove(vertices, neighbours, inner.lower);
  inner.upper = lipschitzBelow(vertices, neighbours, inner.upper);
  if (!limits.outer) return;
  OffsetBounds& outer = *limits.outer;
  for (const int v : found.outerCrossing) {
    outer.upper[v] = std::min(outer.upper[v], isPatient ? 0.5 * result.outerOffsets[v] : 0.0);
  }
  outer.upper = lipschitzBelow(vertices, neighbours, outer.upper);
  outer.lower = outer.lower.cwiseMin(outer.upper);
}

bool fillNarrowParts(const CavityTask& task, const OffsetSurfaces& surfaces,
                     const OffsetBounds& bounds, const Faces& faces, std::vector<char>& solid) {
  if (faces.rows() == 0) return false;
  const Points& inner = surfaces.inner;
  const TriangleTree tree(inner, faces, TriangleTree::Order::Any,
                          TriangleTree::Queries::NoDistances);
  Eigen::Index filled = 0;
  for (Eigen::Index v = 0; v < inner.rows(); ++v) {
    char& mark = solid[static_cast<std::size_t>(v)];
    if (mark != 0) continue;
    const double share =
        (surfaces.innerOffsets[v] - bounds.lower[v]) / (bounds.upper[v] - bounds.lower[v]);
    const double width = (share > kUnwanted ? kUnwantedWidth : 1.0) * task.wall;
    const Vec3 inwards = -task.model.field.directions.row(v).transpose();
    if (tree.firstHit(inner.row(v).transpose(), inwards, width) >= width) continue;
    mark = 1;
    ++filled;
  }
  return static_cast<double>(filled) > kWorthTrimming * 0.5 * static_cast<double>(faces.rows());
}

} // namespace massprops
