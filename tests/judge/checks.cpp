#include "judge/checks.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace massprops::testing {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Triangle = Kernel::Triangle_3;
using Box = CGAL::Box_intersection_d::Box_with_info_d<double, 3, Eigen::Index>;

constexpr double kPi = 3.14159265358979323846;

Vec3 corner(const TriangleMesh& mesh, Eigen::Index face, int k) {
  return mesh.vertices.row(mesh.faces(face, k)).transpose();
}

Point exact(const TriangleMesh& mesh, int vertex) {
  return {mesh.vertices(vertex, 0), mesh.vertices(vertex, 1), mesh.vertices(vertex, 2)};
}

Triangle triangle(const TriangleMesh& mesh, Eigen::Index f) {
  return {exact(mesh, mesh.faces(f, 0)), exact(mesh, mesh.faces(f, 1)),
          exact(mesh, mesh.faces(f, 2))};
}

std::vector<Box> boxes(const TriangleMesh& mesh) {
  std::vector<Box> result;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
    result.emplace_back(triangle(mesh, f).bbox(), f);
  return result;
}

/// Whether two triangles of one mesh meet elsewhere than in what they share.
bool meet(const TriangleMesh& mesh, Eigen::Index f, Eigen::Index g) {
  std::vector<int> shared;
  std::vector<int> onlyF;
  std::vector<int> onlyG;
  for (const int v : mesh.faces.row(f)) {
    const bool both = (mesh.faces.row(g).array() == v).any();
    (both ? shared : onlyF).push_back(v);
  }
  for (const int v : mesh.faces.row(g)) {
    if (std::find(shared.begin(), shared.end(), v) == shared.end()) onlyG.push_back(v);
  }
  switch (shared.size()) {
  case 0:
    return CGAL::do_intersect(triangle(mesh, f), triangle(mesh, g));
  case 1:
    // Beyond the shared corner, an opposite edge must reach the other triangle.
    return CGAL::do_intersect(Kernel::Segment_3(exact(mesh, onlyF[0]), exact(mesh, onlyF[1])),
                              triangle(mesh, g)) ||
           CGAL::do_intersect(Kernel::Segment_3(exact(mesh, onlyG[0]), exact(mesh, onlyG[1])),
                              triangle(mesh, f));
  case 2: {
    // Two triangles at one edge overlap if they are coplanar and on the same side of it.
    const Point p = exact(mesh, shared[0]);
    const Point q = exact(mesh, shared[1]);
    const Point r = exact(mesh, onlyF[0]);
    const Point s = exact(mesh, onlyG[0]);
    return CGAL::coplanar(p, q, r, s) && CGAL::coplanar_orientation(p, q, r, s) == CGAL::POSITIVE;
  }
  default:
    return true; // the same triangle twice
  }
}

std::map<std::pair<int, int>, int> directedEdges(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, int> edges;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
    for (int k = 0; k < 3; ++k) ++edges[{mesh.faces(f, k), mesh.faces(f, (k + 1) % 3)}];
  return edges;
}

} // namespace

bool isClosedAndOriented(const TriangleMesh& mesh) {
  const auto edges = directedEdges(mesh);
  std::set<int> used;
  for (const auto& [edge, count] : edges) {
    if (count != 1 || edges.count({edge.second, edge.first}) == 0) return false;
    used.insert(edge.first);
  }
  return static_cast<Eigen::Index>(used.size()) == mesh.vertices.rows();
}

long eulerCharacteristic(const TriangleMesh& mesh) {
  return static_cast<long>(mesh.vertices.rows()) -
         static_cast<long>(directedEdges(mesh).size()) / 2 + static_cast<long>(mesh.faces.rows());
}

