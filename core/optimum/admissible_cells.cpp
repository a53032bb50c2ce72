#include "core/optimum/admissible_cells.h"

#include "core/base/cube_cut.h"
#include "core/base/parallel.h"
#include "core/physics/moments.h"
#include "core/query/point_in_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <limits>
#include <utility>
#include <vector>

namespace massprops {
namespace {

/// Integrals over a cube of volume `volume` that is centred at p and as wide as `edge`.
Moments cubeMoments(const Vec3& p, double edge, double volume) {
  const double spread = edge * edge / 12.0;
  Moments m;
  m << 1.0, p, p.cwiseAbs2() + Vec3::Constant(spread), p.x() * p.y(), p.y() * p.z(), p.z() * p.x();
  return volume * m;
}

/// Of what is deeper in a part than the wall, and on the positive side of the other border.
Moments partMoments(const RegionParts& region, const RegionPart& part, double edge) {
  const double whole = edge * edge * edge;
  const auto behind = [&](const Vec3& inwards, double depth) {
    const CubeCut cut = cubeCut(inwards, -depth / edge);
    if (cut.volume <= 0.0) return Moments(Moments::Zero());
    return cubeMoments(part.centre + edge * cut.centroid, edge, cut.volume * whole);
  };
  Moments own = behind(part.inwards.cast<double>(), part.depth - region.wall);
  if (part.opposite < 0) return own;
  // Two half-spaces that face each other cover the cube where they meet in it.
  const Sample& other = region.opposites[static_cast<std::size_t>(part.opposite)];
  const Moments both =
      own + behind(other.slope, other.value) - cubeMoments(part.centre, edge, whole);
  return both[0] > 0.0 ? both : Moments(Moments::Zero());
}

constexpr int kNone = -1;

/// From the middle of a cube of edge 1 to those of its eighths.
Vec3 stepTo(int corner) {
  return {(corner & 1) != 0 ? 0.25 : -0.25, (corner & 2) != 0 ? 0.25 : -0.25,
          (corner & 4) != 0 ? 0.25 : -0.25};
}

/// An octree that is fine where the border of the region may be, and finest where that is no plane.
/// Levels count upwards from the parts of border cells; 1 are the cells.
class RegionSampler {
public:
  RegionSampler(const TriangleTree& surface, double wall, double edge, double slack,
                AtEdges atEdges)
      : surface_(surface), wall_(wall), edge_(edge), slack_(slack), atEdges_(atEdges) {}

  void add(const Vec3& centre) { visit(centre, kTop, 0, kNone, {}); }

  static constexpr int kTop = 4;
  static double topEdge(double edge) { return edge * (1 << (kTop - 1)); }

  std::deque<RegionPart> parts() && { return std::move(parts_); }

private:
  /// The surface does not come into it, so that all of it is on one side.
  struct Ball {
    Vec3 centre;
    double radius;
    bool isInside;
  };

  /// The largest ball around a point that is part of a known one; of no radius outside of all.
  Ball knownAround(const Vec3& centre) const {
    Ball best{centre, 0.0, false};
    for (const Ball& ball : known_) {
      const double squared = (centre - ball.centre).squaredNorm();
      if (squared >= ball.radius * ball.radius) continue;
      const double radius = ball.radius - std::sqrt(squared);
      if (radius > best.radius) best = {centre, radius, ball.isInside};
    }
    return best;
  }

