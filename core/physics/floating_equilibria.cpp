#include "core/physics/floating_equilibria.h"

#include "core/base/circle.h"
#include "core/base/infinity.h"
#include "core/base/parallel.h"
#include "core/mesh/decimation.h"
#include "core/physics/orientation_grid.h"

#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace massprops {
namespace {

using Index = std::size_t;

constexpr Eigen::Index kCopySize = 500; // vertices

std::vector<double> energiesOn(const OrientationGrid& grid, const FloatingBody& copy) {
  std::vector<double> energies(grid.ups.size());
  constexpr Eigen::Index kChunk = 64;
  forChunks(static_cast<Eigen::Index>(energies.size()), kChunk, [&](const Chunk& chunk) {
    for (auto i = static_cast<Index>(chunk.begin); i < static_cast<Index>(chunk.end); ++i) {
      energies[i] = inclinedEnergy(copy, grid.ups[i]);
    }
  });
  return energies;
}

/// For every orientation the lowest one that it descends to, from neighbour to neighbour.
std::vector<Index> basinsOf(const OrientationGrid& grid, const std::vector<double>& energies) {
  const auto isLower = [&](Index i, Index j) {
    return std::pair(energies[i], i) < std::pair(energies[j], j);
  };
  std::vector<Index> next(energies.size());
  std::iota(next.begin(), next.end(), Index{0});
  for (const auto& [i, j] : grid.edges) {
    if (isLower(i, next[j])) next[j] = i;
    if (isLower(j, next[i])) next[i] = j;
  }
  for (Index& to : next) {
    while (next[to] != to) to = next[to];
  }
  return next;
}

/// Poses at the bottoms of the basins, and at last the one that the upright body comes to.
std::vector<FloatingPose> bottomsOf(const FloatingBody& copy, const std::vector<Vec3>& starts) {
  std::vector<FloatingPose> poses(starts.size());
  forChunks(static_cast<Eigen::Index>(starts.size()), 1, [&](const Chunk& chunk) {
    const auto i = static_cast<Index>(chunk.begin);
    poses[i] = floatingPose(copy, starts[i]);
  });
  return poses;
}

/// The lowest energy near the great circle of `m` and `across`, started at `m`; both unit and
/// orthogonal.
double lowestAcross(const FloatingBody& copy, const Vec3& m, const Vec3& across) {
  double angle = 0.0;
  double lowest = kInfinity;
  while (true) {
    const Inclination at = inclined(copy, std::cos(angle) * m + std::sin(angle) * across);
    if (at.energy >= lowest - kNoLever) return std::min(at.energy, lowest);
    lowest = at.energy;
    const Vec3 t = std::cos(angle) * across - std::sin(angle) * m;
    const double curvature = std::max(std::abs(at.metacentricHeight(t)), 1e-6);
    angle -= std::clamp(at.lever(t) / curvature, -kMostTurn, kMostTurn);
  }
}

/// Energy of the highest point on a path from pose to pose that keeps as low as it can.
double passBetween(const FloatingBody& copy, const FloatingPose& from, const FloatingPose& to) {
  double highest = std::max(from.energy, to.energy);
  const double angle = std::atan2(from.up.cross(to.up).norm(), from.up.dot(to.up));
  if (angle < kSame) return highest;
  Vec3 along = to.up - from.up.dot(to.up) * from.up;
  if (along.norm() < 1e-6) return kInfinity; // opposite: many ways
  along.normalize();
  const Vec3 across = from.up.cross(along);
  const int steps = static_cast<int>(std::ceil(angle / kMostTurn));
  for (int step = 1; step < steps; ++step) {
    const double a = angle * step / steps;
    highest =
        std::max(highest, lowestAcross(copy, std::cos(a) * from.up + std::sin(a) * along, across));
  }
  return highest;
}

struct Passage {
  Index from, to;
  double height;
};

/// Passages from basin to basin, from the lowest to the highest.
class Passages {
public:
  Passages(const FloatingBody& copy, const std::vector<FloatingPose>& bottoms, double barrier)
      : copy_(copy), bottoms_(bottoms), barrier_(barrier) {}

  void add(Index from, Index to, double height) {
    const auto [at, isNew] = heights_.try_emplace(std::minmax(from, to), height);
    if (!isNew) at->second = std::min(at->second, height);
  }