double shareOfSharpEdges(const TriangleMesh& mesh, double degrees) {
  std::map<std::pair<int, int>, Vec3> normalAt;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    const Vec3 normal = (corner(mesh, f, 1) - corner(mesh, f, 0))
                            .cross(corner(mesh, f, 2) - corner(mesh, f, 0))
                            .normalized();
    for (int k = 0; k < 3; ++k) normalAt[{mesh.faces(f, k), mesh.faces(f, (k + 1) % 3)}] = normal;
  }
  const double cosine = std::cos(degrees * kPi / 180.0);
  std::size_t sharp = 0;
  for (const auto& [edge, normal] : normalAt) {
    if (normal.dot(normalAt.at({edge.second, edge.first})) < cosine) ++sharp;
  }
  return normalAt.empty() ? 0.0 : static_cast<double>(sharp) / static_cast<double>(normalAt.size());
}

std::size_t facesWithoutArea(const TriangleMesh& mesh) {
  std::size_t count = 0;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    if (CGAL::collinear(exact(mesh, mesh.faces(f, 0)), exact(mesh, mesh.faces(f, 1)),
                        exact(mesh, mesh.faces(f, 2))))
      ++count;
  }
  return count;
}

std::size_t intersectingPairs(const TriangleMesh& mesh) {
  std::size_t pairs = 0;
  std::vector<Box> all = boxes(mesh);
  CGAL::box_self_intersection_d(all.begin(), all.end(), [&](const Box& a, const Box& b) {
    if (meet(mesh, a.info(), b.info())) ++pairs;
  });
  return pairs;
}

std::size_t intersectingPairs(const TriangleMesh& a, const TriangleMesh& b) {
  std::size_t pairs = 0;
  std::vector<Box> ofA = boxes(a);
  std::vector<Box> ofB = boxes(b);
  CGAL::box_intersection_d(ofA.begin(), ofA.end(), ofB.begin(), ofB.end(),
                           [&](const Box& p, const Box& q) {
                             if (CGAL::do_intersect(triangle(a, p.info()), triangle(b, q.info())))
                               ++pairs;
                           });
  return pairs;
}

double windingNumber(const TriangleMesh& mesh, const Vec3& point) {
  // tan(Ω/2) = a·(b×c) / (abc + (a·b)c + (b·c)a + (c·a)b)
  double sum = 0.0;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    const Vec3 a = corner(mesh, f, 0) - point;
    const Vec3 b = corner(mesh, f, 1) - point;
    const Vec3 c = corner(mesh, f, 2) - point;
    const double la = a.norm();
    const double lb = b.norm();
    const double lc = c.norm();
    sum += 2 * std::atan2(a.dot(b.cross(c)),
                          la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4 * kPi);
}

bool isInside(const TriangleMesh& inner, const TriangleMesh& outer) {
  for (Eigen::Index v = 0; v < inner.vertices.rows(); ++v) {
    if (std::abs(windingNumber(outer, inner.vertices.row(v).transpose()) - 1.0) > 1e-6)
      return false;
  }
  return true;
}

double leastDistance(const TriangleMesh& a, const TriangleMesh& b) {
  double least = std::numeric_limits<double>::infinity();
  std::vector<CGAL::Bbox_3> boxesOfB;
  std::vector<Triangle> trianglesOfB;
  for (Eigen::Index g = 0; g < b.faces.rows(); ++g) {
    trianglesOfB.push_back(triangle(b, g));
    boxesOfB.push_back(trianglesOfB.back().bbox());
  }
  for (Eigen::Index f = 0; f < a.faces.rows(); ++f) {
    const Triangle t = triangle(a, f);
    const CGAL::Bbox_3 box = t.bbox();
    for (std::size_t g = 0; g < trianglesOfB.size(); ++g) {
      double apart = 0.0;
      for (int axis = 0; axis < 3; ++axis) {
        const double gap = std::max(
            {0.0, box.min(axis) - boxesOfB[g].max(axis), boxesOfB[g].min(axis) - box.max(axis)});
        apart += gap * gap;
      }
      if (apart >= least * least) continue;
      least = std::min(least, std::sqrt(CGAL::squared_distance(t, trianglesOfB[g])));
    }
  }
  return least;
}