  /// Down to level `finest` ≤ 0. `near`: a point of the surface, if any is known.
  void visit(const Vec3& centre, int level, int finest, int cell, const TriangleTree::Hit& near) {
    const double size = edge_ * std::ldexp(1.0, level - 1);
    const double half = 0.5 * std::sqrt(3.0) * size;
    if (near.face >= 0 && (centre - near.point).norm() <= wall_ - half) return;
    Ball ball = knownAround(centre);
    const bool isSideKnown = ball.radius > 0.0;
    // So far outside no cube has anything to be hollow, and the middle of a border cell's part no
    // plane that would leave it any.
    const double nothing = level > finest ? half : half - wall_;
    if (isSideKnown && !ball.isInside && ball.radius >= nothing) return;
    // Farther away the surface does not matter.
    constexpr double kAnywhere = std::numeric_limits<double>::infinity();
    const double far = isSideKnown && ball.isInside ? wall_ + half : kAnywhere;
    // Only the very nearest face tells the side.
    const double slack = isSideKnown ? slack_ : 0.0;
    TriangleTree::Hit onSurface;
    onSurface.squaredDistance = far * far;
    if (ball.radius < far)
      onSurface = surface_.nearest(centre, far * far, near.face, kAnywhere, slack);
    const TriangleTree::Hit nearest = surface_.clearance(centre, onSurface);
    if (!(nearest.squaredDistance < far * far)) {
      known_.push_back({centre, far, true});
      add({centre, far, Eigen::Vector3f::UnitX(), level, cell}, nearest);
      return;
    }
    const double distance = std::sqrt(nearest.squaredDistance);
    if (distance <= wall_ - half) return;
    ball.radius = std::max(ball.radius, distance / (1.0 + slack));
    // Asked only where it tells the side of all parts: their middles are half as far as corners.
    if (isSideKnown || ball.radius > 0.5 * half || level == finest) {
      if (!isSideKnown) ball.isInside = PointInMesh(surface_).contains(centre, onSurface);
      known_.push_back(ball);
      if (!ball.isInside && ball.radius >= nothing) return;
    }
    if (level == finest || (ball.isInside && ball.radius >= wall_ + half)) {
      const Vec3 away = (centre - nearest.point) / std::max(distance, 1e-300);
      const Vec3 inwards = (ball.isInside ? 1.0 : -1.0) * away;
      const double depth = ball.isInside ? distance : -ball.radius;
      add({centre, depth, inwards.cast<float>(), level, cell}, nearest);
      return;
    }
    if (level == 1) {
      cell = borderCells_++;
      nearest_.clear();
    }
    const std::size_t known = known_.size();
    // The ball around the part that is farthest from the surface spares most of the others.
    const Vec3 away = centre - nearest.point;
    const int farthest =
        (away.x() > 0.0 ? 1 : 0) + (away.y() > 0.0 ? 2 : 0) + (away.z() > 0.0 ? 4 : 0);
    for (int i = 0; i < 8; ++i) {
      const int corner = i ^ farthest;
      visit(centre + size * stepTo(corner), level - 1, finest, cell, nearest);
    }
    if (level == 1 && atEdges_ == AtEdges::Finer && !hasFlatBorder()) divideLastCell();
    known_.resize(known);
  }

  void add(const RegionPart& part, const TriangleTree::Hit& nearest) {
    parts_.push_back(part);
    if (part.level == 0) nearest_.push_back(nearest);
  }

  /// Whether the border may be in a part of a cell.
  bool mayHaveBorder(const RegionPart& part) const {
    return std::abs(part.depth - wall_) < 0.25 * std::sqrt(3.0) * edge_;
  }

  /// Whether the parts of the last cell at the border see the surface in about the same direction:
  /// they do not where its faces meet at an edge, or from both sides of a thin room.
  bool hasFlatBorder() const {
    constexpr double kSame = 0.95; // cosine
    const auto first = parts_.end() - static_cast<std::ptrdiff_t>(nearest_.size());
    Vec3 sum = Vec3::Zero();
    for (auto part = first; part != parts_.end(); ++part)
      if (mayHaveBorder(*part)) sum += part->inwards.cast<double>();
    const Vec3 mean = sum.normalized();
    return std::all_of(first, parts_.end(), [&](const RegionPart& part) {
      return !mayHaveBorder(part) || part.inwards.cast<double>().dot(mean) >= kSame;
    });
  }

  /// Once more, where its border may be.
  void divideLastCell() {
    const std::vector<TriangleTree::Hit> nearest = std::move(nearest_);
    const auto first = parts_.end() - static_cast<std::ptrdiff_t>(nearest.size());
    const std::vector<RegionPart> parts(first, parts_.end());
    parts_.erase(first, parts_.end());
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (!mayHaveBorder(parts[i])) {
        parts_.push_back(parts[i]);
        continue;
      }
      for (int corner = 0; corner < 8; ++corner) {
        const Vec3 middle = parts[i].centre + 0.5 * edge_ * stepTo(corner);
        visit(middle, -1, -1, parts[i].cell, nearest[i]);
      }
    }
  }

  const TriangleTree& surface_;
  double wall_;
  double edge_;
  double slack_;
  AtEdges atEdges_;
  std::deque<RegionPart> parts_;
  std::vector<TriangleTree::Hit> nearest_; ///< to the parts of the last cell at the border
  std::vector<Ball> known_; ///< around the cubes that the present one is part of, and their parts
  int borderCells_ = 0;
};

double cellEdge(const Vec3& extent, int cells) {
  // Sheets of almost no thickness would need cells without number.
  constexpr double kMostAlongASide = 400.0;
  return std::max(std::cbrt(extent.prod() / cells), extent.maxCoeff() / kMostAlongASide);
}

} // namespace

