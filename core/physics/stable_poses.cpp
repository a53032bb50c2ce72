#include "core/physics/stable_poses.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <vector>

namespace massprops {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// The way from one face to the next leads over their edge, at most `height` high.
struct Passage {
  int from, to;
  double height;
};

class Sets {
public:
  explicit Sets(std::size_t size) : parent_(size) { std::iota(parent_.begin(), parent_.end(), 0); }
  int find(int i) {
    while (parent(i) != i) i = parent(i) = parent(parent(i));
    return i;
  }
  void join(int child, int root) { parent(child) = root; }

private:
  int& parent(int i) { return parent_[static_cast<std::size_t>(i)]; }
  std::vector<int> parent_;
};

} // namespace

RollingHull rollingHull(const Points& vertices) {
  std::vector<Kernel::Point_3> points;
  points.reserve(static_cast<std::size_t>(vertices.rows()));
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    points.emplace_back(vertices(v, 0), vertices(v, 1), vertices(v, 2));
  }
  SurfaceMesh mesh;
  CGAL::convex_hull_3(points.begin(), points.end(), mesh);
  if (mesh.number_of_faces() < 4) {
    throw InvalidInput("The model is flat, so that it cannot roll: choose another goal.");
  }
  RollingHull hull;
  hull.vertices.resize(static_cast<Eigen::Index>(mesh.number_of_vertices()), 3);
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    hull.vertices.row(static_cast<Eigen::Index>(v.idx())) << p.x(), p.y(), p.z();
  }
  hull.faces.resize(static_cast<Eigen::Index>(mesh.number_of_faces()), 3);
  for (const auto f : mesh.faces()) {
    int corner = 0;
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) {
      hull.faces(static_cast<Eigen::Index>(f.idx()), corner++) = static_cast<int>(v.idx());
    }
  }
  return hull;
}

StablePoses stablePoses(const RollingHull& hull, const Vec3& centre, double barrier) {
  const auto corner = [&](Eigen::Index f, int k) -> Vec3 {
    return hull.vertices.row(hull.faces(f, k)).transpose() - centre;
  };
  const Eigen::Index m = hull.faces.rows();
  std::vector<Vec3> normals;
  Vector heights(m); // of the centre of mass while the hull lies on the face
  for (Eigen::Index f = 0; f < m; ++f) {
    const Vec3 a = corner(f, 0);
    normals.push_back((corner(f, 1) - a).cross(corner(f, 2) - a).normalized());
    heights[f] = normals.back().dot(a);
  }

  // On the arc of directions between two faces the edge is the lowest part, and the height is
  // r·u with r the perpendicular from the centre to the edge: greatest where u points along r.
  std::map<std::pair<int, int>, int> faceOf;
  std::vector<Passage> passages;
  for (int f = 0; f < static_cast<int>(m); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int from = hull.faces(f, k);
      const int to = hull.faces(f, (k + 1) % 3);
      faceOf[{from, to}] = f;
      const auto other = faceOf.find({to, from});
      if (other == faceOf.end()) continue;
      const int g = other->second;
      const Vec3 a = corner(f, k);
      const Vec3 edge = (corner(f, (k + 1) % 3) - a).normalized();
      const Vec3 r = a - a.dot(edge) * edge;
      const Vec3 n = normals[static_cast<std::size_t>(f)];
      const Vec3 o = normals[static_cast<std::size_t>(g)];
      const Vec3 turn = n.cross(o);
      const bool overTheTop = n.cross(r).dot(turn) > 0.0 && r.cross(o).dot(turn) > 0.0;
      passages.push_back({f, g, overTheTop ? r.norm() : std::max(heights[f], heights[g])});
    }
  }

  // Water rises: where two pools meet, the one with the higher bottom ends. It counts as a pose of
  // its own when it was deeper than the barrier; else what lay there rolls on into the other one.
  std::stable_sort(passages.begin(), passages.end(),
                   [](const Passage& a, const Passage& b) { return a.height < b.height; });
  int upright = 0; // the face that looks down most
  for (int f = 1; f < static_cast<int>(m); ++f) {
    const auto looksDown = [&](int face) { return -normals[static_cast<std::size_t>(face)].z(); };
    if (looksDown(f) > looksDown(upright)) upright = f;
  }
  StablePoses poses;
  poses.count = 1;
  int settled = -1;
  Sets pools(static_cast<std::size_t>(m)); // the root is the lowest face
  for (const Passage& passage : passages) {
    int low = pools.find(passage.from);
    int high = pools.find(passage.to);
    if (low == high) continue;
    if (heights[low] > heights[high]) std::swap(low, high);
    if (passage.height - heights[high] > barrier) {
      ++poses.count;
      if (settled < 0 && pools.find(upright) == high) settled = high;
    }
    pools.join(high, low);
  }
  const int at = settled < 0 ? pools.find(upright) : settled;
  poses.down = normals[static_cast<std::size_t>(at)];
  return poses;
}

} // namespace massprops