  std::vector<Passage> sorted() const {
    std::vector<Passage> passages;
    for (const auto& [ends, height] : heights_) {
      passages.push_back({ends.first, ends.second, height});
    }
    forChunks(static_cast<Eigen::Index>(passages.size()), 1, [&](const Chunk& chunk) {
      Passage& p = passages[static_cast<Index>(chunk.begin)];
      if (isDoubtful(p)) {
        p.height = std::min(p.height, passBetween(copy_, bottoms_[p.from], bottoms_[p.to]));
      }
    });
    std::stable_sort(passages.begin(), passages.end(),
                     [](const Passage& a, const Passage& b) { return a.height < b.height; });
    return passages;
  }

private:
  /// The way over the grid's points may be higher than a valley between them by the square of
  /// their distance.
  bool isDoubtful(const Passage& p) const {
    const FloatingPose& a = bottoms_[p.from];
    const FloatingPose& b = bottoms_[p.to];
    const double rise = p.height - std::max(a.energy, b.energy);
    const double curvature = std::max(a.greatestMetacentricHeight, b.greatestMetacentricHeight);
    const double spacing = orientationGrid().spacing;
    return rise > barrier_ && rise < barrier_ + curvature * spacing * spacing;
  }

  const FloatingBody& copy_;
  const std::vector<FloatingPose>& bottoms_;
  double barrier_;
  std::map<std::pair<Index, Index>, double> heights_;
};

/// Bottoms that no barrier parts, the lowest of each family first.
using Families = std::vector<std::vector<Index>>;

/// Families, and bottoms of different ones that a barrier parts which the copy may owe to its own
/// flaws.
struct Parted {
  Families families;
  std::vector<std::array<Index, 2>> hardly;
};

Parted familiesOf(const std::vector<FloatingPose>& bottoms, const std::vector<Passage>& passages,
                  double barrier) {
  // Water rises: where two pools meet, the one with the higher bottom ends. It is a family of its
  // own when it was deeper than the barrier.
  constexpr double kFlaws = 20.0; // barriers
  const Index count = bottoms.size();
  std::vector<Index> rank(count);
  std::vector<Index> parent(count);
  boost::disjoint_sets<Index*, Index*> pools(rank.data(), parent.data());
  Families lowest(count); // by the pool's representative
  for (Index i = 0; i < count; ++i) {
    pools.make_set(i);
    lowest[i] = {i};
  }
  Parted result;
  for (const Passage& passage : passages) {
    const Index from = pools.find_set(passage.from);
    const Index to = pools.find_set(passage.to);
    if (from == to) continue;
    std::vector<Index> low = std::move(lowest[from]);
    std::vector<Index> high = std::move(lowest[to]);
    if (bottoms[low.front()].energy > bottoms[high.front()].energy) std::swap(low, high);
    const double depth = passage.height - bottoms[high.front()].energy;
    if (depth > barrier) {
      if (depth < kFlaws * barrier) result.hardly.push_back({passage.from, passage.to});
      result.families.push_back(std::move(high));
    } else {
      low.insert(low.end(), high.begin(), high.end());
    }
    pools.link(from, to);
    lowest[pools.find_set(from)] = std::move(low);
  }
  result.families.push_back(std::move(lowest[pools.find_set(0)]));
  return result;
}

/// With those in one that the body itself does not part.
Families joined(const FloatingBody& body, const std::vector<FloatingPose>& bottoms, Parted parted,
                double barrier) {
  Families& families = parted.families;
  const auto familyOf = [&](Index bottom) {
    return std::find_if(families.begin(), families.end(), [&](const std::vector<Index>& family) {
      return std::count(family.begin(), family.end(), bottom) > 0;
    });
  };
  for (const auto& [i, j] : parted.hardly) {
    const auto from = familyOf(i);
    const auto to = familyOf(j);
    if (from == to) continue;
    const FloatingPose a = floatingPose(body, bottoms[i].up);
    const FloatingPose b = floatingPose(body, bottoms[j].up);
    if (passBetween(body, a, b) > std::max(a.energy, b.energy) + barrier) continue;
    if (bottoms[from->front()].energy > bottoms[to->front()].energy) std::swap(*from, *to);
    from->insert(from->end(), to->begin(), to->end());
    families.erase(to);
  }
  return std::move(families);
}

double tiltOf(const Vec3& up) {
  return std::atan2(up.head<2>().norm(), up.z());
}

Parted familiesOn(const FloatingBody& copy, double barrier, std::vector<FloatingPose>& bottoms) {
  const OrientationGrid& grid = orientationGrid();
  const std::vector<double> energies = energiesOn(grid, copy);
  const std::vector<Index> basin = basinsOf(grid, energies);
  std::vector<Vec3> starts;
  std::vector<Index> number(basin.size());
  Index highest = 0; // up.z
  for (Index i = 0; i < basin.size(); ++i) {
    if (grid.ups[i].z() > grid.ups[highest].z()) highest = i;
    if (basin[i] != i) continue;
    number[i] = starts.size();
    starts.push_back(grid.ups[i]);
  }
  const Index upright = starts.size();
  starts.emplace_back(Vec3::UnitZ());
  bottoms = bottomsOf(copy, starts);
  Passages passages(copy, bottoms, barrier);
  for (const auto& [i, j] : grid.edges) {
    if (basin[i] == basin[j]) continue;
    passages.add(number[basin[i]], number[basin[j]], std::max(energies[i], energies[j]));
  }
  const Index below = number[basin[highest]];
  passages.add(below, upright, passBetween(copy, bottoms[below], bottoms[upright]));
  return familiesOf(bottoms, passages.sorted(), barrier);
}

/// The family's lowest pose and its tilts, on the body itself.
FloatingRest restOf(const FloatingBody& body, const std::vector<FloatingPose>& bottoms,
                    const std::vector<Index>& family, const FloatingPose& home, double barrier) {
  FloatingRest rest;
  rest.pose = floatingPose(body, bottoms[family.front()].up);
  const Vec3& first = bottoms[family.front()].up;
  const bool turns = std::any_of(family.begin(), family.end(), [&](Index i) {
    return (bottoms[i].up - first).norm() > 5.0 * kSame;
  });
  // The upright body comes to rest somewhere in its family.
  const bool isHome = std::count(family.begin(), family.end(), bottoms.size() - 1) > 0;
  if (turns && isHome && home.energy <= rest.pose.energy + barrier) rest.pose = home;
  rest.leastTilt = rest.greatestTilt = tiltOf(rest.pose.up);
  if (!turns) return rest;
  const auto include = [&](double tilt) {
    rest.leastTilt = std::min(rest.leastTilt, tilt);
    rest.greatestTilt = std::max(rest.greatestTilt, tilt);
  };
  for (const Index i : family) include(tiltOf(bottoms[i].up));
  // Of a family that turns, the members are where its facets lie deepest.
  for (const double end : {1.0, -1.0}) {
    const Vec3 up(0.0, 0.0, end);
    if (inclinedEnergy(body, up) <= rest.pose.energy + barrier) include(tiltOf(up));
  }
  return rest;
}

/// Adds the pose unless it is there.
void addRest(const FloatingBody& body, const FloatingRest& rest, std::vector<FloatingRest>& all) {
  for (FloatingRest& known : all) {
    if ((known.pose.up - rest.pose.up).norm() > kSame) continue;
    known.leastTilt = std::min(known.leastTilt, rest.leastTilt);
    known.greatestTilt = std::max(known.greatestTilt, rest.greatestTilt);
    return;
  }
  all.push_back(rest);
  all.back().isDry = inclined(body, rest.pose.up).isDry;
}

} // namespace

