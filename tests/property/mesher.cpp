#include "property/mesher.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

namespace massprops::testing {
namespace {

using Lattice = std::array<int, 3>;

struct Marcher {
  std::vector<Vec3> vertices;
  std::vector<std::array<int, 3>> faces;
  std::map<std::pair<Lattice, Lattice>, int> onEdge;

  struct Corner {
    Lattice key;
    Vec3 point;
    double value;
  };

  int cut(const Corner& a, const Corner& b) {
    const auto key = std::minmax(a.key, b.key);
    const auto [it, isNew] = onEdge.try_emplace(key, static_cast<int>(vertices.size()));
    // Kept off the corners, where the cuts of several edges would coincide.
    const double t = std::clamp(a.value / (a.value - b.value), 0.02, 0.98);
    if (isNew) vertices.push_back(a.point + t * (b.point - a.point));
    return it->second;
  }

  void triangle(int a, int b, int c, const Vec3& inside) {
    const Vec3 pa = vertices[static_cast<std::size_t>(a)];
    const Vec3 normal = (vertices[static_cast<std::size_t>(b)] - pa)
                            .cross(vertices[static_cast<std::size_t>(c)] - pa);
    if (normal.dot(pa - inside) < 0) std::swap(b, c);
    faces.push_back({a, b, c});
  }

  void tetrahedron(const std::array<Corner, 4>& corners) {
    std::vector<Corner> in;
    std::vector<Corner> out;
    for (const Corner& corner : corners) (corner.value < 0 ? in : out).push_back(corner);
    if (in.empty() || out.empty()) return;
    const Vec3 inside = in[0].point;
    if (in.size() == 2) {
      const std::array<int, 4> ring = {cut(in[0], out[0]), cut(in[0], out[1]), cut(in[1], out[1]),
                                       cut(in[1], out[0])};
      triangle(ring[0], ring[1], ring[2], inside);
      triangle(ring[0], ring[2], ring[3], inside);
      return;
    }
    const Corner& apex = in.size() == 1 ? in[0] : out[0];
    const std::vector<Corner>& base = in.size() == 1 ? out : in;
    triangle(cut(apex, base[0]), cut(apex, base[1]), cut(apex, base[2]), inside);
  }

  TriangleMesh mesh() const {
    TriangleMesh result;
    result.vertices.resize(static_cast<Eigen::Index>(vertices.size()), 3);
    result.faces.resize(static_cast<Eigen::Index>(faces.size()), 3);
    for (std::size_t v = 0; v < vertices.size(); ++v)
      result.vertices.row(static_cast<Eigen::Index>(v)) = vertices[v].transpose();
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (int k = 0; k < 3; ++k)
        result.faces(static_cast<Eigen::Index>(f), k) = faces[f][static_cast<std::size_t>(k)];
    return result;
  }
};

Vec3 gradient(const Implicit& solid, const Vec3& p, double h) {
  Vec3 g;
  for (int axis = 0; axis < 3; ++axis)
    g[axis] = (solid(p + h * Vec3::Unit(axis)) - solid(p - h * Vec3::Unit(axis))) / (2 * h);
  return g;
}

void relax(TriangleMesh& mesh, const Implicit& solid, double step) {
  Points sum = Points::Zero(mesh.vertices.rows(), 3);
  Vector degree = Vector::Zero(mesh.vertices.rows());
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
    for (int k = 0; k < 3; ++k) {
      sum.row(mesh.faces(f, k)) += mesh.vertices.row(mesh.faces(f, (k + 1) % 3));
      degree[mesh.faces(f, k)] += 1;
    }
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    Vec3 p = (0.5 * (mesh.vertices.row(v) + sum.row(v) / degree[v])).transpose();
    const Vec3 g = gradient(solid, p, 1e-3 * step);
    const Vec3 back = -solid(p) * g / std::max(g.squaredNorm(), 0.1);
    p += back.normalized() * std::min(back.norm(), 0.5 * step);
    mesh.vertices.row(v) = p.transpose();
  }
}

} // namespace

double smoothMinimum(double a, double b, double blend) {
  const double h = std::max(blend - std::abs(a - b), 0.0) / blend;
  return std::min(a, b) - h * h * h * blend / 6;
}

double capsuleDistance(const Vec3& p, const Vec3& a, const Vec3& b, double ra, double rb) {
  const Vec3 axis = b - a;
  const double t = std::clamp((p - a).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
  return (p - a - t * axis).norm() - (ra + t * (rb - ra));
}

double torusDistance(const Vec3& p, const Vec3& centre, const Vec3& axis, double ring,
                     double tube) {
  const double along = (p - centre).dot(axis);
  const double across = (p - centre - along * axis).norm() - ring;
  return std::hypot(along, across) - tube;
}

double roundedBoxDistance(const Vec3& p, const Vec3& half, double radius) {
  const Vec3 q = p.cwiseAbs() - half + Vec3::Constant(radius);
  return q.cwiseMax(0.0).norm() + std::min(q.maxCoeff(), 0.0) - radius;
}

TriangleMesh implicitMesh(const Implicit& solid, const Vec3& lower, const Vec3& upper, double step,
                          int relaxations) {
  const Eigen::Vector3i cells = ((upper - lower) / step).array().ceil().cast<int>();
  const auto corner = [&](int i, int j, int k) {
    const Vec3 point = lower + step * Vec3(i, j, k);
    const bool border =
        i == 0 || j == 0 || k == 0 || i == cells[0] || j == cells[1] || k == cells[2];
    return Marcher::Corner{{i, j, k}, point, border ? step : solid(point)};
  };
  Marcher marcher;
  // Six tetrahedra around the main diagonal of every cube: one for each order of the axes.
  constexpr int orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  for (int i = 0; i < cells[0]; ++i)
    for (int j = 0; j < cells[1]; ++j)
      for (int k = 0; k < cells[2]; ++k) {
        std::array<Marcher::Corner, 8> cube;
        int inside = 0;
        for (int c = 0; c < 8; ++c) {
          cube[static_cast<std::size_t>(c)] = corner(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
          if (cube[static_cast<std::size_t>(c)].value < 0) ++inside;
        }
        if (inside == 0 || inside == 8) continue;
        for (const auto& order : orders) {
          const auto first = static_cast<std::size_t>(1 << order[0]);
          const std::size_t second = first + static_cast<std::size_t>(1 << order[1]);
          marcher.tetrahedron({cube[0], cube[first], cube[second], cube[7]});
        }
      }
  TriangleMesh mesh = marcher.mesh();
  for (int round = 0; round < relaxations; ++round) relax(mesh, solid, step);
  return mesh;
}

} // namespace massprops::testing
