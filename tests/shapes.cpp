#include "shapes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace massprops::testing {

namespace {

constexpr double pi = 3.14159265358979323846;

using Lattice = std::array<int, 3>;

/// Collects triangles whose corners are named by keys; equal keys are the same vertex.
template <class Key>
class Welder {
public:
  int vertex(const Key& key, const Vec3& point) {
    const auto [it, isNew] = index_.try_emplace(key, static_cast<int>(points_.size()));
    if (isNew) points_.push_back(point);
    return it->second;
  }
  void triangle(int a, int b, int c) { faces_.push_back({a, b, c}); }
  void quad(int a, int b, int c, int d) {
    triangle(a, b, c);
    triangle(a, c, d);
  }
  TriangleMesh mesh() const {
    TriangleMesh result;
    result.vertices.resize(static_cast<Eigen::Index>(points_.size()), 3);
    for (std::size_t i = 0; i < points_.size(); ++i)
      result.vertices.row(static_cast<Eigen::Index>(i)) = points_[i].transpose();
    result.faces.resize(static_cast<Eigen::Index>(faces_.size()), 3);
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (int k = 0; k < 3; ++k)
        result.faces(static_cast<Eigen::Index>(f), k) = faces_[f][static_cast<std::size_t>(k)];
    return result;
  }

private:
  std::map<Key, int> index_;
  std::vector<Vec3> points_;
  std::vector<std::array<int, 3>> faces_;
};

using Position = std::function<Vec3(const Lattice&)>;

/// The square at `corner` perpendicular to `axis`, seen from the side the axis points to when
/// `positive`.
void addSquare(Welder<Lattice>& welder, Lattice corner, int axis, bool positive,
               const Position& position) {
  const auto u = static_cast<std::size_t>((axis + 1) % 3);
  const auto v = static_cast<std::size_t>((axis + 2) % 3);
  std::array<int, 4> index{};
  const std::array<std::array<int, 2>, 4> steps = {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  for (std::size_t k = 0; k < 4; ++k) {
    Lattice key = corner;
    key[u] += steps[k][0];
    key[v] += steps[k][1];
    index[k] = welder.vertex(key, position(key));
  }
  if (positive)
    welder.quad(index[0], index[1], index[2], index[3]);
  else
    welder.quad(index[0], index[3], index[2], index[1]);
}

/// The boundary of an n×n×n lattice cube with the given vertex positions.
TriangleMesh latticeBox(int n, const Position& position) {
  Welder<Lattice> welder;
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j)
        for (const int side : {0, n}) {
          Lattice corner{};
          corner[static_cast<std::size_t>(axis)] = side;
          corner[static_cast<std::size_t>((axis + 1) % 3)] = i;
          corner[static_cast<std::size_t>((axis + 2) % 3)] = j;
          addSquare(welder, corner, axis, side == n, position);
        }
  return welder.mesh();
}

TriangleMesh displaced(TriangleMesh mesh, const std::function<Vec3(const Vec3&)>& map) {
  for (Eigen::Index i = 0; i < mesh.vertices.rows(); ++i) {
    const Vec3 point = mesh.vertices.row(i).transpose();
    mesh.vertices.row(i) = map(point).transpose();
  }
  return mesh;
}

} // namespace

TriangleMesh box(const Vec3& size, int n) {
  return latticeBox(n, [&](const Lattice& key) {
    const Vec3 t(key[0], key[1], key[2]);
    return Vec3(size.cwiseProduct(t / n - Vec3::Constant(0.5)));
  });
}

TriangleMesh roundedBox(const Vec3& size, double radius, int flatSegments, int arcSegments) {
  const int n = flatSegments + 2 * arcSegments;
  return latticeBox(n, [&](const Lattice& key) {
    Vec3 core;
    Vec3 beyond;
    for (int axis = 0; axis < 3; ++axis) {
      const int k = key[static_cast<std::size_t>(axis)];
      const double half = size(axis) / 2 - radius;
      const int inside = std::clamp(k - arcSegments, 0, flatSegments);
      core(axis) = -half + 2 * half * inside / flatSegments;
      beyond(axis) = std::tan(pi / 4 * (k - arcSegments - inside) / arcSegments);
    }
    return Vec3(core + radius * beyond.normalized());
  });
}