TriangleMesh coarseSurface(const Points& vertices, const Faces& faces) {
  return decimated(vertices, faces, {kCopySize, kCopySize, 0.0}).mesh;
}

FloatingBody withSurface(const FloatingBody& body, const TriangleMesh& surface) {
  FloatingBody result =
      floatingBody(surface.vertices, surface.faces, body.centre, body.displaced, body.rims);
  result.centre += result.middle - body.middle;
  result.displaced *= result.volume / body.volume;
  return result;
}

FloatingEquilibria floatingEquilibria(const FloatingBody& body, const FloatingBody& copy,
                                      double barrier) {
  FloatingEquilibria result;
  if (sinks(body)) return result;
  const FloatingPose home = floatingPose(body);
  const double homeTilt = tiltOf(home.up);
  if (isUnderWater(body)) {
    addRest(body, {home, true, homeTilt, homeTilt}, result.rests);
    return result;
  }
  std::vector<FloatingPose> bottoms;
  const Families families = joined(body, bottoms, familiesOn(copy, barrier, bottoms), barrier);
  std::vector<FloatingRest> rests(families.size());
  forChunks(static_cast<Eigen::Index>(rests.size()), 1, [&](const Chunk& chunk) {
    const auto i = static_cast<Index>(chunk.begin);
    rests[i] = restOf(body, bottoms, families[i], home, barrier);
  });
  for (const FloatingRest& rest : rests) addRest(body, rest, result.rests);
  addRest(body, {home, true, homeTilt, homeTilt}, result.rests);
  std::stable_sort(
      result.rests.begin(), result.rests.end(),
      [](const FloatingRest& a, const FloatingRest& b) { return a.leastTilt < b.leastTilt; });
  const auto isHome = [&](const FloatingRest& r) { return (r.pose.up - home.up).norm() <= kSame; };
  result.upright = static_cast<Index>(
      std::find_if(result.rests.begin(), result.rests.end(), isHome) - result.rests.begin());
  return result;
}

bool isHeldWithin(const FloatingBody& copy, const Vec3& up, double heel, double barrier) {
  const FloatingPose pose = floatingPose(copy, up);
  const Horizontal axes = horizontal(pose.up);
  for (int k = 0; k < kAround; ++k) {
    const Vec3 towards = axes * onCircle(k);
    const Vec3 heeled = std::cos(heel) * pose.up + std::sin(heel) * towards;
    if (inclinedEnergy(copy, heeled) <= pose.energy + barrier) return false;
  }
  return true;
}

} // namespace massprops
