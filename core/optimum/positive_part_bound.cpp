#include "core/optimum/positive_part_bound.h"

#include "core/base/cube_cut.h"
#include "core/base/parallel.h"
#include "core/query/point_in_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace massprops {
namespace {

/// Of the cubes whose distance is asked for, each about a microsecond.
constexpr std::size_t kMostCubes = 1500000;
constexpr int kFirstAlongASide = 16;

struct Cube {
  Vec3 centre;
  double edge;
  double upper = 0.0; ///< of its contribution
  double slack = 0.0; ///< by how much that may be too large; 0: nothing to be gained by dividing
};

/// A quadric over a box. What is linear in each coordinate lies below its values at the corners,
/// interpolated; −x² lies above them by a quarter of the squared edge at most.
struct Bounds {
  double meanOfPositive = 0.0; ///< at least the mean of max(0, q)
  double greatest = 0.0;       ///< at least max(0, q)
  double slack = 0.0;          ///< of the mean
};

Bounds boundsOver(const Moments& quadric, const Vec3& centre, const Vec3& size) {
  const Vec3 curvature = quadric.segment<3>(4).cwiseProduct(size.cwiseAbs2());
  const double over = 0.25 * (-curvature).cwiseMax(0.0).sum();
  const double under = 0.25 * curvature.cwiseMax(0.0).sum();
  double sum = 0.0;
  double least = std::numeric_limits<double>::infinity();
  double greatest = -least;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 step((corner & 1) != 0 ? 0.5 : -0.5, (corner & 2) != 0 ? 0.5 : -0.5,
                    (corner & 4) != 0 ? 0.5 : -0.5);
    const double value = quadric.dot(monomials(centre + size.cwiseProduct(step)));
    sum += std::max(0.0, value + over);
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
  if (greatest + over <= 0.0) return {};
  if (least - under >= 0.0) {
    // Positive throughout: the mean is that of the quadric itself.
    const double mean = quadric.dot(monomials(centre)) + curvature.sum() / 12.0;
    return {mean, greatest + over, 0.0};
  }
  const double mean = sum / 8.0;
  return {mean, greatest + over, std::min(mean, 0.25 * (greatest - least) + over + under)};
}

/// Those of the parts of the cube in its layers.
Bounds boundsOver(const LayeredQuadric& q, const Cube& cube) {
  const double bottom = cube.centre.z() - 0.5 * cube.edge;
  const double top = cube.centre.z() + 0.5 * cube.edge;
  const std::size_t first = q.layerAt(bottom);
  const std::size_t last = q.layerAt(top);
  if (first == last) {
    return boundsOver(q.quadrics[first], cube.centre, Vec3::Constant(cube.edge));
  }
  Bounds all;
  for (std::size_t layer = first; layer <= last; ++layer) {
    const double low = layer > first ? q.heights[layer - 1] : bottom;
    const double high = layer < last ? q.heights[layer] : top;
    const Bounds part =
        boundsOver(q.quadrics[layer], {cube.centre.x(), cube.centre.y(), 0.5 * (low + high)},
                   {cube.edge, cube.edge, high - low});
    const double share = (high - low) / cube.edge;
    all.meanOfPositive += share * part.meanOfPositive;
    all.slack += share * part.slack;
    all.greatest = std::max(all.greatest, part.greatest);
  }
  return all;
}

class UpperBound {
public:
  UpperBound(const LayeredQuadric& quadric, const TriangleTree& surface, double wall)
      : quadric_(quadric), surface_(surface), inside_(surface), wall_(wall) {}

  /// Rounds of division, each of the cubes with the most to gain.
  double refine(double enough) {
    std::vector<Cube> cubes = first();
    std::size_t asked = 0;
    double decided = 0.0;
    while (true) {
      evaluate(cubes);
      asked += cubes.size();
      double open = 0.0;
      for (const Cube& cube : cubes) (cube.slack > 0.0 ? open : decided) += cube.upper;
      open += waitingSum();
      const double total = (decided + open) * (1.0 + kOutwards);
      if (total <= enough || asked > kMostCubes) return total;
      for (const Cube& cube : cubes) {
        if (cube.slack > 0.0) waiting_.push_back(cube);
      }
      if (waiting_.empty()) return total;
      cubes = mostPromising();
    }
  }

private:
  std::vector<Cube> first() const {
    const Vec3 low = surface_.vertices().colwise().minCoeff();
    const Vec3 high = surface_.vertices().colwise().maxCoeff();
    const double edge = (high - low).maxCoeff() / kFirstAlongASide;
    const Eigen::Array3i counts = ((high - low) / edge).array().ceil().max(1.0).cast<int>();
    std::vector<Cube> cubes;
    for (int i = 0; i < counts.x(); ++i) {
      for (int j = 0; j < counts.y(); ++j) {
        for (int k = 0; k < counts.z(); ++k) {
          cubes.push_back({low + edge * (Vec3(i, j, k) + Vec3::Constant(0.5)), edge});
        }
      }
    }
    return cubes;
  }