TriangleMesh tetrahedron(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  TriangleMesh mesh;
  mesh.vertices.resize(4, 3);
  mesh.vertices << a.transpose(), b.transpose(), c.transpose(), d.transpose();
  mesh.faces.resize(4, 3);
  mesh.faces << 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2;
  return mesh;
}

TriangleMesh sphere(int frequency) {
  const double golden = (1 + std::sqrt(5.0)) / 2;
  std::vector<Vec3> corners;
  for (const double s : {1.0, -1.0})
    for (const double t : {golden, -golden}) {
      corners.emplace_back(0, s, t);
      corners.emplace_back(s, t, 0);
      corners.emplace_back(t, 0, s);
    }
  // The 20 faces of an icosahedron are its triples of corners at mutual distance 2. A vertex of
  // the subdivided face is named by its integer barycentric coordinates over the 12 corners.
  using Key = std::array<std::array<int, 2>, 3>;
  Welder<Key> welder;
  const auto adjacent = [&](std::size_t i, std::size_t j) {
    return std::abs((corners[i] - corners[j]).norm() - 2) < 1e-6;
  };
  for (std::size_t i = 0; i < 12; ++i)
    for (std::size_t j = i + 1; j < 12; ++j)
      for (std::size_t k = j + 1; k < 12; ++k) {
        if (!adjacent(i, j) || !adjacent(j, k) || !adjacent(k, i)) continue;
        std::array<std::size_t, 3> c = {i, j, k};
        if (corners[i].dot(corners[j].cross(corners[k])) < 0) std::swap(c[1], c[2]);
        const auto vertex = [&](int p, int q) {
          const std::array<int, 3> weight = {frequency - p - q, p, q};
          std::vector<std::array<int, 2>> parts;
          for (std::size_t m = 0; m < 3; ++m)
            if (weight[m] > 0) parts.push_back({static_cast<int>(c[m]), weight[m]});
          std::sort(parts.begin(), parts.end());
          Key key{};
          Vec3 point = Vec3::Zero();
          for (std::size_t m = 0; m < parts.size(); ++m) {
            key[m] = parts[m];
            point += parts[m][1] * corners[static_cast<std::size_t>(parts[m][0])];
          }
          return welder.vertex(key, point.normalized());
        };
        for (int p = 0; p < frequency; ++p)
          for (int q = 0; p + q < frequency; ++q) {
            welder.triangle(vertex(p, q), vertex(p + 1, q), vertex(p, q + 1));
            if (p + q + 1 < frequency)
              welder.triangle(vertex(p + 1, q), vertex(p + 1, q + 1), vertex(p, q + 1));
          }
      }
  return welder.mesh();
}

TriangleMesh ellipsoid(const Vec3& radii, int frequency) {
  return transformed(sphere(frequency), radii.asDiagonal());
}

TriangleMesh starShaped(const std::function<double(const Vec3&)>& radius, int frequency) {
  return displaced(sphere(frequency), [&](const Vec3& u) { return Vec3(radius(u) * u); });
}

TriangleMesh blob(int frequency) {
  return starShaped(
      [](const Vec3& u) {
        return 1.0 + 0.25 * u.x() * u.z() + 0.15 * u.y() * u.y() * u.y() - 0.1 * u.x() * u.y() +
               0.05 * std::sin(3 * u.z() + 1);
      },
      frequency);
}

TriangleMesh leaningTop(double tilt, int frequency) {
  const Mat3 toBody = rotation(Vec3::UnitY(), -tilt);
  const Vec3 radii(1.0, 0.8, 0.6);
  return starShaped(
      [&](const Vec3& u) {
        const double body = 1 / (toBody * u).cwiseQuotient(radii).norm();
        const double angle = std::acos(std::clamp(-u.z(), -1.0, 1.0));
        return body + 0.6 * std::exp(-std::pow(angle / 0.25, 2));
      },
      frequency);
}

TriangleMesh torus(double ring, double tube, int ringSegments, int tubeSegments) {
  Welder<std::array<int, 2>> welder;
  const auto vertex = [&](int i, int j) {
    const double u = 2 * pi * (i % ringSegments) / ringSegments;
    const double v = 2 * pi * (j % tubeSegments) / tubeSegments;
    const double radius = ring + tube * std::cos(v);
    return welder.vertex({i % ringSegments, j % tubeSegments},
                         {radius * std::cos(u), radius * std::sin(u), tube * std::sin(v)});
  };
  for (int i = 0; i < ringSegments; ++i)
    for (int j = 0; j < tubeSegments; ++j)
      welder.quad(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1));
  return welder.mesh();
}

