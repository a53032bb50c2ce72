#include "core/physics/stable_poses.h"

#include "core/base/angles.h"
#include "core/base/interruption.h"
#include "core/base/triangle.h"
#include "core/mesh/cgal_mesh.h"

#include <CGAL/convex_hull_3.h>
#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace massprops {
namespace {

using Index = std::size_t;

/// The way from one face to the next leads over their edge, at most `height` high.
struct Passage {
  Index from, to;
  double height;
  Vec3 top;   ///< the unit vector that points down there
  int vertex; ///< one end of the edge
};

/// The faces as what the hull may lie on.
struct Rests {
  std::vector<Vec3> normals;   ///< unit, outward
  std::vector<double> heights; ///< of the centre of mass while the hull lies on the face
};

Vec3 cornerOf(const RollingHull& hull, Index f, int k, const Vec3& centre) {
  return hull.vertices.row(hull.faces(static_cast<Eigen::Index>(f), k % 3)).transpose() - centre;
}

Rests restsOf(const RollingHull& hull, const Vec3& centre) {
  Rests rests;
  for (Index f = 0; f < static_cast<Index>(hull.faces.rows()); ++f) {
    const Vec3 a = cornerOf(hull, f, 0, centre);
    rests.normals.push_back(
        areaNormal(a, cornerOf(hull, f, 1, centre), cornerOf(hull, f, 2, centre)).normalized());
    rests.heights.push_back(rests.normals.back().dot(a));
  }
  return rests;
}

/// From the lowest to the highest.
std::vector<Passage> passagesOf(const RollingHull& hull, const Vec3& centre, const Rests& rests) {
  // On the arc of directions between two faces the edge is the lowest part, and the height is
  // r·u with r the perpendicular from the centre to the edge: greatest where u points along r.
  std::vector<Passage> passages;
  passages.reserve(hull.edges.size());
  for (const RollingHull::Edge& e : hull.edges) {
    const auto f = static_cast<Index>(e.face);
    const auto g = static_cast<Index>(e.other);
    const Vec3 a = hull.vertices.row(e.from).transpose() - centre;
    const Vec3 edge = (hull.vertices.row(e.to).transpose() - centre - a).normalized();
    const Vec3 r = a - a.dot(edge) * edge;
    const Vec3& n = rests.normals[f];
    const Vec3& o = rests.normals[g];
    const Vec3 turn = n.cross(o);
    const bool overTheTop = n.cross(r).dot(turn) > 0.0 && r.cross(o).dot(turn) > 0.0;
    const Index higher = rests.heights[f] > rests.heights[g] ? f : g;
    passages.push_back({f, g, overTheTop ? r.norm() : rests.heights[higher],
                        overTheTop ? Vec3(r.normalized()) : rests.normals[higher], e.from});
  }
  std::stable_sort(passages.begin(), passages.end(),
                   [](const Passage& a, const Passage& b) { return a.height < b.height; });
  return passages;
}

/// The face that looks down most.
Index uprightFace(const Rests& rests) {
  const auto looksDownLess = [](const Vec3& n, const Vec3& o) { return -n.z() < -o.z(); };
  return static_cast<Index>(
      std::max_element(rests.normals.begin(), rests.normals.end(), looksDownLess) -
      rests.normals.begin());
}

/// Where the body rolls to from a face, downhill all the way: over the edge that the foot of its
/// centre of mass lies farthest beyond, until it lies within a face.
Index rolledFrom(Index face, const RollingHull& hull, const Vec3& centre, const Rests& rests) {
  std::vector<std::vector<const RollingHull::Edge*>> edgesAt(rests.heights.size());
  for (const RollingHull::Edge& e : hull.edges) {
    edgesAt[static_cast<Index>(e.face)].push_back(&e);
    edgesAt[static_cast<Index>(e.other)].push_back(&e);
  }
  std::vector<char> isPast(rests.heights.size(), 0); // a plane's faces may lead round in a ring
  while (true) {
    isPast[face] = 1;
    const Vec3& n = rests.normals[face];
    const Vec3 foot = rests.heights[face] * n;
    double farthest = 0.0;
    Index next = face;
    for (const RollingHull::Edge* e : edgesAt[face]) {
      const bool isOwn = static_cast<Index>(e->face) == face;
      const Vec3 a = hull.vertices.row(isOwn ? e->from : e->to).transpose() - centre;
      const Vec3 b = hull.vertices.row(isOwn ? e->to : e->from).transpose() - centre;
      const double beyond = (b - a).cross(n).normalized().dot(foot - a);
      const auto other = static_cast<Index>(isOwn ? e->other : e->face);
      if (beyond <= farthest || isPast[other] != 0) continue;
      farthest = beyond;
      next = other;
    }
    if (next == face) return face;
    face = next;
  }
}

/// What water fills, by face: a pool each at first, named by its lowest face.
class Pools {
public:
  explicit Pools(std::size_t count)
      : rank_(count), parent_(count), lowest_(count), sets_(rank_.data(), parent_.data()) {
    for (Index f = 0; f < count; ++f) sets_.make_set(f);
    std::iota(lowest_.begin(), lowest_.end(), Index{0});
  }
  Pools(const Pools&) = delete;
  Pools& operator=(const Pools&) = delete;

