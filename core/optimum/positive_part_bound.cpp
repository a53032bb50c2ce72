#include "core/optimum/positive_part_bound.h"

#include "core/base/cube_cut.h"
#include "core/base/parallel.h"
#include "core/base/triangle.h"
#include "core/query/point_in_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace massprops {
namespace {

constexpr int kFirstAlongASide = 16;
/// Of what a cube at the border contributes: dividing it may tell that much, whatever the rest.
constexpr double kLeastSlack = 0.1;

struct Cube {
  Vec3 centre;
  double edge;
  double upper = 0.0;    ///< of its contribution
  double slack = 0.0;    ///< by how much that may be too large; 0: nothing to be gained by dividing
  int nearFace = -1;     ///< one that is near its centre, if any is known
  bool isInside = false; ///< whether it is known that its centre is
  double clearance = 0.0; ///< at most the distance of its centre from the surface
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

double halfDiagonal(const Cube& cube) {
  return 0.5 * std::sqrt(3.0) * cube.edge;
}

/// At least the share of a cube that lies farther along a unit vector from its centre than `depth`.
double shareBeyond(const Vec3& away, double depth, double edge) {
  // The cut turns planes off the cube's axes: by no more than this at its corners.
  constexpr double kTurned = 0.5 * 3.0 * 0.01;
  const double turned =
      std::min(kTurned, 0.5 * (Vec3::Constant(0.01) - away.cwiseAbs()).cwiseMax(0.0).sum());
  return cubeCut(away, depth / edge - turned - kOutwards).volume;
}

class UpperBound {
public:
  UpperBound(const LayeredQuadric& quadric, const TriangleTree& surface, double wall)
      : quadric_(quadric), surface_(surface), inside_(surface), wall_(wall) {}

  /// Rounds of division, each of the cubes with the most to gain.
  double refine(double enough, std::size_t mostCubes) {
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
      if (total <= enough || asked >= mostCubes) return total;
      for (const Cube& cube : cubes) {
        if (cube.slack > 0.0) waiting_.push_back(cube);
      }
      if (waiting_.empty()) return total;
      cubes = mostPromising(mostCubes - asked);
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

  /// The parts of the cubes that hold most of the slack, about `mostParts` of them at most.
  std::vector<Cube> mostPromising(std::size_t mostParts) {
    constexpr double kMost = 0.9;
    std::sort(waiting_.begin(), waiting_.end(),
              [](const Cube& a, const Cube& b) { return a.slack < b.slack; });
    double slack = 0.0;
    for (const Cube& cube : waiting_) slack += cube.slack;
    std::vector<Cube> parts;
    double taken = 0.0;
    while (!waiting_.empty() && taken < kMost * slack && parts.size() < mostParts) {
      const Cube cube = waiting_.back();
      waiting_.pop_back();
      taken += cube.slack;
      for (int corner = 0; corner < 8; ++corner) {
        const Vec3 step((corner & 1) != 0 ? 0.25 : -0.25, (corner & 2) != 0 ? 0.25 : -0.25,
                        (corner & 4) != 0 ? 0.25 : -0.25);
        Cube part{cube.centre + cube.edge * step, 0.5 * cube.edge};
        part.nearFace = cube.nearFace;
        part.isInside = cube.isInside;
        part.clearance = cube.clearance - halfDiagonal(part);
        parts.push_back(part);
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
    const double half = halfDiagonal(cube);
    const double volume = cube.edge * cube.edge * cube.edge;
    const double wall = wall_ * (1.0 - kOutwards);
    cube.upper = q.meanOfPositive * volume;
    cube.slack = q.slack * volume;
    const double far = wall_ + half;
    if (cube.isInside && cube.clearance > far) return;
    const TriangleTree::Hit hit = surface_.nearest(
        cube.centre, cube.isInside ? far * far : std::numeric_limits<double>::infinity(),
        cube.nearFace);
    const double distance = std::sqrt(hit.squaredDistance);
    cube.clearance = distance * (1.0 - kOutwards);
    if (hit.face < 0) return;
    cube.nearFace = hit.face;
    if (!cube.isInside && cube.clearance > half) {
      cube.isInside = inside_.contains(cube.centre, hit);
      if (!cube.isInside) cube.upper = cube.slack = 0.0;
    }
    if (distance * (1.0 + kOutwards) + half <= wall) cube.upper = cube.slack = 0.0;
    if (cube.upper == 0.0 || cube.clearance >= wall + half || distance == 0.0) return;
    const Vec3 away = (cube.centre - hit.point) / distance;
    const double gap = witnessGap(cube, hit, away);
    const double depth = gap < wall ? std::sqrt(wall * wall - gap * gap) : -half;
    if (distance + depth <= half) { // beyond the surface the cube may be hollow again
      cube.slack = cube.upper;
      return;
    }
    // Nothing within a wall of the witnesses is hollow.
    const double share = shareBeyond(away, depth - distance, cube.edge);
    const double wished = cube.upper * shareBeyond(away, wall - distance, cube.edge);
    cube.upper = std::min(cube.upper, q.greatest * volume * (share + kOutwards));
    cube.slack = share > 0.0 ? std::max(cube.upper - wished, kLeastSlack * cube.upper) : 0.0;
  }

  /// How far, across the way from the nearest point to the centre, points of the cube can be from
  /// those of the surface that are known to be there: the nearest point's own triangle, if that is
  /// where the way ends, or else that point alone.
  double witnessGap(const Cube& cube, const TriangleTree::Hit& hit, const Vec3& away) const {
    // The corner that is least off the plane across the way is farthest from its foot.
    const Vec3 n = away.cwiseAbs();
    const double least = 0.5 * cube.edge * std::max(0.0, 2.0 * n.maxCoeff() - n.sum());
    const double half = halfDiagonal(cube);
    const double widest = std::sqrt(half * half - least * least);
    const auto corner = [&](int k) {
      return Vec3(surface_.vertices().row(surface_.faces()(hit.face, k % 3)).transpose());
    };
    const Vec3 normal = areaNormal(corner(0), corner(1), corner(2));
    const double size = (corner(1) - corner(0)).norm() * (corner(2) - corner(0)).norm();
    constexpr double kThin = 1e-5;
    constexpr double kParallel = 1e-10; // less than distances are known to
    if (normal.norm() < kThin * size || normal.cross(away).norm() > kParallel * normal.norm()) {
      return widest;
    }
    // From the foot the triangle reaches this share of the way to the cube's farthest points.
    double reach = 1.0;
    for (int k = 0; k < 3; ++k) {
      const Vec3 across = normal.cross(corner(k + 1) - corner(k)).normalized();
      const double room = across.dot(hit.point - corner(k));
      reach = std::min(reach, room / (0.5 * cube.edge * across.cwiseAbs().sum()));
    }
    return widest * (1.0 - std::max(0.0, reach));
  }

  const LayeredQuadric& quadric_;
  const TriangleTree& surface_;
  PointInMesh inside_;
  double wall_;
  std::vector<Cube> waiting_; ///< that more divisions would tell more about
};

} // namespace

double positivePartBound(const LayeredQuadric& q, const TriangleTree& surface, double wall,
                         double enough, std::size_t mostCubes) {
  return UpperBound(q, surface, wall).refine(enough, mostCubes);
}

} // namespace massprops
