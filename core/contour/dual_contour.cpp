#include "core/contour/dual_contour.h"

#include "core/base/parallel.h"
#include "core/base/symmetric_eigen.h"
#include "core/base/triangle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace massprops {
namespace {

constexpr double kAlmostAll = 0.98; // of an edge

/// Where the border crosses an edge: a share of it, beyond 1 where it does not, and the slope
/// there.
struct Root {
  double t = std::numeric_limits<double>::infinity();
  Vec3 slope = Vec3::Zero();
};

/// The zero of the cubic with these values and slopes at 0 and 1. \pre values > 0 and ≤ 0
double hermiteRoot(double value0, double slope0, double value1, double slope1) {
  const auto cubic = [&](double t) {
    const double u = 1.0 - t;
    return u * u * ((1.0 + 2.0 * t) * value0 + t * slope0) +
           t * t * ((3.0 - 2.0 * t) * value1 - u * slope1);
  };
  double low = 0.0;
  double high = 1.0;
  double t = value0 / (value0 - value1);
  constexpr int kSteps = 12;
  for (int i = 0; i < kSteps; ++i) {
    (cubic(t) > 0.0 ? low : high) = t;
    const double atLow = cubic(low);
    t = low + (high - low) * std::clamp(atLow / (atLow - cubic(high)), 0.05, 0.95);
  }
  return t;
}

/// Along the edge from a sample inside to one outside. Where their slopes differ much and each
/// plane lies above the function's value at the other end, the function is the lesser of two.
Root rootBetween(const Sample& inside, const Sample& outside, const Vec3& way) {
  constexpr double kSmooth = 0.85;
  constexpr double kSlack = 0.02;
  const double slack = kSlack * way.norm();
  const double slope0 = inside.slope.dot(way);
  const double slope1 = outside.slope.dot(way);
  const double outsidePlane = outside.value - slope1;
  const bool isKink = inside.slope.dot(outside.slope) < kSmooth &&
                      outsidePlane > inside.value - slack &&
                      inside.value + slope0 > outside.value - slack;
  if (isKink) {
    const double t0 = slope0 < 0.0 ? -inside.value / slope0 : 2.0;
    const double t1 = slope1 < 0.0 ? std::max(-outsidePlane / slope1, 0.0) : 2.0;
    if (std::min(t0, t1) <= 1.0) {
      return t0 < t1 ? Root{t0, inside.slope} : Root{t1, outside.slope};
    }
  }
  const double t = hermiteRoot(inside.value, slope0, outside.value, slope1);
  return {t, ((1.0 - t) * inside.slope + t * outside.slope).normalized()};
}

/// The point that is nearest to planes, and to their middle where they leave it free.
class PlaneFit {
public:
  void addPoint(const Vec3& x) {
    sum_ += x;
    ++points_;
  }
  void addPlane(const Vec3& x, const Vec3& normal) { planes_[planeCount_++] = {x, normal}; }

  Vec3 nearest() const {
    const Vec3 middle = sum_ / points_;
    Mat3 normals = Mat3::Zero();
    Vec3 distances = Vec3::Zero();
    for (std::size_t i = 0; i < planeCount_; ++i) {
      const auto& [x, normal] = planes_[i];
      normals += normal * normal.transpose();
      distances += normal.dot(x - middle) * normal;
    }
    const SymmetricEigen<Mat3> fit = symmetricEigen(normals);
    constexpr double kFlat = 0.05; // of the largest eigenvalue: the planes are one
    Vec3 result = middle;
    for (int k = 0; k < 3; ++k) {
      if (!(fit.values[k] > kFlat * fit.values[2])) continue;
      result += fit.vectors.col(k) * (fit.vectors.col(k).dot(distances) / fit.values[k]);
    }
    return result;
  }

private:
  struct Plane {
    Vec3 x, normal;
  };
  std::array<Plane, 12> planes_; ///< an edge of a cube each
  std::size_t planeCount_ = 0;
  Vec3 sum_ = Vec3::Zero();
  int points_ = 0;
};

class DualContouring {
public:
  explicit DualContouring(const BorderLattice& lattice) : lattice_(lattice) {
    const std::size_t count = lattice.cubes().size();
    isCut_.resize(count);
    for (std::size_t c = 0; c < count; ++c) {
      const unsigned inside = lattice.cornersInside(static_cast<int>(c));
      isCut_[c] = inside != 0 && inside != 255;
    }
    contour_.mesh.vertices.setZero(static_cast<Eigen::Index>(count), 3);
    contour_.on.resize(count, On::Wall);
  }

  void placeVertices() {
    constexpr Eigen::Index kRun = 1024;
    forChunks(static_cast<Eigen::Index>(isCut_.size()), kRun, [&](const Chunk& chunk) {
      for (auto c = static_cast<int>(chunk.begin); c < chunk.end; ++c) {
        if (isCut_[at(c)]) placeVertex(c);
      }
    });
  }

