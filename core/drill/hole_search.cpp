#include "core/drill/hole_search.h"

#include "core/base/infinity.h"
#include "core/base/triangle.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <tuple>

namespace massprops {
namespace {

/// A place where a drill may come out of the cavity.
struct Entry {
  Vec3 point, normal;
  double height;
};

/// Points all over a pool's bed, the lowest first.
std::vector<Entry> entriesOf(const Workpiece& piece, const Pool& pool, const Vec3& up) {
  const Points& vertices = piece.cavity.vertices();
  const Faces& faces = piece.cavity.faces();
  std::vector<char> isOwn(static_cast<std::size_t>(vertices.rows()), 0);
  for (const int v : pool.vertices) isOwn[static_cast<std::size_t>(v)] = 1;
  std::vector<Eigen::Index> bed;
  double area = 0.0;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const auto own = [&](int v) { return isOwn[static_cast<std::size_t>(v)] != 0; };
    const auto corners = faces.row(f);
    if (std::none_of(corners.begin(), corners.end(), own)) continue;
    bed.push_back(f);
    area += 0.5 * areaNormal(vertices, faces, f).norm();
  }
  constexpr double kMost = 3000.0;
  const double spacing = std::max(0.25 * piece.diameter, std::sqrt(area / kMost));
  std::vector<Entry> entries;
  double due = 0.5; // of a point, a square of the spacing each
  for (const Eigen::Index f : bed) {
    const Vec3 a = vertices.row(faces(f, 0)).transpose();
    const Vec3 b = vertices.row(faces(f, 1)).transpose();
    const Vec3 c = vertices.row(faces(f, 2)).transpose();
    const Vec3 normal = areaNormal(a, b, c);
    const double share = 0.5 * normal.norm() / (spacing * spacing);
    due += share;
    if (due < 1.0) continue;
    const int count = static_cast<int>(due);
    due -= count;
    // Middles of n² equal triangles.
    const int n = static_cast<int>(std::ceil(std::sqrt(count)));
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < 2 * (n - i) - 1; ++j) {
        const double third = j % 2 == 0 ? 1.0 / 3.0 : 2.0 / 3.0;
        const int column = j / 2;
        const double s = (i + third) / n;
        const double t = (column + third) / n;
        const Vec3 p = a + s * (b - a) + t * (c - a);
        if (p.dot(up) <= pool.level) entries.push_back({p, normal.normalized(), p.dot(up)});
      }
    }
  }
  std::stable_sort(entries.begin(), entries.end(),
                   [](const Entry& p, const Entry& q) { return p.height < q.height; });
  return entries;
}

/// Along the wall's normal, to the nearest point of the outer surface, downwards, and between.
std::vector<Vec3> directionsAt(const Workpiece& piece, const Entry& entry, const Vec3& up) {
  std::vector<Vec3> directions{entry.normal};
  const auto add = [&](const Vec3& d) {
    constexpr double kAlike = 0.99;
    const Vec3 unit = d.stableNormalized();
    const auto isAlike = [&](const Vec3& other) { return other.dot(unit) > kAlike; };
    if (std::none_of(directions.begin(), directions.end(), isAlike)) directions.push_back(unit);
  };
  const Vec3 nearest = piece.outer.nearest(entry.point).point - entry.point;
  add(nearest.normalized());
  add(entry.normal - up);
  add(entry.normal - entry.normal.dot(up) * up);
  add(entry.normal - entry.normal.dot(up) * up - 0.5 * up);
  add(-up);
  return directions;
}

bool isApart(const DrillSite& site, const std::vector<DrillSite>& taken) {
  return std::all_of(taken.begin(), taken.end(), [&](const DrillSite& other) {
    const double wide = site.hole.radiusAt(site.hole.length);
    const double otherWide = other.hole.radiusAt(other.hole.length);
    return axisDistance(site.hole, other.hole) > wide + otherWide + site.hole.radius;
  });
}

/// A site with what it leaves in the pool and takes out of the wall.
struct Choice {
  std::optional<DrillSite> site;
  double cost = kInfinity;
};

/// All that is asked of a place for a pool's outlet.
struct Search {
  const Workpiece& piece;
  const Vec3& up;
  const std::vector<DrillSite>& taken;
  std::vector<Entry> entries;
  PoolProfile profile;
};

