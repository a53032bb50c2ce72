#include "core/contour/opened_set.h"

#include "core/base/triangle.h"
#include "core/contour/dual_contour.h"
#include "core/optimum/parts_cut.h"

#include <algorithm>
#include <cmath>
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
  RegionParts result = partsLeft(all, [&] { return WithinReach(*set.deep); });
  if (!set.fill) return result;
  return partsLeft(result, [&] {
    return [&](const RegionPart& part, double) { return set.fill->at(part.centre); };
  });
}

} // namespace massprops
