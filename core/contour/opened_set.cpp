#include "core/contour/opened_set.h"

#include "core/base/parallel.h"
#include "core/base/triangle.h"
#include "core/contour/dual_contour.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace massprops {
namespace {

/// More than the wanted wall: what rounding takes.
constexpr double kMargin = 1e-5;
/// How far from the middle of such a ball the cavity goes, in its radii: a cube's corner, too, is
/// reached.
constexpr double kReach = 1.8;

/// Takes off what is farther from the deep part than its reach.
class Opening {
public:
  Opening(const DeepPart& deep, const RegionParts& all)
      : deep_(deep), all_(all), inside_(deep.border) {}

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
    if (part.level > 0 ? part.depth >= deep_.depth + half : part.depth >= deep_.depth) {
      parts_.push_back(part);
      return;
    }
    const double farthest = deep_.reach + half;
    near_ = deep_.border.nearest(part.centre, farthest * farthest, near_.face);
    const bool isInside =
        near_.face >= 0 ? inside_.contains(part.centre, near_) : inside_.contains(part.centre);
    if (near_.face < 0 && !isInside) return;
    const double away = (isInside ? -1.0 : 1.0) * std::sqrt(near_.squaredDistance);
    const double left = deep_.reach - away;
    if (left <= -half) return;
    if (part.level == 0 ? left >= part.depth - all_.wall : left >= half) {
      parts_.push_back(part);
    } else if (part.level == 0) {
      RegionPart cut = part;
      cut.depth = all_.wall + left;
      cut.inwards = (away < 0.0 ? -1.0 : 1.0) * (near_.point - part.centre).normalized();
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
      // Only the opening cuts it.
      smaller.depth = std::max(part.depth - std::sqrt(3.0) * step, all_.wall + 2.0 * step);
      smaller.cell = part.level == 1 ? cells_ : part.cell;
      add(smaller);
    }
    if (part.level == 1) --cells_;
  }

  const DeepPart& deep_;
  const RegionParts& all_;
  PointInMesh inside_;
  TriangleTree::Hit near_;
  std::vector<RegionPart> parts_;
  int cells_ = 0; ///< the next of the numbers of cells that were whole
};

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
  RegionParts result{all.edge, all.wall, {}};
  if (!set.deep) return result;
  constexpr Eigen::Index kRun = 512;
  const auto count = static_cast<Eigen::Index>(all.parts.size());
  std::vector<std::vector<RegionPart>> chunks(static_cast<std::size_t>((count + kRun - 1) / kRun));
  forChunks(count, kRun, [&](const Chunk& chunk) {
    Opening opening(*set.deep, all);
    for (Eigen::Index i = chunk.begin; i < chunk.end; ++i) {
      opening.add(all.parts[static_cast<std::size_t>(i)], static_cast<int>(i));
    }
    chunks[static_cast<std::size_t>(chunk.number)] = std::move(opening).parts();
  });
  for (const std::vector<RegionPart>& chunk : chunks) {
    result.parts.insert(result.parts.end(), chunk.begin(), chunk.end());
  }
  return result;
}

} // namespace massprops