/// The best of those that cost less than a limit.
Choice bestOf(const Search& search, Demands demands, double limit) {
  const auto& [piece, up, taken, entries, profile] = search;
  Choice best;
  double least = limit;
  // Where less than the least cost lies below: entries are ascending.
  const auto isLow = [&](const Entry& entry) {
    return search.profile.below(entry.height - search.piece.diameter) < least;
  };
  auto end = std::partition_point(entries.begin(), entries.end(), isLow);
  for (auto entry = entries.begin(); entry < end; ++entry) {
    for (const Vec3& direction : directionsAt(piece, *entry, up)) {
      std::optional<DrillSite> site =
          drillSite(piece, entry->point, entry->normal, direction, demands);
      if (!site || site->removed >= least || !isApart(*site, taken)) continue;
      const double cost = site->removed + profile.below(outletAt(*site, piece.cavity, up).level);
      if (cost >= least) continue;
      least = cost;
      best = {std::move(site), cost};
      end = std::partition_point(entry, end, isLow);
    }
  }
  return best;
}

std::vector<Outlet> outletsOf(const std::vector<DrillSite>& sites, const Workpiece& piece,
                              const Vec3& up) {
  std::vector<Outlet> outlets;
  outlets.reserve(sites.size());
  for (const DrillSite& site : sites) outlets.push_back(outletAt(site, piece.cavity, up));
  return outlets;
}

std::vector<Pool> poolsLeft(const Workpiece& piece, const Vec3& up,
                            const std::vector<DrillSite>& sites) {
  return standingPools({piece.cavity.vertices(), piece.cavity.faces()}, up,
                       outletsOf(sites, piece, up));
}

double total(const std::vector<Pool>& pools) {
  return std::accumulate(pools.begin(), pools.end(), 0.0,
                         [](double sum, const Pool& pool) { return sum + pool.volume; });
}

/// All of the cavity, as if it had no outlet.
Pool whole(const Workpiece& piece) {
  Pool pool;
  pool.level = kInfinity;
  pool.vertices.resize(static_cast<std::size_t>(piece.cavity.vertices().rows()));
  std::iota(pool.vertices.begin(), pool.vertices.end(), 0);
  return pool;
}

/// For pools that are larger than tolerated, the largest first.
void drainPools(const Workpiece& piece, const HoleWishes& wishes, std::vector<DrillSite>& sites) {
  constexpr double kWorthwhile = 0.5; // of the pool must go
  std::vector<int> hopeless;          // lowest vertices of pools
  while (true) {
    std::vector<Pool> pools = poolsLeft(piece, wishes.up, sites);
    const double before = total(pools);
    std::stable_sort(pools.begin(), pools.end(),
                     [](const Pool& a, const Pool& b) { return a.volume > b.volume; });
    const auto pool = std::find_if(pools.begin(), pools.end(), [&](const Pool& p) {
      return std::find(hopeless.begin(), hopeless.end(), p.vertices.front()) == hopeless.end();
    });
    if (pool == pools.end() || pool->volume <= wishes.toleratedPool) return;
    std::optional<DrillSite> site = bestSite(piece, *pool, wishes.up, sites, wishes.toleratedPool);
    if (site) {
      sites.push_back(std::move(*site));
      if (before - total(poolsLeft(piece, wishes.up, sites)) > kWorthwhile * pool->volume) continue;
      sites.pop_back();
    }
    hopeless.push_back(pool->vertices.front());
  }
}

} // namespace

std::optional<DrillSite> bestSite(const Workpiece& piece, const Pool& pool, const Vec3& up,
                                  const std::vector<DrillSite>& taken, double toleratedPool) {
  const Search search{
      piece, up, taken, entriesOf(piece, pool, up),
      PoolProfile({piece.cavity.vertices(), piece.cavity.faces()}, up, pool.vertices)};
  Choice clear = bestOf(search, Demands::Clear, kInfinity);
  if (clear.cost < 2.0 * toleratedPool) return clear.site;
  constexpr double kMuchLess = 0.25;
  Choice bare = bestOf(search, Demands::Bare, kMuchLess * clear.cost);
  return bare.site ? bare.site : clear.site;
}

std::vector<DrillSite> holesFor(const Workpiece& piece, const HoleWishes& wishes) {
  std::vector<DrillSite> sites;
  const auto addOne = [&](const Vec3& up) {
    std::optional<DrillSite> site = bestSite(piece, whole(piece), up, sites, wishes.toleratedPool);
    if (!site) return false;
    sites.push_back(std::move(*site));
    return true;
  };
  if (!addOne(wishes.up)) return {};
  if (wishes.fewest > 1) addOne(-wishes.up);
  drainPools(piece, wishes, sites);
  Vec3 up = wishes.up;
  const auto addAnother = [&] {
    const bool isAdded = addOne(up) || addOne(-up);
    up = -up;
    return isAdded;
  };
  while (static_cast<int>(sites.size()) < wishes.fewest && addAnother()) {
  }
  return sites;
}

} // namespace massprops
