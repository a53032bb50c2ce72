#include "core/reduced/offset_bounds.h"

#include "core/base/parallel.h"
#include "core/base/tolerances.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace massprops {
namespace {

/// Below this clearance (about 87°) an offset would have to be 20 walls long.
constexpr double kLeastClearance = 0.05;
/// Offsets need some room to be worth a cavity: a share of the greatest one.
constexpr double kLeastRoom = 0.02;
/// What a vertex keeps of its height above the ground, lest it widen the contact area.
constexpr double kLeastHeight = 0.5;

} // namespace

OffsetBounds innerBounds(const OffsetField& field, double wall, double factor) {
  return {kBeyondWall * wall * field.clearance.cwiseMax(kLeastClearance).cwiseInverse(),
          factor * field.reach};
}

OffsetBounds innerBoundsOfCopy(const OffsetField& field, double wall, double factor) {
  return {kBeyondWall * wall * field.meanClearance.cwiseMax(kLeastClearance).cwiseInverse(),
          factor * field.reach};
}

OffsetBounds keepingWall(const Points& vertices, const TriangleTree& surface,
                         const OffsetField& field, OffsetBounds bounds, double wall) {
  constexpr int kMostSteps = 20;
  constexpr Eigen::Index kChunk = 1024;
  forChunks(vertices.rows(), kChunk, [&](const Chunk& chunk) {
    int hint = -1;
    for (Eigen::Index v = chunk.begin; v < chunk.end; ++v) {
      double& offset = bounds.lower[v];
      for (int step = 0; step < kMostSteps && offset <= bounds.upper[v]; ++step) {
        // The distance grows by at most the step, so that no step goes too far.
        const Vec3 y = (vertices.row(v) - offset * field.directions.row(v)).transpose();
        const TriangleTree::Hit nearest = surface.nearest(y, wall * wall, hint);
        const double clear = std::sqrt(surface.clearance(y, nearest).squaredDistance);
        if (clear >= wall) break;
        hint = nearest.face;
        offset += kBeyondWall * wall - clear;
      }
    }
  });
  return bounds;
}

std::vector<char> tooThin(const OffsetField& field, const OffsetBounds& bounds) {
  std::vector<char> thin(static_cast<std::size_t>(bounds.lower.size()));
  for (Eigen::Index v = 0; v < bounds.lower.size(); ++v) {
    const bool room = bounds.lower[v] <= (1.0 - kLeastRoom) * bounds.upper[v];
    thin[static_cast<std::size_t>(v)] = field.clearance[v] > kLeastClearance && room ? 0 : 1;
  }
  return thin;
}

OffsetBounds outerBounds(const Points& vertices, const OffsetField& field, double lower,
                         double upper) {
  OffsetBounds bounds;
  bounds.upper = Vector::Constant(vertices.rows(), upper);
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    const double height = vertices(v, 2);
    const double descent = -field.directions(v, 2);
    if (height <= kContactHeight || field.clearance[v] <= kLeastClearance) {
      bounds.upper[v] = 0.0;
    } else if (descent > 0.0) {
      bounds.upper[v] = std::min(upper, kLeastHeight * height / descent);
    }
  }
  bounds.lower = bounds.upper.cwiseMin(lower);
  return bounds;
}

BoundedOffsets boundMap(const OffsetBounds& bounds, const Vector& t) {
  BoundedOffsets result{Vector(t.size()), Vector(t.size())};
  for (Eigen::Index i = 0; i < t.size(); ++i) {
    const double centre = 0.5 * (bounds.upper[i] + bounds.lower[i]);
    const double halfWidth = 0.5 * (bounds.upper[i] - bounds.lower[i]);
    // Solid vertices have no room.
    const double tau = halfWidth > 0.0 ? (t[i] - centre) / halfWidth : 0.0;
    const double root = 1.0 / std::sqrt(1.0 + tau * tau);
    result.offsets[i] = centre + halfWidth * tau * root;
    result.slopes[i] = halfWidth > 0.0 ? root * root * root : 0.0;
  }
  return result;
}

} // namespace massprops