RegionParts admissibleParts(const TriangleTree& surface, double wall, int cells, double slack,
                            AtEdges atEdges) {
  const Vec3 low = surface.vertices().colwise().minCoeff();
  const Vec3 high = surface.vertices().colwise().maxCoeff();
  const Vec3 extent = high - low;
  if (2.0 * wall >= extent.minCoeff()) return {};
  const double edge = cellEdge(extent, cells);
  const double step = RegionSampler::topEdge(edge);
  const Eigen::Array<Eigen::Index, 3, 1> counts =
      ((high - low) / step).array().ceil().max(1.0).cast<Eigen::Index>();
  std::vector<std::deque<RegionPart>> chunks(static_cast<std::size_t>(counts.prod()));
  forChunks(counts.prod(), 1, [&](const Chunk& chunk) {
    const Eigen::Index column = chunk.number / counts.z();
    const Eigen::Array<Eigen::Index, 3, 1> place(column / counts.y(), column % counts.y(),
                                                 chunk.number % counts.z());
    RegionSampler sampler(surface, wall, edge, slack, atEdges);
    sampler.add(low + step * (place.cast<double>() + 0.5).matrix());
    chunks[static_cast<std::size_t>(chunk.number)] = std::move(sampler).parts();
  });
  RegionParts all{edge, wall, {}};
  int known = 0;
  for (std::deque<RegionPart>& chunk : chunks) {
    int most = kNone;
    for (RegionPart& part : chunk) {
      most = std::max(most, part.cell);
      if (part.level <= 0) part.cell += known;
      all.parts.push_back(part);
    }
    known += most + 1;
    std::deque<RegionPart>().swap(chunk);
  }
  return all;
}

RegionParts resolvedParts(const TriangleTree& surface, double wall) {
  constexpr int kRounds = 3; // what coarse cells say of the width is not exact
  constexpr double kAcross = 3.0;
  constexpr double kMost = 20000.0;       // at the border
  constexpr double kMostParts = 300000.0; // 17 MB
  constexpr double kNearEnough = 0.8;
  const Vec3 extent =
      (surface.vertices().colwise().maxCoeff() - surface.vertices().colwise().minCoeff())
          .transpose();
  RegionParts parts = admissibleParts(surface, wall);
  for (int round = 0; round < kRounds && !parts.parts.empty(); ++round) {
    const double area = borderArea(parts);
    if (area <= 0.0) break;
    const double width = 2.0 * cellsOf(parts).col(0).sum() / area;
    const auto count = static_cast<double>(parts.parts.size());
    const double edge = std::max({width / kAcross, std::sqrt(kCubesPerArea * area / kMost),
                                  parts.edge * std::sqrt(count / kMostParts)});
    if (edge > kNearEnough * parts.edge) break;
    const double cells = extent.prod() / std::pow(edge, 3);
    parts = admissibleParts(surface, wall, static_cast<int>(std::min(cells, 1e9)));
  }
  return parts;
}

AdmissibleCells cellsOf(const RegionParts& region) {
  const double cellEdge = region.edge;
  std::vector<Moments> result;
  int cell = kNone;
  for (const RegionPart& part : region.parts) {
    const double edge = cellEdge * std::ldexp(1.0, part.level - 1);
    if (part.level > 0) {
      const int n = 1 << (part.level - 1);
      const Vec3 first = part.centre - Vec3::Constant(0.5 * (edge - cellEdge));
      for (int j = 0; j < n * n * n; ++j) {
        const int layer = j / n;
        const Eigen::Vector3i place(j % n, layer % n, layer / n);
        result.emplace_back(
            cubeMoments(first + cellEdge * place.cast<double>(), cellEdge, std::pow(cellEdge, 3)));
      }
      continue;
    }
    const Moments left = partMoments(region, part, edge);
    if (left[0] <= 0.0) continue;
    if (part.cell != cell) result.emplace_back(Moments::Zero());
    cell = part.cell;
    result.back() += left;
  }
  AdmissibleCells rows(static_cast<Eigen::Index>(result.size()), 10);
  for (std::size_t i = 0; i < result.size(); ++i) {
    rows.row(static_cast<Eigen::Index>(i)) = result[i].transpose();
  }
  return rows;
}

double borderArea(const RegionParts& region) {
  int cells = 0;
  int last = kNone;
  for (const RegionPart& part : region.parts) {
    const bool isHollow = part.depth + 0.25 * std::ldexp(region.edge, part.level) > region.wall;
    if (part.level > 0 || part.cell == last || !isHollow) continue;
    last = part.cell;
    ++cells;
  }
  return cells * region.edge * region.edge / kCubesPerArea;
}

AdmissibleCells admissibleCells(const TriangleTree& surface, double wall, int cells) {
  return cellsOf(admissibleParts(surface, wall, cells));
}

std::vector<double> layerHeights(const TriangleTree& surface, double edge) {
  constexpr double kMost = 100.0;
  const double low = surface.vertices().col(2).minCoeff();
  const double high = surface.vertices().col(2).maxCoeff();
  const double step = edge * std::ceil((high - low) / (kMost * edge));
  std::vector<double> heights;
  for (int i = 1; low + i * step < high; ++i) heights.push_back(low + i * step);
  return heights;
}

} // namespace massprops