TriangleMesh revolved(const std::vector<Vec2>& profile, int segments) {
  Welder<std::array<int, 2>> welder;
  const int last = static_cast<int>(profile.size()) - 1;
  const auto vertex = [&](int i, int j) {
    const bool pole = i == 0 || i == last;
    const int k = pole ? 0 : j % segments;
    const double angle = 2 * pi * k / segments;
    const Vec2& p = profile[static_cast<std::size_t>(i)];
    return welder.vertex({i, k}, {p.x() * std::cos(angle), p.x() * std::sin(angle), p.y()});
  };
  for (int j = 0; j < segments; ++j) {
    welder.triangle(vertex(0, 0), vertex(1, j), vertex(1, j + 1));
    for (int i = 1; i < last - 1; ++i)
      welder.quad(vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1));
    welder.triangle(vertex(last - 1, j), vertex(last, 0), vertex(last - 1, j + 1));
  }
  return welder.mesh();
}

TriangleMesh capsule(double radius, double length, int segments) {
  std::vector<Vec2> profile;
  const int arc = std::max(2, segments / 4);
  for (int i = 0; i <= arc; ++i) {
    const double angle = pi / 2 * i / arc;
    profile.emplace_back(i == 0 ? 0 : radius * std::sin(angle),
                         length / 2 + radius * std::cos(angle));
  }
  const int middle =
      std::max(1, static_cast<int>(std::lround(length * segments / (2 * pi * radius))));
  for (int i = 1; i < middle; ++i) profile.emplace_back(radius, length / 2 - length * i / middle);
  for (int i = arc; i >= 0; --i) {
    const Vec2& mirrored = profile[static_cast<std::size_t>(i)];
    profile.emplace_back(mirrored.x(), -mirrored.y());
  }
  return revolved(profile, segments);
}

TriangleMesh polycube(const std::vector<std::array<int, 3>>& cells, int n) {
  const std::set<Lattice> filled(cells.begin(), cells.end());
  Welder<Lattice> welder;
  const Position position = [&](const Lattice& key) {
    return Vec3(Vec3(key[0], key[1], key[2]) / n);
  };
  for (const Lattice& cell : cells)
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {0, 1}) {
        const auto a = static_cast<std::size_t>(axis);
        const auto u = static_cast<std::size_t>((axis + 1) % 3);
        const auto v = static_cast<std::size_t>((axis + 2) % 3);
        Lattice neighbour = cell;
        neighbour[a] += side == 1 ? 1 : -1;
        if (filled.count(neighbour) > 0) continue;
        for (int i = 0; i < n; ++i)
          for (int j = 0; j < n; ++j) {
            Lattice corner = {n * cell[0], n * cell[1], n * cell[2]};
            corner[a] += side * n;
            corner[u] += i;
            corner[v] += j;
            addSquare(welder, corner, axis, side == 1, position);
          }
      }
  return welder.mesh();
}

namespace {

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Triangles of a counter-clockwise polygon by cutting ears off.
std::vector<std::array<int, 3>> earsOf(const std::vector<Vec2>& outline) {
  std::vector<int> left(outline.size());
  std::iota(left.begin(), left.end(), 0);
  const auto at = [&](int v) { return outline[static_cast<std::size_t>(v)]; };
  const auto isEar = [&](int a, int b, int c) {
    const auto turn = [&](int p, int q, int r) { return cross(at(q) - at(p), at(r) - at(p)); };
    if (turn(a, b, c) <= 0.0) return false;
    return std::none_of(left.begin(), left.end(), [&](int v) {
      return v != a && v != b && v != c && turn(a, b, v) >= 0.0 && turn(b, c, v) >= 0.0 &&
             turn(c, a, v) >= 0.0;
    });
  };
  std::vector<std::array<int, 3>> triangles;
  for (std::size_t i = 0; left.size() > 2; ++i) {
    const std::size_t n = left.size();
    const std::array<int, 3> ear{left[i % n], left[(i + 1) % n], left[(i + 2) % n]};
    if (!isEar(ear[0], ear[1], ear[2])) continue;
    triangles.push_back(ear);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>((i + 1) % n));
  }
  return triangles;
}

} // namespace

