#include "core/drill/pools.h"

#include "core/base/triangle.h"
#include "core/mesh/vertex_adjacency.h"
#include "core/query/point_in_mesh.h"
#include "core/query/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace massprops {
namespace {

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

/// ∫ (level − h) dA over the part of a triangle below the level, projected. Summed over a surface
/// whose part below is closed by the level's plane, it is the volume between.
double part(Vec3 heights, double projectedArea, double level) {
  std::sort(heights.begin(), heights.end());
  const Vec3 depths = level - heights.array();
  if (depths[0] <= 0.0) return 0.0;
  if (depths[1] <= 0.0) {
    // A corner of the triangle.
    const double share = depths[0] / (depths[0] - depths[1]) * depths[0] / (depths[0] - depths[2]);
    return projectedArea * share * depths[0] / 3.0;
  }
  double integral = projectedArea * depths.mean();
  if (depths[2] < 0.0) {
    const double share = depths[2] / (depths[2] - depths[0]) * depths[2] / (depths[2] - depths[1]);
    integral -= projectedArea * share * depths[2] / 3.0;
  }
  return integral;
}

/// Of two vertices at one height the first is the lower one.
bool isBelow(const Vector& heights, int a, int b) {
  return std::tie(heights[a], a) < std::tie(heights[b], b);
}

/// The parts of the cavity below a level that rises, and what flows out of them.
class Flooding {
public:
  Flooding(const TriangleMesh& cavity, const Vec3& up)
      : cavity_(cavity), up_(up), heights_(cavity.vertices * up),
        neighbours_(vertexAdjacency(cavity.vertices.rows(), cavity.faces)),
        tree_(cavity.vertices, cavity.faces), inside_(tree_),
        parent_(at(cavity.vertices.rows()), -1), members_(parent_.size()),
        isDry_(parent_.size(), 0) {}

  std::vector<Pool> run(std::vector<Outlet> outlets) {
    std::vector<int> order(parent_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](int a, int b) { return isBelow(a, b); });
    std::stable_sort(outlets.begin(), outlets.end(),
                     [](const Outlet& a, const Outlet& b) { return a.level < b.level; });
    auto next = outlets.begin();
    for (const int v : order) {
      for (; next != outlets.end() && next->level < heights_[v]; ++next) open(*next);
      rise(v);
    }
    for (; next != outlets.end(); ++next) open(*next);
    for (const int v : order) {
      if (isDry_[at(root(v))] == 0) settle(root(v), std::numeric_limits<double>::infinity());
    }
    std::sort(pools_.begin(), pools_.end(), [&](const Pool& a, const Pool& b) {
      return isBelow(a.vertices.front(), b.vertices.front());
    });
    return std::move(pools_);
  }

private:
  bool isBelow(int a, int b) const { return massprops::isBelow(heights_, a, b); }

  int root(int v) {
    while (parent_[at(v)] != v) {
      parent_[at(v)] = parent_[at(parent_[at(v)])];
      v = parent_[at(v)];
    }
    return v;
  }

  /// The level comes to a vertex: parts meet there, or a new one begins.
  void rise(int v) {
    std::vector<int> roots;
    for (const int w : neighbours_[at(v)]) {
      if (isBelow(w, v)) roots.push_back(root(w));
    }
    if (roots.empty()) {
      const int below = vertexBelow(v);
      if (below >= 0) roots.push_back(root(below));
    }
    std::sort(roots.begin(), roots.end());
    roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
    const auto isDry = [&](int r) { return isDry_[at(r)] != 0; };
    if (std::any_of(roots.begin(), roots.end(), isDry)) {
      for (const int r : roots) {
        if (!isDry(r)) settle(r, heights_[v]);
      }
    }
    parent_[at(v)] = v;
    if (roots.empty()) {
      members_[at(v)] = {v};
      return;
    }
    const int largest = *std::max_element(roots.begin(), roots.end(), [&](int a, int b) {
      return members_[at(a)].size() < members_[at(b)].size();
    });
    std::vector<int>& all = members_[at(largest)];
    for (const int r : roots) {
      if (r == largest) continue;
      parent_[at(r)] = largest;
      all.insert(all.end(), members_[at(r)].begin(), members_[at(r)].end());
      members_[at(r)] = {};
    }
    parent_[at(v)] = largest;
    all.push_back(v);
  }

  /// Of a vertex without lower neighbours: one of the cavity's part that lies around it when it
  /// hangs from the ceiling; −1 where the cavity begins there.
  int vertexBelow(int v) const {
    const Vec3 tip = cavity_.vertices.row(v).transpose();
    const double length = tree_.firstHit(tip, -up_);
    if (!std::isfinite(length) || !inside_.contains(tip - 0.5 * length * up_)) return -1;
    const int face = tree_.nearest(tip - length * up_).face;
    const auto corners = cavity_.faces.row(face);
    int lowest = corners[0];
    for (const int w : corners) lowest = isBelow(w, lowest) ? w : lowest;
    return isBelow(lowest, v) ? lowest : -1;
  }

  void open(const Outlet& outlet) {
    const int r = root(outlet.vertex);
    if (isDry_[at(r)] == 0) settle(r, outlet.level);
  }

  /// What lies above the level has run off.
  void settle(int r, double level) {
    isDry_[at(r)] = 1;
    Pool pool;
    pool.level = level;
    pool.vertices = std::move(members_[at(r)]);
    members_[at(r)] = {};
    std::sort(pool.vertices.begin(), pool.vertices.end(),
              [&](int a, int b) { return isBelow(a, b); });
    pool.volume = PoolProfile(cavity_, up_, pool.vertices).below(level);
    if (pool.volume > 0.0) pools_.push_back(std::move(pool));
  }

  const TriangleMesh& cavity_;
  const Vec3 up_;
  const Vector heights_;
  const VertexAdjacency neighbours_;
  const TriangleTree tree_;
  const PointInMesh inside_;
  std::vector<int> parent_;
  std::vector<std::vector<int>> members_; ///< of the parts that are not dry, at their roots
  std::vector<char> isDry_;               ///< of roots
  std::vector<Pool> pools_;
};

} // namespace

std::vector<Pool> standingPools(const TriangleMesh& cavity, const Vec3& up,
                                const std::vector<Outlet>& outlets) {
  if (cavity.faces.rows() == 0) return {};
  return Flooding(cavity, up).run(outlets);
}

PoolProfile::PoolProfile(const TriangleMesh& cavity, const Vec3& up,
                         const std::vector<int>& vertices) {
  const Vector heights = cavity.vertices * up;
  highest_ = heights.maxCoeff();
  std::vector<char> isOwn(at(heights.size()), 0);
  for (const int v : vertices) isOwn[at(v)] = 1;
  for (Eigen::Index f = 0; f < cavity.faces.rows(); ++f) {
    // A face belongs to its lowest vertex.
    const auto corners = cavity.faces.row(f);
    int lowest = corners[0];
    for (const int v : corners) lowest = isBelow(heights, v, lowest) ? v : lowest;
    if (isOwn[at(lowest)] == 0) continue;
    parts_.push_back({{heights[corners[0]], heights[corners[1]], heights[corners[2]]},
                      -0.5 * areaNormal(cavity.vertices, cavity.faces, f).dot(up)});
  }
}

double PoolProfile::below(double height) const {
  const double level = std::min(height, highest_);
  double volume = 0.0;
  for (const Part& p : parts_) volume += part(p.heights, p.projectedArea, level);
  return volume;
}

} // namespace massprops