  Index bottomOf(Index face) const { return lowest_[sets_.find_set(face)]; }
  void join(Index low, Index high) {
    sets_.link(sets_.find_set(low), sets_.find_set(high));
    lowest_[sets_.find_set(low)] = low;
  }

private:
  std::vector<Index> rank_, parent_;
  std::vector<Index> lowest_; ///< by the pool's representative
  mutable boost::disjoint_sets<Index*, Index*> sets_;
};

/// Water rises: where two pools meet, the one with the higher bottom ends. It counts as a pose of
/// its own when it was deeper than the barrier, and `end` is called; else what lay there rolls on
/// into the other one. Returns the lowest face.
Index flood(const Rests& rests, const std::vector<Passage>& passages, double barrier,
            const std::function<void(Index bottom, const Pools&)>& end) {
  Pools pools(rests.heights.size());
  for (const Passage& passage : passages) {
    Index low = pools.bottomOf(passage.from);
    Index high = pools.bottomOf(passage.to);
    if (low == high) continue;
    if (rests.heights[low] > rests.heights[high]) std::swap(low, high);
    if (passage.height - rests.heights[high] > barrier) end(high, pools);
    pools.join(low, high);
  }
  return pools.bottomOf(0);
}

std::vector<RollingHull::Edge> edgesOf(const Faces& faces) {
  std::map<std::pair<int, int>, int> faceOf;
  std::vector<RollingHull::Edge> edges;
  for (int f = 0; f < static_cast<int>(faces.rows()); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int from = faces(f, k);
      const int to = faces(f, (k + 1) % 3);
      faceOf[{from, to}] = f;
      const auto other = faceOf.find({to, from});
      if (other != faceOf.end()) edges.push_back({f, other->second, from, to});
    }
  }
  return edges;
}

/// What a body rolls through with its centre of mass at one point.
struct Landscape {
  const RollingHull& hull;
  const Vec3& centre;
  const Rests rests = restsOf(hull, centre);
  const std::vector<Passage> passages = passagesOf(hull, centre, rests);
};

/// The centres of mass for which all passages out of a set of faces are higher by the barrier than
/// one of these, `rest`.
HalfSpaces wellOf(const Landscape& land, const std::vector<char>& isInside, Index rest,
                  double barrier) {
  const auto& [hull, centre, rests, passages] = land;
  // On the way over an edge the height is at least u·(v − c), with any direction u between those of
  // the faces and v on the edge; at rest it is n·(w − c). Of some u the one whose border is
  // farthest from the centre.
  const Vec3 n = rests.normals[rest];
  const Vec3 w = cornerOf(hull, rest, 0, Vec3::Zero());
  std::vector<const Passage*> around;
  for (const Passage& passage : passages) {
    if (isInside[passage.from] != isInside[passage.to]) around.push_back(&passage);
  }
  const auto rows = static_cast<Eigen::Index>(around.size());
  HalfSpaces well{Points::Zero(rows, 3), Vector::Constant(rows, -barrier)};
  for (Eigen::Index row = 0; row < rows; ++row) {
    const Passage& passage = *around[static_cast<Index>(row)];
    const Vec3 v = hull.vertices.row(passage.vertex).transpose();
    double widest = -std::numeric_limits<double>::infinity();
    for (const Vec3& u : {passage.top, rests.normals[passage.from], rests.normals[passage.to]}) {
      const double limit = u.dot(v) - n.dot(w) - barrier;
      const double width = (limit - (u - n).dot(centre)) / (u - n).norm();
      if (!(width > widest)) continue;
      widest = width;
      well.normals.row(row) = (u - n).transpose();
      well.limits[row] = limit;
    }
  }
  return well;
}

