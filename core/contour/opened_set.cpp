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

/// Level of the parts where the opening ends: in rooms hardly wider than the ball other borders are
/// next to it.
constexpr int kFiner = -1;

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

/// Of cubes behind the walls another plane cuts those where the opening ends or something is
/// filled.
RegionParts partsWithin(const OpenedSet& set, const RegionParts& all) {
  if (!set.deep) return {all.edge, all.wall, {}};
  RegionParts result = partsLeft(
      all, [&] { return WithinReach(*set.deep); }, kFiner);
  if (!set.fill) return result;
  return partsLeft(result, [&] {
    return [&](const RegionPart& part, double) { return set.fill->at(part.centre); };
  });
}

/// Calls visit(some) for the parts by turns, those of a cell in one: what is left of all at once
/// takes as much memory as all else.
template <class Visit>
void inTurns(const RegionParts& all, const Visit& visit) {
  constexpr std::size_t kTurn = 1U << 14U;
  RegionParts some{all.edge, all.wall, {}, all.opposites};
  for (std::size_t i = 0; i < all.parts.size(); ++i) {
    const RegionPart& part = all.parts[i];
    some.parts.push_back(part);
    const bool isLast = i + 1 == all.parts.size();
    const bool goesOn = !isLast && part.level <= 0 && all.parts[i + 1].level <= 0 &&
                        all.parts[i + 1].cell == part.cell;
    if (!isLast && (goesOn || some.parts.size() < kTurn)) continue;
    visit(some);
    some.parts.clear();
  }
}

} // namespace

double edgeOfCubes(double area, double count) {
  return std::sqrt(kCubesPerArea * area / count);
}

OpenedSet openedSet(const TriangleTree& surface, double wall, double edge) {
  constexpr double kCoarser = 1.4; // nobody sees it
  return openedSet(surface, wall, {wall, kCoarser * edge}, edge);
}

OpenedSet openedSet(const TriangleTree& surface, double wall, const OpeningBall& ball,
                    double edge) {
  OpenedSet set{surface, (1.0 + kMargin) * wall, ball, edge, {}};
  const double narrow = 0.5 * ball.width;
  auto border = std::make_unique<const TriangleMesh>(
      dualContour(borderLattice({surface, set.wall + narrow}, ball.edge)).mesh);
  if (border->faces.rows() == 0) return set;
  TriangleTree tree(border->vertices, border->faces);
  set.deep = std::make_shared<const DeepPart>(
      DeepPart{std::move(border), std::move(tree), set.wall + narrow + ball.edge, kReach * narrow});
  return set;
}

double volumeInDoubt(const OpenedSet& set, const RegionParts& all) {
  const double fits = set.wall + 0.5 * set.ball.width;
  const auto volume = [](const RegionParts& parts) { return cellsOf(parts).col(0).sum(); };
  double doubtful = 0.0;
  inTurns(all, [&](RegionParts& some) {
    const auto doesNotFit = [&](const RegionPart& part) {
      const double half = 0.5 * std::sqrt(3.0) * all.edge * std::ldexp(1.0, part.level - 1);
      return part.depth + half < fits;
    };
    std::vector<RegionPart>& parts = some.parts;
    parts.erase(std::remove_if(parts.begin(), parts.end(), doesNotFit), parts.end());
    doubtful += volume(some) - volume(partsWithin(set, some));
  });
  return doubtful;
}

AdmissibleCells cellsWithin(const OpenedSet& set, const RegionParts& all) {
  std::vector<AdmissibleCells> turns;
  Eigen::Index count = 0;
  inTurns(all, [&](const RegionParts& some) {
    turns.push_back(cellsOf(partsWithin(set, some)));
    count += turns.back().rows();
  });
  AdmissibleCells cells(count, 10);
  Eigen::Index first = 0;
  for (const AdmissibleCells& some : turns) {
    cells.middleRows(first, some.rows()) = some;
    first += some.rows();
  }
  return cells;
}

} // namespace massprops