TriangleMesh prism(const std::vector<Vec2>& outline, double height) {
  const auto n = static_cast<int>(outline.size());
  Welder<int> welder;
  for (int v = 0; v < n; ++v) {
    const Vec2& p = outline[static_cast<std::size_t>(v)];
    welder.vertex(v, {p.x(), p.y(), 0.0});
  }
  for (int v = 0; v < n; ++v) {
    const Vec2& p = outline[static_cast<std::size_t>(v)];
    welder.vertex(n + v, {p.x(), p.y(), height});
  }
  for (int v = 0; v < n; ++v) welder.quad(v, (v + 1) % n, n + (v + 1) % n, n + v);
  for (const auto& [a, b, c] : earsOf(outline)) {
    welder.triangle(n + a, n + b, n + c);
    welder.triangle(a, c, b);
  }
  return welder.mesh();
}

TriangleMesh bracket(int arc) {
  std::vector<Vec2> outline = {{0, 0}, {10, 0}, {10, 1}};
  const Vec2 centre(3, 3);
  for (int i = 0; i <= arc; ++i) {
    const double angle = 0.5 * pi * i / arc;
    outline.emplace_back(centre - 2.0 * Vec2(std::sin(angle), std::cos(angle)));
  }
  outline.emplace_back(1, 6);
  outline.emplace_back(0, 6);
  // Its profile stands upright.
  Mat3 upright;
  upright << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  return transformed(prism(outline, 5.0), upright);
}

TriangleMesh figure(int n) {
  std::vector<Lattice> cells;
  const auto fill = [&](Lattice from, Lattice to) {
    for (int x = from[0]; x <= to[0]; ++x)
      for (int y = from[1]; y <= to[1]; ++y)
        for (int z = from[2]; z <= to[2]; ++z) cells.push_back({x, y, z});
  };
  fill({0, 0, 0}, {1, 1, 2});   // right leg
  fill({0, 3, 0}, {1, 4, 2});   // left leg
  fill({0, 0, 3}, {2, 4, 6});   // body
  fill({1, -2, 5}, {1, -1, 5}); // arms
  fill({1, 5, 5}, {1, 6, 5});
  fill({1, 1, 7}, {3, 3, 9}); // head
  const double foot = 0.25;
  return displaced(smoothed(polycube(cells, n), 2 * n * n),
                   [&](const Vec3& p) { return Vec3(p.x(), p.y(), std::max(p.z() - foot, 0.0)); });
}

TriangleMesh smoothed(const TriangleMesh& mesh, int iterations) {
  TriangleMesh result = mesh;
  for (int round = 0; round < iterations; ++round) {
    Points sum = Points::Zero(mesh.vertices.rows(), 3);
    Vector degree = Vector::Zero(mesh.vertices.rows());
    // Every edge of a closed surface is seen once in each direction.
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f)
      for (int k = 0; k < 3; ++k) {
        const int i = mesh.faces(f, k);
        sum.row(i) += result.vertices.row(mesh.faces(f, (k + 1) % 3));
        degree(i) += 1;
      }
    for (Eigen::Index i = 0; i < sum.rows(); ++i)
      result.vertices.row(i) = 0.5 * (result.vertices.row(i) + sum.row(i) / degree(i));
  }
  return result;
}

TriangleMesh jittered(const TriangleMesh& mesh, double amplitude, std::uint32_t seed) {
  Random random(seed);
  return displaced(mesh, [&](const Vec3& p) { return Vec3(p + amplitude * random.vector()); });
}

TriangleMesh transformed(const TriangleMesh& mesh, const Mat3& linear, const Vec3& translation) {
  return displaced(mesh, [&](const Vec3& p) { return Vec3(linear * p + translation); });
}

TriangleMesh shifted(const TriangleMesh& mesh, const Vec3& by) {
  return transformed(mesh, Mat3::Identity(), by);
}

TriangleMesh unwelded(const TriangleMesh& mesh) {
  TriangleMesh result{Points(mesh.faces.size(), 3), mesh.faces};
  for (Eigen::Index i = 0; i < mesh.faces.size(); ++i) {
    result.vertices.row(i) = mesh.vertices.row(mesh.faces.data()[i]);
    result.faces.data()[i] = static_cast<int>(i);
  }
  return result;
}