Eigen::Matrix<double, 10, 1> quadratureMoments(const TriangleMesh& mesh) {
  // ∫∂F/∂x dV = ∫F n_x dA with F = x, x²/2, …: polynomials of degree ≤ 3 on the triangles, for
  // which the six-point rule of degree 4 (Strang–Fix) is exact.
  constexpr double a1 = 0.445948490915965;
  constexpr double w1 = 0.223381589678011;
  constexpr double a2 = 0.091576213509771;
  constexpr double w2 = 0.109951743655322;
  Eigen::Matrix<double, 10, 1> sum = Eigen::Matrix<double, 10, 1>::Zero();
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    const std::array<Vec3, 3> p = {corner(mesh, f, 0), corner(mesh, f, 1), corner(mesh, f, 2)};
    const Vec3 areaNormal = 0.5 * (p[1] - p[0]).cross(p[2] - p[0]);
    for (const auto& [a, w] : {std::pair<double, double>{a1, w1}, {a2, w2}}) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 q = (1 - 2 * a) * p[k] + a * (p[(k + 1) % 3] + p[(k + 2) % 3]);
        const Vec3 n = w * areaNormal;
        sum[0] += q.x() * n.x();
        for (int i = 0; i < 3; ++i) {
          const int j = (i + 1) % 3;
          sum[1 + i] += q[i] * q[i] / 2 * n[i];
          sum[4 + i] += q[i] * q[i] * q[i] / 3 * n[i];
          sum[7 + i] += q[i] * q[i] / 2 * q[j] * n[i];
        }
      }
    }
  }
  return sum;
}

Eigen::Vector4d momentsOfColumns(const TriangleMesh& mesh, const Vec3& up, double level) {
  Eigen::Vector4d sum = Eigen::Vector4d::Zero();
  // A column over p that is h high: h and ∫x = p h + up h²/2, quadratic over a triangle, for which
  // the rule of the edges' middles is exact. Triangles that face downwards count positive.
  const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
    const double area = -0.5 * up.dot((b - a).cross(c - a));
    for (const Vec3& p : {Vec3(0.5 * (a + b)), Vec3(0.5 * (b + c)), Vec3(0.5 * (c + a))}) {
      const double h = level - up.dot(p);
      sum[0] += area / 3 * h;
      sum.tail<3>() += area / 3 * (h * p + 0.5 * h * h * up);
    }
  };
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    std::vector<Vec3> below;
    for (int k = 0; k < 3; ++k) {
      const Vec3 p = corner(mesh, f, k);
      const Vec3 q = corner(mesh, f, (k + 1) % 3);
      const double hp = up.dot(p) - level;
      const double hq = up.dot(q) - level;
      if (hp <= 0) below.push_back(p);
      if ((hp < 0 && hq > 0) || (hp > 0 && hq < 0)) below.push_back(p + hp / (hp - hq) * (q - p));
    }
    for (std::size_t i = 2; i < below.size(); ++i) add(below[0], below[i - 1], below[i]);
  }
  return sum;
}

Body bodyOf(const Eigen::Matrix<double, 10, 1>& m) {
  Body body;
  body.mass = m[0];
  body.centre = m.segment<3>(1) / m[0];
  const Vec3 c = body.centre;
  // Steiner's theorem, axis by axis.
  const double xx = m[4] - m[0] * c.x() * c.x();
  const double yy = m[5] - m[0] * c.y() * c.y();
  const double zz = m[6] - m[0] * c.z() * c.z();
  const double xy = m[7] - m[0] * c.x() * c.y();
  const double yz = m[8] - m[0] * c.y() * c.z();
  const double zx = m[9] - m[0] * c.z() * c.x();
  body.inertia << yy + zz, -xy, -zx, -xy, zz + xx, -yz, -zx, -yz, xx + yy;
  return body;
}

} // namespace massprops::testing