  void connect() {
    contour_.mesh.faces.resize(2 * crossedEdges(), 3);
    forCrossedEdges([&](std::size_t cube, int axis) { connectAround(cube, axis); });
    Points& vertices = contour_.mesh.vertices;
    const Eigen::Index n = vertices.rows();
    const auto count = static_cast<Eigen::Index>(onEdges_.size());
    vertices.conservativeResize(n + count, 3);
    for (Eigen::Index i = 0; i < count; ++i) {
      vertices.row(n + i) = onEdges_[static_cast<std::size_t>(i)].transpose();
    }
    const auto inFans = static_cast<Eigen::Index>(fans_.size()) / 3;
    contour_.mesh.faces.conservativeResize(connected_ + inFans, 3);
    contour_.mesh.faces.bottomRows(inFans) = Eigen::Map<const Faces>(fans_.data(), inFans, 3);
  }

  Contour result() && { return std::move(contour_); }

private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  const LatticeCorner& corner(int c) const { return lattice_.corner(c); }

  /// `visit`(cube, axis): the edge along the axis that begins at the cube's first corner.
  template <class Visit>
  void forCrossedEdges(const Visit& visit) const {
    for (std::size_t c = 0; c < isCut_.size(); ++c) {
      if (!isCut_[c]) continue;
      const std::array<int, 8>& corners = lattice_.cubes()[c];
      for (int axis = 0; axis < 3; ++axis) {
        if (corner(corners[0]).isInside != corner(corners[at(1 << axis)]).isInside) visit(c, axis);
      }
    }
  }

  Eigen::Index crossedEdges() const {
    Eigen::Index count = 0;
    forCrossedEdges([&](std::size_t, int) { ++count; });
    return count;
  }

  struct Crossing {
    Vec3 point;
    On on;
    /// The plane of what vanishes there: a point of it, and its slope. Empty: nothing does.
    std::optional<std::pair<Vec3, Vec3>> plane;
  };

  /// On the edge between a corner inside and one that is not.
  Crossing crossing(int inside, int outside) const {
    const Vec3 from = lattice_.positionOf(inside);
    const Vec3 way = lattice_.positionOf(outside) - from;
    // Nothing tells where: well away from what the border shall keep away from.
    Crossing somewhere{from + 0.6 * way, On::Reach, {}};
    if (corner(outside).isTakenOut) return somewhere;
    const CornerSamples b = lattice_.samplesAt(outside);
    if (b.value() > 0.0) return beyond(b, from + way, from + kAlmostAll * way);
    const CornerSamples a = lattice_.samplesAt(inside);
    Root first;
    On on = On::Wall;
    const auto consider = [&](const std::optional<Sample>& atA, const std::optional<Sample>& atB,
                              On candidate) {
      if (!atA || !atB || atA->value <= 0.0 || atB->value > 0.0) return;
      const Root root = rootBetween(*atA, *atB, way);
      if (root.t >= first.t) return;
      first = root;
      on = candidate;
    };
    consider(a.wall, b.wall, On::Wall);
    consider(a.open, b.open, On::Reach);
    consider(a.cut, b.cut, On::Cut);
    if (!b.isReached && a.open) {
      // The reach of the ball that the corner inside has a place for ends somewhere on the way.
      const double t = -a.open->value / a.open->slope.dot(way);
      const double ends = t > 0.0 ? std::min(t, kAlmostAll) : kAlmostAll;
      if (ends < first.t) {
        first = {ends, a.open->slope};
        on = On::Reach;
      }
    }
    if (!(first.t <= 1.0)) return somewhere;
    const Vec3 point = from + first.t * way;
    return {point, on, {{point, first.slope}}};
  }

  /// On an edge that ends at x, which is left out although the border lies behind it.
  static Crossing beyond(const CornerSamples& samples, const Vec3& x, const Vec3& point) {
    std::optional<Sample> least = samples.wall;
    On on = On::Wall;
    const auto consider = [&](const std::optional<Sample>& sample, On candidate) {
      if (!sample || (least && least->value <= sample->value)) return;
      least = sample;
      on = candidate;
    };
    consider(samples.open, On::Reach);
    consider(samples.cut, On::Cut);
    if (!least) return {point, On::Reach, {}};
    return {point, on, {{x - least->value * least->slope, least->slope}}};
  }