TriangleMesh scaled(const TriangleMesh& mesh, double factor) {
  return transformed(mesh, factor * Mat3::Identity());
}

Mat3 rotation(const Vec3& axis, double radians) {
  return Eigen::AngleAxisd(radians, axis.normalized()).toRotationMatrix();
}

Mat3 someRotation() {
  return rotation({1.0, -2.0, 0.7}, 1.1);
}

Mat3 shear(double slope) {
  Mat3 result = Mat3::Identity();
  result(0, 2) = slope;
  return result;
}

TriangleMesh subdivided(const TriangleMesh& mesh) {
  std::map<std::pair<int, int>, int> middles;
  std::vector<Eigen::RowVector3d> added;
  const auto middle = [&](int a, int b) {
    const auto [at, isNew] = middles.try_emplace(
        std::minmax(a, b), static_cast<int>(mesh.vertices.rows()) + static_cast<int>(added.size()));
    if (isNew) added.emplace_back(0.5 * (mesh.vertices.row(a) + mesh.vertices.row(b)));
    return at->second;
  };
  TriangleMesh result{{}, Faces(4 * mesh.faces.rows(), 3)};
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    const Eigen::RowVector3i v = mesh.faces.row(f);
    const Eigen::RowVector3i m(middle(v[0], v[1]), middle(v[1], v[2]), middle(v[2], v[0]));
    result.faces.row(4 * f) << v[0], m[0], m[2];
    result.faces.row(4 * f + 1) << m[0], v[1], m[1];
    result.faces.row(4 * f + 2) << m[2], m[1], v[2];
    result.faces.row(4 * f + 3) = m;
  }
  result.vertices.resize(mesh.vertices.rows() + static_cast<Eigen::Index>(added.size()), 3);
  result.vertices.topRows(mesh.vertices.rows()) = mesh.vertices;
  for (std::size_t i = 0; i < added.size(); ++i) {
    result.vertices.row(mesh.vertices.rows() + static_cast<Eigen::Index>(i)) = added[i];
  }
  return result;
}

TriangleMesh reversed(const TriangleMesh& mesh) {
  TriangleMesh result = mesh;
  result.faces.col(1).swap(result.faces.col(2));
  return result;
}

TriangleMesh unevenlyCut(const TriangleMesh& mesh, int times) {
  const double middle = 0.5 * (mesh.vertices.col(0).minCoeff() + mesh.vertices.col(0).maxCoeff());
  Welder<int> welder;
  const auto n = static_cast<int>(mesh.vertices.rows());
  for (int v = 0; v < n; ++v) welder.vertex(v, mesh.vertices.row(v).transpose());
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    const Eigen::RowVector3i corners = mesh.faces.row(f);
    const Vec3 centroid = mesh.vertices(corners, Eigen::all).colwise().mean().transpose();
    if (centroid.x() > middle) {
      welder.triangle(corners[0], corners[1], corners[2]);
      continue;
    }
    const int c = welder.vertex(n + static_cast<int>(f), centroid);
    for (int k = 0; k < 3; ++k) welder.triangle(corners[k], corners[(k + 1) % 3], c);
  }
  return times > 1 ? unevenlyCut(welder.mesh(), times - 1) : welder.mesh();
}

TriangleMesh joined(const TriangleMesh& a, const TriangleMesh& b) {
  TriangleMesh result;
  result.vertices.resize(a.vertices.rows() + b.vertices.rows(), 3);
  result.vertices << a.vertices, b.vertices;
  result.faces.resize(a.faces.rows() + b.faces.rows(), 3);
  result.faces << a.faces, (b.faces.array() + static_cast<int>(a.vertices.rows())).matrix();
  return result;
}

double Random::operator()() {
  // The constants of Knuth's MMIX generator; the high 32 bits are good.
  state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
  return static_cast<double>(state_ >> 32) / 2147483647.5 - 1.0;
}

Vec3 Random::vector() {
  const double x = (*this)();
  const double y = (*this)();
  const double z = (*this)();
  return {x, y, z};
}

Vector Random::vector(Eigen::Index size) {
  Vector result(size);
  for (Eigen::Index i = 0; i < size; ++i) result(i) = (*this)();
  return result;
}

} // namespace massprops::testing