  double waitingSum() const {
    double sum = 0.0;
    for (const Cube& cube : waiting_) sum += cube.upper;
    return sum;
  }

  /// The parts of the cubes that hold most of the slack.
  std::vector<Cube> mostPromising() {
    constexpr double kMost = 0.9;
    std::sort(waiting_.begin(), waiting_.end(),
              [](const Cube& a, const Cube& b) { return a.slack < b.slack; });
    double slack = 0.0;
    for (const Cube& cube : waiting_) slack += cube.slack;
    std::vector<Cube> parts;
    double taken = 0.0;
    while (!waiting_.empty() && taken < kMost * slack) {
      const Cube cube = waiting_.back();
      waiting_.pop_back();
      taken += cube.slack;
      for (int corner = 0; corner < 8; ++corner) {
        const Vec3 step((corner & 1) != 0 ? 0.25 : -0.25, (corner & 2) != 0 ? 0.25 : -0.25,
                        (corner & 4) != 0 ? 0.25 : -0.25);
        parts.push_back({cube.centre + cube.edge * step, 0.5 * cube.edge});
      }
    }
    return parts;
  }

  void evaluate(std::vector<Cube>& cubes) const {
    constexpr Eigen::Index kChunk = 256;
    forChunks(static_cast<Eigen::Index>(cubes.size()), kChunk, [&](const Chunk& chunk) {
      for (Eigen::Index i = chunk.begin; i < chunk.end; ++i) {
        evaluate(cubes[static_cast<std::size_t>(i)]);
      }
    });
  }

  void evaluate(Cube& cube) const {
    const Bounds q = boundsOver(quadric_, cube);
    if (q.greatest <= 0.0) return;
    const double half = 0.5 * std::sqrt(3.0) * cube.edge;
    const double volume = cube.edge * cube.edge * cube.edge;
    const double wall = wall_ * (1.0 - kOutwards);
    const TriangleTree::Hit hit = surface_.nearest(cube.centre);
    const double distance = std::sqrt(hit.squaredDistance);
    if (distance * (1.0 + kOutwards) + half <= wall) return;
    if (distance * (1.0 - kOutwards) > half && !inside_.contains(cube.centre)) return;
    cube.upper = q.meanOfPositive * volume;
    cube.slack = q.slack * volume;
    if (distance * (1.0 - kOutwards) >= wall + half) return;
    // Nothing within a wall of the nearest point is hollow: as seen from the cube, at least what
    // is nearer than the plane in which the ball around that point leaves the cube's own ball.
    const double depth = wall > half ? std::sqrt(wall * wall - half * half) : -half;
    double share = 1.0;
    if (distance > half - depth && distance > 0.0) {
      const Vec3 away = (cube.centre - hit.point) / distance;
      // The cut turns planes off the cube's axes: by no more than this at its corners.
      constexpr double kTurned = 0.5 * 3.0 * 0.01;
      const double turned =
          std::min(kTurned, 0.5 * (Vec3::Constant(0.01) - away.cwiseAbs()).cwiseMax(0.0).sum());
      share = cubeCut(away, (depth - distance) / cube.edge - turned - kOutwards).volume;
    }
    const double upper = std::min(cube.upper, q.greatest * volume * (share + kOutwards));
    cube.slack = share > 0.0 ? upper : 0.0;
    cube.upper = upper;
  }

  const LayeredQuadric& quadric_;
  const TriangleTree& surface_;
  PointInMesh inside_;
  double wall_;
  std::vector<Cube> waiting_; ///< that more divisions would tell more about
};

} // namespace

double positivePartBound(const LayeredQuadric& q, const TriangleTree& surface, double wall,
                         double enough) {
  return UpperBound(q, surface, wall).refine(enough);
}

} // namespace massprops
