#include "judge/enclosure.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <functional>
#include <queue>
#include <vector>

namespace massprops::testing {

namespace {

constexpr double kPi = 3.14159265358979323846;

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Tree = CGAL::AABB_tree<
    CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>>>;

/// Solid angles, far triangles taken together by the sum of their areas. [BDSLJ18]
class Winding {
public:
  explicit Winding(const TriangleMesh& mesh) {
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
      Triangle t;
      for (int k = 0; k < 3; ++k) t.corner[k] = mesh.vertices.row(mesh.faces(f, k)).transpose();
      t.middle = (t.corner[0] + t.corner[1] + t.corner[2]) / 3.0;
      t.area = 0.5 * (t.corner[1] - t.corner[0]).cross(t.corner[2] - t.corner[0]);
      triangles_.push_back(t);
    }
    if (!triangles_.empty()) build(0, triangles_.size());
  }

  bool isInside(const Vec3& p) const {
    return !nodes_.empty() && std::abs(solidAngle(0, p)) >= 2.0 * kPi;
  }

private:
  struct Triangle {
    Vec3 corner[3], middle, area;
  };
  struct Node {
    Vec3 middle = Vec3::Zero(), area = Vec3::Zero();
    double radius = 0.0;
    std::size_t begin, end, right = 0; ///< the left child follows; 0: a leaf
  };

  void build(std::size_t begin, std::size_t end) {
    const std::size_t self = nodes_.size();
    nodes_.emplace_back();
    Node node;
    node.begin = begin;
    node.end = end;
    Eigen::AlignedBox3d box;
    double weight = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      const double area = triangles_[i].area.norm();
      node.area += triangles_[i].area;
      node.middle += area * triangles_[i].middle;
      weight += area;
      box.extend(triangles_[i].middle);
    }
    node.middle = weight > 0.0 ? Vec3(node.middle / weight) : Vec3(box.center());
    for (std::size_t i = begin; i < end; ++i) {
      for (const Vec3& p : triangles_[i].corner)
        node.radius = std::max(node.radius, (p - node.middle).norm());
    }
    constexpr std::size_t kLeaf = 8;
    if (end - begin > kLeaf) {
      Eigen::Index axis = 0;
      box.sizes().maxCoeff(&axis);
      const std::size_t half = begin + (end - begin) / 2;
      std::nth_element(
          triangles_.begin() + static_cast<long>(begin),
          triangles_.begin() + static_cast<long>(half), triangles_.begin() + static_cast<long>(end),
          [&](const Triangle& s, const Triangle& t) { return s.middle[axis] < t.middle[axis]; });
      build(begin, half);
      node.right = nodes_.size();
      build(half, end);
    }
    nodes_[self] = node;
  }

  double solidAngle(std::size_t n, const Vec3& p) const {
    const Node& node = nodes_[n];
    const Vec3 way = node.middle - p;
    const double distance = way.norm();
    constexpr double kFar = 3.0;
    if (distance > kFar * node.radius) return node.area.dot(way) / std::pow(distance, 3);
    if (node.right != 0) return solidAngle(n + 1, p) + solidAngle(node.right, p);
    double sum = 0.0;
    for (std::size_t i = node.begin; i < node.end; ++i) {
      // tan(Ω/2) = a·(b×c) / (abc + (a·b)c + (b·c)a + (c·a)b)
      const Vec3 a = triangles_[i].corner[0] - p;
      const Vec3 b = triangles_[i].corner[1] - p;
      const Vec3 c = triangles_[i].corner[2] - p;
      const double la = a.norm();
      const double lb = b.norm();
      const double lc = c.norm();
      sum += 2.0 * std::atan2(a.dot(b.cross(c)),
                              la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
    }
    return sum;
  }

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
};

Eigen::AlignedBox3d boxOf(const TriangleMesh& mesh) {
  Eigen::AlignedBox3d box;
  for (const int v : mesh.faces.reshaped()) box.extend(Vec3(mesh.vertices.row(v).transpose()));
  return box;
}

Triangles withArea(const TriangleMesh& mesh) {
  Triangles triangles;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    Kernel::Point_3 p[3];
    for (int k = 0; k < 3; ++k) {
      const auto row = mesh.vertices.row(mesh.faces(f, k));
      p[k] = {row[0], row[1], row[2]};
    }
    const Kernel::Triangle_3 triangle(p[0], p[1], p[2]);
    if (!triangle.is_degenerate()) triangles.push_back(triangle);
  }
  return triangles;
}

