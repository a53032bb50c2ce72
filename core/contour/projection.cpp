#include "core/contour/projection.h"

#include "core/base/parallel.h"
#include "core/contour/shape_guard.h"

#include <algorithm>
#include <cmath>

namespace massprops {
namespace {

constexpr int kSteps = 4;
/// Of how far a point may go: near enough.
constexpr double kNear = 1e-5;

/// The least way to where both linear functions vanish; the first alone where they are as good as
/// parallel.
Vec3 wayToBoth(const Sample& a, const Sample& b) {
  const double c = a.slope.dot(b.slope);
  const double squaredSine = 1.0 - c * c;
  constexpr double kParallel = 0.01;
  if (squaredSine < kParallel) return -a.value * a.slope;
  const double u = (-a.value + c * b.value) / squaredSine;
  const double v = (-b.value + c * a.value) / squaredSine;
  return u * a.slope + v * b.slope;
}

class Projection {
public:
  Projection(const Region& region, double farthest)
      : region_(region), probe_(region), farthest_(farthest) {}

  Vec3 onto(const Vec3& x, On& on) {
    Vec3 y = x;
    if (on == On::Chamfer) return y;
    for (int step = 0; step < kSteps; ++step) {
      Vec3 way = Vec3::Zero();
      // Of the cut it matters only on which side of the walls' border it is.
      constexpr double kNearby = 0.1;
      const bool needsInset = on != On::Cut || step == 0;
      const Sample inset =
          needsInset ? probe_.at(y, (on == On::Cut ? kNearby : 2.0) * farthest_) : Sample{};
      if (on == On::Cut && step == 0 && inset.value < 0.0) on = On::Crease;
      if (on == On::Inset) way = -inset.value * inset.slope;
      if (on == On::Cut || on == On::Crease) {
        const Sample cut = cutAt(region_, y);
        way = on == On::Cut ? Vec3(-cut.value * cut.slope) : wayToBoth(inset, cut);
      }
      y += way;
      const bool isThere = on == On::Inset && inset.value > 0.0 && probe_.isOfSurface();
      if (isThere || way.norm() < kNear * farthest_) break;
    }
    const Vec3 moved = y - x;
    const double length = moved.norm();
    return length > farthest_ ? Vec3(x + farthest_ / length * moved) : y;
  }

private:
  const Region& region_;
  InsetProbe probe_;
  double farthest_;
};

} // namespace

void project(const Region& region, double farthest, Contour& contour) {
  constexpr Eigen::Index kRun = 512;
  Points targets = contour.mesh.vertices;
  forChunks(targets.rows(), kRun, [&](const Chunk& chunk) {
    Projection projection(region, farthest);
    for (Eigen::Index v = chunk.begin; v < chunk.end; ++v) {
      const Vec3 x = targets.row(v).transpose();
      targets.row(v) = projection.onto(x, contour.on[static_cast<std::size_t>(v)]).transpose();
    }
  });
  Points& vertices = contour.mesh.vertices;
  moveSoundly(targets, contour.mesh.faces, vertices);
  constexpr double kThere = 1e-3;
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    On& on = contour.on[static_cast<std::size_t>(v)];
    const double left = (targets.row(v) - vertices.row(v)).norm();
    if (on == On::Crease && left > kThere * farthest) on = On::Chamfer;
  }
}

} // namespace massprops
