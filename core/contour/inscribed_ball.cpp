#include "core/contour/inscribed_ball.h"

#include "core/base/parallel.h"
#include "core/base/triangle.h"
#include "core/optimum/feasible_region.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

namespace massprops {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr Eigen::Index kChunk = 250;
constexpr double kNoticeably = 1.02; // larger

struct SurfacePoint {
  Vec3 x;
  Vec3 inwards; ///< unit
  int face;
};

/// As many for any part of the surface as its area asks for, those of a chunk next to each other.
std::vector<SurfacePoint> samplesOf(const TriangleTree& surface, double apart) {
  constexpr double kFewest = 20000.0;
  constexpr double kMost = 200000.0;
  const Points& vertices = surface.vertices();
  const double area = surfaceArea(vertices, surface.faces());
  const double count = std::clamp(area / (apart * apart), kFewest, kMost);
  const double step = area / count;
  std::vector<SurfacePoint> samples;
  samples.reserve(static_cast<std::size_t>(count) + 1);
  double next = 0.5 * step; // area from the end of the last triangle on
  for (Eigen::Index i = 0; i < surface.faces().rows(); ++i) {
    const int face = surface.faceAt(i);
    const auto corner = [&](int k) -> Vec3 {
      return vertices.row(surface.faces()(face, k)).transpose();
    };
    const Vec3 a = corner(0);
    const Vec3 ab = corner(1) - a;
    const Vec3 ac = corner(2) - a;
    const Vec3 normal = ab.cross(ac);
    const double own = 0.5 * normal.norm();
    while (next < own) {
      constexpr double kGolden = 0.6180339887498949;
      const double along = std::sqrt(next / own);
      const double across = std::fmod(kGolden * static_cast<double>(samples.size()), 1.0);
      samples.push_back(
          {a + along * ((1.0 - across) * ab + across * ac), -normal.normalized(), face});
      next += step;
    }
    next -= own;
  }
  return samples;
}

/// The largest ball that touches the surface there, if it is noticeably larger than `least`.
std::optional<InscribedBall> ballAt(const TriangleTree& surface, const PointInMesh& inside,
                                    const SurfacePoint& sample, double least) {
  constexpr int kMostRounds = 50;
  constexpr double kTouches = 1e-6;
  constexpr double kSlack = 0.01; // in the middle of a round room everything is as near
  constexpr double kOff = 1e-7;   // the face itself
  double radius = 0.5 * surface.firstHit(sample.x + kOff * sample.inwards, sample.inwards);
  if (!std::isfinite(radius)) return {};
  int near = sample.face;
  for (int round = 0; round < kMostRounds && radius > kNoticeably * least; ++round) {
    const Vec3 centre = sample.x + radius * sample.inwards;
    const TriangleTree::Hit hit =
        surface.clearance(centre, surface.nearest(centre, kInfinity, near, kInfinity, kSlack));
    if (hit.squaredDistance >= std::pow((1.0 - kTouches) * radius, 2)) {
      const TriangleTree::Hit onSurface = surface.nearest(centre, kInfinity, hit.face);
      // Where faces of the surface coincide it would be beyond both of them.
      if (!inside.contains(centre, onSurface)) return {};
      radius = std::sqrt(surface.clearance(centre, onSurface).squaredDistance);
      return radius > least ? std::optional(InscribedBall{centre, radius}) : std::nullopt;
    }
    near = hit.face;
    const Vec3 way = hit.point - sample.x;
    radius = 0.5 * way.squaredNorm() / way.dot(sample.inwards);
  }
  return {};
}

/// Climbs to where a ball larger by this factor fits, again and again.
void grow(const TriangleTree& surface, double larger, InscribedBall from, InscribedBall& best) {
  for (;;) {
    RegionProbe probe({surface, 0.0, 0.0});
    const Sample depth = probe.depthAt(from.centre, kInfinity);
    const std::optional<Vec3> place =
        probe.placeNear(from.centre, depth, larger * best.radius, from.radius);
    if (!place) return;
    best = {*place, probe.depthAt(*place, kInfinity).value};
    from = best;
  }
}

} // namespace

InscribedBall largestInscribedBall(const TriangleTree& surface, double apart) {
  constexpr double kAbout = 0.7;
  constexpr double kSlightlyLarger = 1.001;
  const PointInMesh inside(surface);
  const std::vector<SurfacePoint> samples = samplesOf(surface, apart);
  const auto count = static_cast<Eigen::Index>(samples.size());
  std::vector<InscribedBall> balls(static_cast<std::size_t>(chunkCount(count, kChunk)));
  forChunks(count, kChunk, [&](const Chunk& chunk) {
    InscribedBall& best = balls[static_cast<std::size_t>(chunk.number)];
    for (Eigen::Index i = chunk.begin; i < chunk.end; ++i) {
      const SurfacePoint& sample = samples[static_cast<std::size_t>(i)];
      // Where it nearly touches the best one so far it is hardly larger.
      if ((sample.x - best.centre).norm() < kNoticeably * best.radius) continue;
      if (const auto ball = ballAt(surface, inside, sample, best.radius)) best = *ball;
    }
  });
  std::stable_sort(balls.begin(), balls.end(),
                   [](const auto& a, const auto& b) { return a.radius > b.radius; });
  InscribedBall best = balls.empty() ? InscribedBall() : balls.front();
  const double about = kAbout * best.radius;
  for (const InscribedBall& ball : balls) {
    if (ball.radius > about) grow(surface, kNoticeably, ball, best);
  }
  if (best.radius > 0.0) grow(surface, kSlightlyLarger, best, best);
  return best;
}

} // namespace massprops