template <class Visit>
void forHalved(const Vec3& middle, double side, const Visit& visit) {
  for (int k = 0; k < 8; ++k) {
    const Vec3 way((k & 1) != 0 ? 1.0 : -1.0, (k & 2) != 0 ? 1.0 : -1.0, (k & 4) != 0 ? 1.0 : -1.0);
    visit(Vec3(middle + 0.25 * side * way), 0.5 * side);
  }
}

/// Calls visit(middle) for cubes of this side that fill the box.
template <class Visit>
void forCubes(const Eigen::AlignedBox3d& box, double side, const Visit& visit) {
  int count[3];
  for (int k = 0; k < 3; ++k)
    count[k] = std::max(1, static_cast<int>(std::ceil(box.sizes()[k] / side)));
  for (int x = 0; x < count[0]; ++x)
    for (int y = 0; y < count[1]; ++y)
      for (int z = 0; z < count[2]; ++z)
        visit(Vec3(box.min() + side * Vec3(x + 0.5, y + 0.5, z + 0.5)));
}

} // namespace

Enclosure enclosedBy(const TriangleMesh& mesh) {
  if (mesh.faces.rows() == 0) return {};
  constexpr int kPlaces = 100000;
  const Eigen::AlignedBox3d box = boxOf(mesh);
  const Winding winding(mesh);
  // Multiples of the powers of the root of x⁴ = x + 1, modulo 1: no pattern that thin walls and
  // grids could have in common.
  const Vec3 step(0.81917251339616443, 0.67104360670378920, 0.54970047790197026);
  int inside = 0;
  for (int i = 1; i <= kPlaces; ++i) {
    const Vec3 share = (i * step).array() - (i * step).array().floor();
    if (winding.isInside(box.min() + share.cwiseProduct(box.sizes()))) ++inside;
  }
  const double share = static_cast<double>(inside) / kPlaces;
  return {share * box.volume(), share};
}

Depth depthOf(const TriangleMesh& mesh, double least) {
  const Winding winding(mesh);
  const Triangles triangles = withArea(mesh);
  if (triangles.empty()) return {0.0, 0.0};
  const Tree tree(triangles.cbegin(), triangles.cend());

  struct Cube {
    double most;
    Vec3 middle;
    double side;
    bool operator<(const Cube& other) const { return most < other.most; }
  };
  Depth depth{0.0, 0.0};
  std::priority_queue<Cube> cubes;
  const auto add = [&](const Vec3& middle, double side) {
    const double distance = std::sqrt(tree.squared_distance({middle.x(), middle.y(), middle.z()}));
    const double reach = std::sqrt(0.75) * side; // from the middle to a corner
    const double most = distance + reach;
    if (most <= std::max(depth.atLeast, least)) {
      depth.atMost = std::max(depth.atMost, std::min(most, least));
      return;
    }
    const bool isInside = winding.isInside(middle);
    if (isInside) depth.atLeast = std::max(depth.atLeast, distance);
    // No triangle passes through it.
    if (!isInside && distance > reach) return;
    cubes.push({most, middle, side});
  };
  const Eigen::AlignedBox3d box = boxOf(mesh);
  const double first = box.sizes().maxCoeff() / 16.0;
  forCubes(box, first, [&](const Vec3& middle) { add(middle, first); });
  constexpr double kResolution = 0.02;
  constexpr int kMost = 300000;
  for (int halved = 0; !cubes.empty() && halved < kMost; ++halved) {
    const Cube cube = cubes.top();
    if (cube.most <= std::max(depth.atLeast, least) * (1.0 + kResolution)) break;
    cubes.pop();
    forHalved(cube.middle, cube.side, add);
  }
  if (!cubes.empty()) depth.atMost = std::max(depth.atMost, cubes.top().most);
  depth.atMost = std::max(depth.atMost, depth.atLeast);
  return depth;
}

std::vector<Cell> cellsDeeperThan(const TriangleMesh& mesh, double depth, double side) {
  const Winding winding(mesh);
  const Triangles triangles = withArea(mesh);
  if (triangles.empty()) return {};
  const Tree tree(triangles.cbegin(), triangles.cend());
  std::vector<Cell> cells;
  const std::function<void(const Vec3&, double)> add = [&](const Vec3& middle, double cube) {
    const double distance = std::sqrt(tree.squared_distance({middle.x(), middle.y(), middle.z()}));
    if (distance + std::sqrt(0.75) * cube < depth) return;
    if (cube > side) {
      forHalved(middle, cube, add);
    } else if (distance >= depth && winding.isInside(middle)) {
      cells.push_back({middle, cube * cube * cube, distance});
    }
  };
  const Eigen::AlignedBox3d box = boxOf(mesh);
  const double first = box.sizes().maxCoeff() / 16.0;
  forCubes(box, first, [&](const Vec3& middle) { add(middle, first); });
  return cells;
}

} // namespace massprops::testing
