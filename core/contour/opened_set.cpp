#include "core/contour/opened_set.h"

#include "core/base/triangle.h"
#include "core/optimum/parts_cut.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace massprops {
namespace {

/// More than the wanted wall: what rounding takes.
constexpr double kMargin = 1e-5;
/// How far from the middle of the ball the cavity goes, in its radii: a cube's corner, too, is
/// reached.
constexpr double kReach = 1.8;
/// A room as wide as the ball has place for one that is a little smaller, for facets make a round
/// room narrower.
constexpr double kJustFits = 0.99;

/// Level of the parts where the opening ends: in rooms hardly wider than the ball other borders are
/// next to it.
constexpr int kFiner = -1;

/// How far parts are within the opening's reach.
class WithinReach {
public:
  explicit WithinReach(const OpenedSet& set)
      : fits_(set.opening.fits), probe_(set.surface, set.opening) {}

  std::optional<Sample> operator()(const RegionPart& part, double half) {
    // Depths of parts of cubes are those behind the cubes' planes.
    if (part.depth >= fits_ + half || probe_.isSurely(part.centre, half))
      return Sample{std::numeric_limits<double>::infinity(), Vec3::UnitX()};
    return probe_.at(part.centre, probe_.depthAt(part.centre, false), half, half);
  }

private:
  double fits_;
  OpeningProbe probe_;
};

/// Of cubes behind the walls another plane cuts those where the opening ends or something is
/// filled.
RegionParts partsWithin(const OpenedSet& set, const RegionParts& all) {
  RegionParts result = partsLeft(
      all, [&] { return WithinReach(set); }, kFiner);
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
  return openedSet(surface, wall, wall, edge);
}

OpenedSet openedSet(const TriangleTree& surface, double wall, double ball, double edge) {
  const double radius = kJustFits * 0.5 * ball;
  const double roomy = (1.0 + kMargin) * wall;
  return {surface, roomy, ball, edge, {roomy + radius, kReach * radius}};
}

double wallWithRoomFor(double radius) {
  return radius / (1.0 + kMargin + 0.5 * kJustFits);
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