/// The centres of mass for which no direction within `away` of −z is as low as the face `rest`.
HalfSpaces belowUpright(const Landscape& land, Index rest, double away) {
  const auto& [hull, centre, rests, passages] = land;
  constexpr int kCorners = 12; // of a polygon around the cap of these directions, cut in triangles
  const auto corner = [&](int i) {
    const double azimuth = 2.0 * kPi * i / kCorners;
    const double radius = std::tan(away) / std::cos(kPi / kCorners);
    return Vec3(radius * std::cos(azimuth), radius * std::sin(azimuth), -1.0).normalized();
  };
  const Vec3 n = rests.normals[rest];
  const Vec3 w = cornerOf(hull, rest, 0, Vec3::Zero());
  const Points arms = hull.vertices.rowwise() - centre.transpose();
  HalfSpaces well{Points(3 * kCorners, 3), Vector(3 * kCorners)};
  for (int i = 0; i < kCorners; ++i) {
    // In a triangle u·(v − c) is at least the least of its corners', for any vertex v.
    const std::array<Vec3, 3> corners{Vec3(-Vec3::UnitZ()), corner(i), corner(i + 1)};
    Eigen::Index best = 0;
    (arms * corners[0]).cwiseMin(arms * corners[1]).cwiseMin(arms * corners[2]).maxCoeff(&best);
    const Vec3 v = hull.vertices.row(best).transpose();
    Eigen::Index row = Eigen::Index{3} * i;
    for (const Vec3& u : corners) {
      well.normals.row(row) = (u - n).transpose();
      well.limits[row++] = u.dot(v) - n.dot(w);
    }
  }
  return well;
}

} // namespace

RollingHull rollingHull(const Points& vertices) {
  checkpoint();
  std::vector<SurfaceKernel::Point_3> points;
  points.reserve(static_cast<std::size_t>(vertices.rows()));
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    points.emplace_back(vertices(v, 0), vertices(v, 1), vertices(v, 2));
  }
  SurfaceMesh mesh;
  CGAL::convex_hull_3(points.begin(), points.end(), mesh);
  if (mesh.number_of_faces() < 4) {
    throw InvalidInput("The model is flat, so that it cannot roll: choose another goal.");
  }
  TriangleMesh hull = triangleMesh(mesh);
  std::vector<RollingHull::Edge> edges = edgesOf(hull.faces);
  return {std::move(hull.vertices), std::move(hull.faces), std::move(edges)};
}

StablePoses stablePoses(const RollingHull& hull, const Vec3& centre, double barrier) {
  const Rests rests = restsOf(hull, centre);
  const Index start = rolledFrom(uprightFace(rests), hull, centre, rests);
  StablePoses poses;
  bool isSettled = false;
  const auto end = [&](Index bottom, const Pools& pools) {
    poses.rests.push_back(rests.normals[bottom]);
    if (isSettled || pools.bottomOf(start) != bottom) return;
    isSettled = true;
    poses.down = rests.normals[bottom];
  };
  const Index lowest = flood(rests, passagesOf(hull, centre, rests), barrier, end);
  poses.rests.push_back(rests.normals[lowest]);
  if (!isSettled) poses.down = rests.normals[lowest];
  return poses;
}

std::vector<HalfSpaces> restingWells(const RollingHull& hull, const Vec3& centre, double barrier,
                                     double away) {
  const Landscape land{hull, centre};
  const Rests& rests = land.rests;
  const Index upright = uprightFace(rests);
  std::vector<HalfSpaces> wells;
  const auto end = [&](Index bottom, const Pools& pools) {
    const bool endsUpright = pools.bottomOf(upright) == bottom;
    std::vector<char> isOff(rests.heights.size()); // on the side where upright is not
    std::optional<Index> rest;                     // the lowest of these
    for (Index f = 0; f < isOff.size(); ++f) {
      isOff[f] = (pools.bottomOf(f) == bottom) != endsUpright ? 1 : 0;
      if (isOff[f] == 0) continue;
      if (-rests.normals[f].z() >= std::cos(away)) return;
      if (!rest || rests.heights[f] < rests.heights[*rest]) rest = f;
    }
    wells.push_back(wellOf(land, isOff, *rest, barrier));
  };
  const Index lowest = flood(rests, land.passages, barrier, end);
  if (-rests.normals[lowest].z() < std::cos(away)) {
    wells.push_back(belowUpright(land, lowest, away));
  }
  return wells;
}

} // namespace massprops
