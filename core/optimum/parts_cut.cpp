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
  PartsCut(const RegionParts& all, SideOfPart left, int finest)
      : all_(all), left_(std::move(left)), finest_(finest) {}

  void add(const RegionPart& part, int number) {
    constexpr int kCells = 1 << 9; // of the largest cube
    cells_ = -2 - kCells * number; // unlike all others, whichever thread calculates them
    add(part);
  }

  std::vector<RegionPart> parts() && { return std::move(parts_); }

private:
  void add(const RegionPart& part) {
    const double size = all_.edge * std::ldexp(1.0, part.level - 1);
    const double half = 0.5 * std::sqrt(3.0) * size;
    const bool isBeyondItsPlane =
        part.level <= 0 && part.depth + halfAlong(part.inwards, part) <= all_.wall;
    if (isBeyondItsPlane) return;
    const std::optional<Sample> left = left_(part, half);
    if (!left || left->value <= -half) return;
    if (leavesAll(*left, part)) {
      parts_.push_back(part);
    } else if (part.level <= finest_) {
      parts_.push_back(part);
      cutOff(*left, parts_.back());
    } else {
      split(part, 0.25 * size);
    }
  }

  /// Half of how wide a part is along a direction.
  double halfAlong(const Vec3& direction, const RegionPart& part) const {
    return 0.5 * all_.edge * std::ldexp(1.0, part.level - 1) * direction.cwiseAbs().sum();
  }

  bool leavesAll(const Sample& left, const RegionPart& part) const {
    if (left.value >= halfAlong(left.slope, part)) return true;
    const bool isAlongOwn = left.slope.dot(part.inwards) >= 0.0;
    return part.level <= 0 && isAlongOwn && left.value >= part.depth - all_.wall;
  }

  /// Of borders on the same side the nearer one counts.
  void cutOff(const Sample& left, RegionPart& part) const {
    if (left.slope.dot(part.inwards) >= 0.0) {
      part.depth = all_.wall + left.value;
      part.inwards = left.slope;
    } else if (!part.opposite || left.value < part.opposite->value) {
      part.opposite = left;
    }
  }

  /// A cube of cells becomes smaller ones, a cell its parts, and these smaller ones.
  void split(const RegionPart& part, double step) {
    for (int i = 0; i < 8; ++i) {
      RegionPart smaller = part;
      const Vec3 way = step * Vec3((i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0,
                                   (i & 4) != 0 ? 1.0 : -1.0);
      smaller.centre += way;
      smaller.level = part.level - 1;
      // Nothing else cuts a cube of cells; a part keeps its plane.
      smaller.depth = part.level > 0
                          ? std::max(part.depth - std::sqrt(3.0) * step, all_.wall + 2.0 * step)
                          : part.depth + part.inwards.dot(way);
      if (smaller.opposite) smaller.opposite->value += smaller.opposite->slope.dot(way);
      smaller.cell = part.level == 1 ? cells_ : part.cell;
      add(smaller);
    }
    if (part.level == 1) --cells_;
  }

  const RegionParts& all_;
  SideOfPart left_;
  int finest_;
  std::vector<RegionPart> parts_;
  int cells_ = 0; ///< the next of the numbers of cells that were whole
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
  std::vector<std::vector<RegionPart>> chunks(static_cast<std::size_t>((count + kRun - 1) / kRun));
  forChunks(count, kRun, [&](const Chunk& chunk) {
    PartsCut parts(all, makeSide(), finest);
    for (Eigen::Index i = chunk.begin; i < chunk.end; ++i) {
      parts.add(all.parts[static_cast<std::size_t>(i)], static_cast<int>(i));
    }
    chunks[static_cast<std::size_t>(chunk.number)] = std::move(parts).parts();
  });
  for (const std::vector<RegionPart>& chunk : chunks) {
    result.parts.insert(result.parts.end(), chunk.begin(), chunk.end());
  }
  return result;
}

RegionParts partsOutside(const TriangleTree& closed, double depth, const RegionParts& all) {
  return partsLeft(all, [&] { return OutsideOf(closed, depth); });
}

} // namespace massprops
