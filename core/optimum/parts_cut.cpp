#include "core/optimum/parts_cut.h"

#include "core/base/parallel.h"
#include "core/query/point_in_mesh.h"

#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace massprops {
namespace {

/// Takes off what lies on the negative side of something.
class PartsCut {
public:
  PartsCut(const RegionParts& all, SideOfPart side, int finest)
      : all_(all), side_(std::move(side)), finest_(finest) {}

  void add(const RegionPart& part, int number) {
    constexpr int kCells = 1 << 9; // of the largest cube
    cells_ = -2 - kCells * number; // unlike all others, whichever thread calculates them
    std::optional<Sample> opposite;
    if (part.opposite >= 0) opposite = all_.opposites[static_cast<std::size_t>(part.opposite)];
    add(part, opposite);
  }

  void addTo(RegionParts& result) const {
    const auto known = static_cast<int>(result.opposites.size());
    for (RegionPart part : left_.parts) {
      if (part.opposite >= 0) part.opposite += known;
      result.parts.push_back(part);
    }
    result.opposites.insert(result.opposites.end(), left_.opposites.begin(), left_.opposites.end());
  }

private:
  void add(const RegionPart& part, const std::optional<Sample>& opposite) {
    const double size = all_.edge * std::ldexp(1.0, part.level - 1);
    const double half = 0.5 * std::sqrt(3.0) * size;
    const bool isBeyondItsPlane =
        part.level <= 0 && part.depth + halfAlong(part.inwards.cast<double>(), part) <= all_.wall;
    if (isBeyondItsPlane) return;
    const std::optional<Sample> side = side_(part, half);
    if (!side || side->value <= -half) return;
    if (leavesAll(*side, part)) {
      keep(part, opposite);
    } else if (part.level <= finest_) {
      keepCut(part, opposite, *side);
    } else {
      split(part, opposite, 0.25 * size);
    }
  }

  void keep(RegionPart part, const std::optional<Sample>& opposite) {
    part.opposite = opposite ? static_cast<int>(left_.opposites.size()) : -1;
    if (opposite) left_.opposites.push_back(*opposite);
    left_.parts.push_back(part);
  }

  /// Of borders on the same side the nearer one counts.
  void keepCut(RegionPart part, const std::optional<Sample>& opposite, const Sample& side) {
    if (side.slope.dot(part.inwards.cast<double>()) >= 0.0) {
      part.depth = all_.wall + side.value;
      part.inwards = side.slope.cast<float>();
      keep(part, opposite);
    } else {
      keep(part, opposite && opposite->value < side.value ? opposite : side);
    }
  }

  /// Half of how wide a part is along a direction.
  double halfAlong(const Vec3& direction, const RegionPart& part) const {
    return 0.5 * all_.edge * std::ldexp(1.0, part.level - 1) * direction.cwiseAbs().sum();
  }

  bool leavesAll(const Sample& side, const RegionPart& part) const {
    if (side.value >= halfAlong(side.slope, part)) return true;
    const bool isAlongOwn = side.slope.dot(part.inwards.cast<double>()) >= 0.0;
    return part.level <= 0 && isAlongOwn && side.value >= part.depth - all_.wall;
  }

  /// A cube of cells becomes smaller ones, a cell its parts, and these smaller ones.
  void split(const RegionPart& part, const std::optional<Sample>& opposite, double step) {
    for (int i = 0; i < 8; ++i) {
      RegionPart smaller = part;
      const Vec3 way = step * Vec3((i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0,
                                   (i & 4) != 0 ? 1.0 : -1.0);
      smaller.centre += way;
      smaller.level = part.level - 1;
      // Nothing else cuts a cube of cells; a part keeps its plane.
      smaller.depth = part.level > 0
                          ? std::max(part.depth - std::sqrt(3.0) * step, all_.wall + 2.0 * step)
                          : part.depth + part.inwards.cast<double>().dot(way);
      std::optional<Sample> moved = opposite;
      if (moved) moved->value += moved->slope.dot(way);
      smaller.cell = part.level == 1 ? cells_ : part.cell;
      add(smaller, moved);
    }
    if (part.level == 1) --cells_;
  }

  const RegionParts& all_;
  SideOfPart side_;
  int finest_;
  RegionParts left_; ///< edge and wall apart
  int cells_ = 0;    ///< the next of the numbers of cells that were whole
};

/// How far parts are from a surface, beyond a depth.
class OutsideOf {
public:
  OutsideOf(const TriangleTree& closed, double depth)
      : closed_(closed), inside_(closed), depth_(depth) {}

  std::optional<Sample> operator()(const RegionPart& part, double half) {
    const Vec3& x = part.centre;
    const double farthest = depth_ + half;
    // What the last part tells of those around it.
    const double moved = (x - last_.centre).norm();
    if (!last_.isInside && last_.radius - moved >= farthest) return farOutside();
    if (near_.face >= 0 && (x - near_.point).norm() + half <= depth_) return std::nullopt;
    near_ = closed_.nearest(x, farthest * farthest, near_.face);
    const bool isNear = near_.face >= 0;
    const double distance = isNear ? std::sqrt(near_.squaredDistance) : farthest;
    if (moved >= last_.radius)
      last_.isInside = isNear ? inside_.contains(x, near_) : inside_.contains(x);
    last_.centre = x;
    last_.radius = distance;
    if (isNear) {
      const double sign = last_.isInside ? -1.0 : 1.0;
      return Sample{sign * distance - depth_, sign * (x - near_.point).normalized()};
    }
    if (last_.isInside) return std::nullopt;
    return farOutside();
  }

private:
  static Sample farOutside() { return {std::numeric_limits<double>::infinity(), Vec3::UnitX()}; }

  const TriangleTree& closed_;
  PointInMesh inside_;
  double depth_;
  TriangleTree::Hit near_;
  /// The surface does not come into it, so that all of it is on one side.
  struct Ball {
    Vec3 centre = Vec3::Zero();
    double radius = 0.0;
    bool isInside = false;
  } last_;
};

} // namespace

RegionParts partsLeft(const RegionParts& all, const std::function<SideOfPart()>& makeSide,
                      int finest) {
  RegionParts result{all.edge, all.wall, {}};
  constexpr Eigen::Index kRun = 512;
  const auto count = static_cast<Eigen::Index>(all.parts.size());
  std::vector<std::optional<PartsCut>> chunks(static_cast<std::size_t>((count + kRun - 1) / kRun));
  forChunks(count, kRun, [&](const Chunk& chunk) {
    PartsCut& parts =
        chunks[static_cast<std::size_t>(chunk.number)].emplace(all, makeSide(), finest);
    for (Eigen::Index i = chunk.begin; i < chunk.end; ++i) {
      parts.add(all.parts[static_cast<std::size_t>(i)], static_cast<int>(i));
    }
  });
  for (std::optional<PartsCut>& chunk : chunks) {
    chunk->addTo(result);
    chunk.reset();
  }
  return result;
}

RegionParts partsOutside(const TriangleTree& closed, double depth, const RegionParts& all) {
  return partsLeft(all, [&] { return OutsideOf(closed, depth); });
}

} // namespace massprops
