#include "core/physics/stable_poses.h"

#include "core/base/triangle.h"
#include "core/mesh/cgal_mesh.h"

#include <CGAL/convex_hull_3.h>
#include <boost/pending/disjoint_sets.hpp>

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace massprops {
namespace {

using Index = std::size_t;

/// The way from one face to the next leads over their edge, at most `height` high.
struct Passage {
  Index from, to;
  double height;
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
  std::map<std::pair<int, int>, Index> faceOf;
  std::vector<Passage> passages;
  for (Index f = 0; f < rests.heights.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int from = hull.faces(static_cast<Eigen::Index>(f), k);
      const int to = hull.faces(static_cast<Eigen::Index>(f), (k + 1) % 3);
      faceOf[{from, to}] = f;
      const auto other = faceOf.find({to, from});
      if (other == faceOf.end()) continue;
      const Index g = other->second;
      const Vec3 a = cornerOf(hull, f, k, centre);
      const Vec3 edge = (cornerOf(hull, f, k + 1, centre) - a).normalized();
      const Vec3 r = a - a.dot(edge) * edge;
      const Vec3& n = rests.normals[f];
      const Vec3& o = rests.normals[g];
      const Vec3 turn = n.cross(o);
      const bool overTheTop = n.cross(r).dot(turn) > 0.0 && r.cross(o).dot(turn) > 0.0;
      passages.push_back(
          {f, g, overTheTop ? r.norm() : std::max(rests.heights[f], rests.heights[g])});
    }
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

} // namespace

RollingHull rollingHull(const Points& vertices) {
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
  return {std::move(hull.vertices), std::move(hull.faces)};
}

StablePoses stablePoses(const RollingHull& hull, const Vec3& centre, double barrier) {
  const Rests rests = restsOf(hull, centre);
  const Index upright = uprightFace(rests);
  const std::size_t m = rests.heights.size();
  std::vector<Index> rank(m);
  std::vector<Index> parent(m);
  boost::disjoint_sets<Index*, Index*> pools(rank.data(), parent.data());
  for (Index f = 0; f < m; ++f) pools.make_set(f);
  std::vector<Index> lowest(m); // face of a pool, by the pool's representative
  std::iota(lowest.begin(), lowest.end(), Index{0});
  // Water rises: where two pools meet, the one with the higher bottom ends. It counts as a pose of
  // its own when it was deeper than the barrier; else what lay there rolls on into the other one.
  StablePoses poses;
  poses.count = 1;
  bool isSettled = false;
  for (const Passage& passage : passagesOf(hull, centre, rests)) {
    const Index from = pools.find_set(passage.from);
    const Index to = pools.find_set(passage.to);
    if (from == to) continue;
    Index low = lowest[from];
    Index high = lowest[to];
    if (rests.heights[low] > rests.heights[high]) std::swap(low, high);
    if (passage.height - rests.heights[high] > barrier) {
      ++poses.count;
      if (!isSettled && lowest[pools.find_set(upright)] == high) {
        isSettled = true;
        poses.down = rests.normals[high];
      }
    }
    pools.link(from, to);
    lowest[pools.find_set(from)] = low;
  }
  if (!isSettled) poses.down = rests.normals[lowest[pools.find_set(upright)]];
  return poses;
}

} // namespace massprops
