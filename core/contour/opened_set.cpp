#include "core/contour/opened_set.h"

#include "core/base/parallel.h"
#include "core/base/triangle.h"
#include "core/contour/dual_contour.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace massprops {
namespace {

/// More than the wanted wall: what rounding takes.
constexpr double kMargin = 1e-5;
/// How far from the middle of such a ball the cavity goes, in its radii: a cube's corner, too, is
/// reached.
constexpr double kReach = 1.8;

constexpr double kAll = std::numeric_limits<double>::infinity();

/// Takes off what lies on the negative side of something.
class PartsCut {
public:
  /// `left`: about the signed distance of a cube's middle, as far as it is less than half the
  /// cube's diagonal, which is given; empty where that is on the negative side.
  using Left = std::function<std::optional<Sample>(const RegionPart&, double half)>;

  PartsCut(const RegionParts& all, Left left) : all_(all), left_(std::move(left)) {}

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
    const std::optional<Sample> left = left_(part, half);
    if (!left || left->value <= -half) return;
    if (part.level == 0 ? left->value >= part.depth - all_.wall : left->value >= half) {
      parts_.push_back(part);
    } else if (part.level == 0) {
      RegionPart cut = part;
      cut.depth = all_.wall + left->value;
      cut.inwards = left->slope;
      parts_.push_back(cut);
    } else {
      split(part, 0.25 * size);
    }
  }

  /// A cube of cells becomes smaller ones, a cell its parts.
  void split(const RegionPart& part, double step) {
    for (int i = 0; i < 8; ++i) {
      RegionPart smaller = part;
      smaller.centre += step * Vec3((i & 1) != 0 ? 1.0 : -1.0, (i & 2) != 0 ? 1.0 : -1.0,
                                    (i & 4) != 0 ? 1.0 : -1.0);
      smaller.level = part.level - 1;
      // Nothing else cuts it.
      smaller.depth = std::max(part.depth - std::sqrt(3.0) * step, all_.wall + 2.0 * step);
      smaller.cell = part.level == 1 ? cells_ : part.cell;
      add(smaller);
    }
    if (part.level == 1) --cells_;
  }

  const RegionParts& all_;
  Left left_;
  std::vector<RegionPart> parts_;
  int cells_ = 0; ///< the next of the numbers of cells that were whole
};

/// How far parts are within the reach of the deep part.
class WithinReach {
public:
  explicit WithinReach(const DeepPart& deep) : deep_(deep), inside_(deep.border) {}

  std::optional<Sample> operator()(const RegionPart& part, double half) {
    if (part.level > 0 ? part.depth >= deep_.depth + half : part.depth >= deep_.depth)
      return Sample{kAll, Vec3::UnitX()};
    const double farthest = deep_.reach + half;
    near_ = deep_.border.nearest(part.centre, farthest * farthest, near_.face);
    const bool isInside =
        near_.face >= 0 ? inside_.contains(part.centre, near_) : inside_.contains(part.centre);
    if (near_.face < 0)
      return isInside ? std::optional<Sample>({kAll, Vec3::UnitX()}) : std::nullopt;
    const double away = (isInside ? -1.0 : 1.0) * std::sqrt(near_.squaredDistance);
    return Sample{deep_.reach - away,
                  (away < 0.0 ? -1.0 : 1.0) * (near_.point - part.centre).normalized()};
  }

private:
  const DeepPart& deep_;
  PointInMesh inside_;
  TriangleTree::Hit near_;
};

/// `makeLeft`: for each run of parts anew, for it may remember the last one.
RegionParts cut(const RegionParts& all, const std::function<PartsCut::Left()>& makeLeft) {
  RegionParts result{all.edge, all.wall, {}};
  constexpr Eigen::Index kRun = 512;
  const auto count = static_cast<Eigen::Index>(all.parts.size());
  std::vector<std::vector<RegionPart>> chunks(static_cast<std::size_t>((count + kRun - 1) / kRun));
  forChunks(count, kRun, [&](const Chunk& chunk) {
    PartsCut parts(all, makeLeft());
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

} // namespace

double edgeOfCubes(double area, double count) {
  return std::sqrt(kCubesPerArea * area / count);
}

OpenedSet openedSet(const TriangleTree& surface, double wall, double edge) {
  return openedSet(surface, wall, wall, edge);
}

OpenedSet openedSet(const TriangleTree& surface, double wall, double width, double edge) {
  OpenedSet set{surface, (1.0 + kMargin) * wall, width, edge, {}};
  const double narrow = 0.5 * width;
  constexpr double kCoarser = 1.4; // nobody sees it
  const double deepEdge = kCoarser * edge;
  auto border = std::make_unique<const TriangleMesh>(
      dualContour(borderLattice({surface, set.wall + narrow}, deepEdge)).mesh);
  if (border->faces.rows() == 0) return set;
  TriangleTree tree(border->vertices, border->faces);
  set.deep = std::make_shared<const DeepPart>(
      DeepPart{std::move(border), std::move(tree), set.wall + narrow + deepEdge, kReach * narrow});
  return set;
}

RegionParts partsWithin(const OpenedSet& set, const RegionParts& all) {
  if (!set.deep) return {all.edge, all.wall, {}};
  RegionParts result = cut(all, [&] { return WithinReach(*set.deep); });
  if (!set.fill) return result;
  return cut(result, [&] {
    return [&](const RegionPart& part, double) { return set.fill->at(part.centre); };
  });
}

} // namespace massprops