  void placeVertex(int cube) {
    PlaneFit fit;
    std::array<bool, 3> isOn{};
    const std::array<int, 8>& corners = lattice_.cubes()[at(cube)];
    for (int i = 0; i < 8; ++i) {
      for (const int step : {1, 2, 4}) {
        const int a = corners[at(i)];
        const int b = corners[at(i ^ step)];
        if (!corner(a).isInside || corner(b).isInside) continue;
        const Crossing c = crossing(a, b);
        isOn[static_cast<std::size_t>(c.on)] = true;
        fit.addPoint(c.point);
        if (c.plane) fit.addPlane(c.plane->first, c.plane->second);
      }
    }
    constexpr double kFromSides = 0.02; // of the edge: no two vertices fall together
    const double edge = lattice_.edge();
    const Vec3 low = lattice_.positionOf(corners[0]) + Vec3::Constant(kFromSides * edge);
    const Vec3 high = low + Vec3::Constant((1.0 - 2.0 * kFromSides) * edge);
    contour_.mesh.vertices.row(cube) = fit.nearest().cwiseMax(low).cwiseMin(high).transpose();
    const auto [isOnWall, isOnReach, isOnCut] = isOn;
    contour_.on[at(cube)] = !isOnCut                ? (isOnReach ? On::Reach : On::Wall)
                            : isOnWall || isOnReach ? On::Crease
                                                    : On::Cut;
  }

  /// The quadrilateral around the edge along `axis` that begins at the cube's first corner.
  void connectAround(std::size_t cube, int axis) {
    const int a = lattice_.cubes()[cube][0];
    const int b = lattice_.cubes()[cube][at(1 << axis)];
    const Place u = Place::Unit((axis + 1) % 3);
    const Place w = Place::Unit((axis + 2) % 3);
    const Place place = lattice_.placeOf(a);
    // Counter-clockwise seen from the end of the axis.
    std::array<int, 4> ring{};
    int k = 0;
    for (const Place& p : {place, Place(place - u), Place(place - u - w), Place(place - w)}) {
      ring[at(k++)] = lattice_.cubeAt(p);
    }
    if (!corner(a).isInside) std::swap(ring[1], ring[3]);
    const Vec3 from = lattice_.positionOf(a);
    const Vec3 to = lattice_.positionOf(b);
    const bool isFirst = staysWithin(ring[0], ring[2], ring[1], ring[3], from, to);
    const bool isSecond = staysWithin(ring[1], ring[3], ring[0], ring[2], from, to);
    if (!isFirst && !isSecond) {
      fan(ring, corner(a).isInside ? crossing(a, b) : crossing(b, a));
      return;
    }
    if (isFirst && isSecond ? quality(ring, 0) < quality(ring, 1) : isSecond) {
      std::rotate(ring.begin(), ring.begin() + 1, ring.end());
    }
    contour_.mesh.faces.row(connected_++) << ring[0], ring[1], ring[2];
    contour_.mesh.faces.row(connected_++) << ring[0], ring[2], ring[3];
  }

  void fan(const std::array<int, 4>& ring, const Crossing& crossing) {
    const int middle = static_cast<int>(contour_.on.size());
    contour_.on.push_back(crossing.on);
    onEdges_.push_back(crossing.point);
    for (std::size_t k = 0; k < 4; ++k) {
      for (const int v : {ring[k], ring[(k + 1) % 4], middle}) fans_.push_back(v);
    }
  }

  Vec3 point(int v) const { return contour_.mesh.vertices.row(v).transpose(); }

  /// Whether the diagonal p–q passes the edge on the side of one of the others, so that it is
  /// within the tetrahedra around the edge.
  bool staysWithin(int p, int q, int other, int another, const Vec3& from, const Vec3& to) const {
    const Vec3 start = point(p);
    const Vec3 way = point(q) - start;
    const Vec3 edge = to - from;
    for (const int side : {other, another}) {
      const Vec3 third = point(side);
      const Vec3 normal = edge.cross(third - from);
      const double slope = normal.dot(way);
      const double t = normal.dot(from - start) / slope;
      if (!(t > 0.0 && t < 1.0)) continue;
      const Vec3 x = start + t * way;
      if (edge.cross(x - from).dot(normal) > 0.0 && (third - to).cross(x - to).dot(normal) > 0.0 &&
          (from - third).cross(x - third).dot(normal) > 0.0) {
        return true;
      }
    }
    return false;
  }

  /// Of the worse triangle where the diagonal begins at `first`: twice the area over the square of
  /// the longest side.
  double quality(const std::array<int, 4>& ring, std::size_t first) const {
    double worst = std::numeric_limits<double>::infinity();
    for (const std::size_t k : {first + 1, first + 2}) {
      const Vec3 a = point(ring[first]);
      const Vec3 b = point(ring[k % 4]);
      const Vec3 c = point(ring[(k + 1) % 4]);
      const double longest =
          std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
      worst = std::min(worst, areaNormal(a, b, c).norm() / longest);
    }
    return worst;
  }

  const BorderLattice& lattice_;
  std::vector<bool> isCut_; ///< for every cube
  Contour contour_;
  Eigen::Index connected_ = 0; ///< triangles of quadrilaterals
  std::vector<Vec3> onEdges_;  ///< vertices that follow those of cubes
  std::vector<int> fans_;      ///< triangles that follow those of quadrilaterals
};

} // namespace

Contour dualContour(const BorderLattice& lattice) {
  DualContouring contouring(lattice);
  contouring.placeVertices();
  contouring.connect();
  return std::move(contouring).result();
}

} // namespace massprops
