#include "core/model/wrapping.h"

#include "core/base/interruption.h"
#include "core/base/tolerances.h"
#include "core/base/triangle.h"
#include "core/mesh/cgal_mesh.h"
#include "core/mesh/components.h"
#include "core/mesh/degenerate_faces.h"
#include "core/mesh/signed_volume.h"
#include "core/query/enclosed_volume.h"
#include "core/query/self_intersection.h"
#include "core/query/surface_deviation.h"
#include "core/query/triangle_tree.h"
#include "core/query/winding_number.h"

#include <CGAL/Alpha_wrap_3/internal/Alpha_wrap_3.h>
#include <CGAL/Alpha_wrap_3/internal/Alpha_wrap_AABB_traits.h>
#include <CGAL/Alpha_wrap_3/internal/offset_intersection.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace massprops {
namespace {

/// Beyond these it is another model.
constexpr double kMostVolume = 0.03;
/// Radii of the ball that rolls around the model, of the box's diagonal.
constexpr double kFinestBall = 1.0 / 100.0;
constexpr double kCoarsestBall = 1.0 / 12.0;

/// Edges of one face beyond which there is air, as faces that use a corner twice.
Faces openEdges(const TriangleMesh& mesh, const TriangleTree& surface, double beyond) {
  std::map<std::pair<int, int>, std::pair<int, int>> sides; // how many faces, and one of them
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      auto& [count, face] = sides[std::minmax(mesh.faces(f, k), mesh.faces(f, (k + 1) % 3))];
      ++count;
      face = static_cast<int>(f);
    }
  }
  std::vector<Eigen::RowVector3i> open;
  for (const auto& [edge, of] : sides) {
    if (of.first != 1) continue;
    const Vec3 a = mesh.vertices.row(edge.first).transpose();
    const Vec3 b = mesh.vertices.row(edge.second).transpose();
    const Vec3 normal = areaNormal(mesh.vertices, mesh.faces, of.second).stableNormalized();
    const Vec3 middle = 0.5 * (a + b);
    Vec3 out = (b - a).cross(normal).stableNormalized();
    const int third = mesh.faces.row(of.second).sum() - edge.first - edge.second;
    if (out.dot(mesh.vertices.row(third).transpose() - middle) > 0.0) out = -out;
    constexpr double kAir = 0.9;
    const double air = kAir * beyond;
    if (surface.nearest(middle + beyond * out, air * air).face < 0)
      open.emplace_back(edge.first, edge.second, edge.first);
  }
  Faces result(static_cast<Eigen::Index>(open.size()), 3);
  for (std::size_t i = 0; i < open.size(); ++i) result.row(static_cast<Eigen::Index>(i)) = open[i];
  return result;
}

/// A ball with this radius gets through no hole whose border hangs together, as far as holes are
/// flat.
double radiusOfHoles(const TriangleMesh& mesh, double beyond) {
  const TriangleTree surface(mesh.vertices, mesh.faces);
  const Faces open = openEdges(mesh, surface, beyond);
  double radius = 0.0;
  for (const Submesh& border : componentMeshes(mesh.vertices, open)) {
    const Points& p = border.mesh.vertices;
    const Points centred = p.rowwise() - p.colwise().mean();
    // Across the middle one of the border's three directions it is as narrow as a ball sees it.
    const Eigen::SelfAdjointEigenSolver<Mat3> axes(Mat3(centred.transpose() * centred));
    const Vector along = centred * axes.eigenvectors().col(1);
    constexpr double kCorners = 1.5; // a ball that just fits gets into a square's corners
    radius = std::max(radius, 0.5 * kCorners * (along.maxCoeff() - along.minCoeff()));
  }
  return radius;
}

/// What the wrap of CGAL 5.5 asks of the triangles; its public function takes no other oracle than
/// CGAL's own, which puts a tree of points beside a tree of split triangles: 112 MB for a table of
/// 57,000, where the whole run asks for 33 with this one, in 0.8 of the time.
class WrapOracle {
public:
  using Geom_traits = CGAL::Alpha_wraps_3::internal::Alpha_wrap_AABB_traits<SurfaceKernel>;
  using Point = Geom_traits::Point_3;

  explicit WrapOracle(const TriangleTree& surface) : surface_(surface) {}

  const Geom_traits& geom_traits() const { return traits_; }

  CGAL::Bbox_3 bbox() const {
    const Vec3 lower = surface_.lower();
    const Vec3 upper = surface_.upper();
    return {lower.x(), lower.y(), lower.z(), upper.x(), upper.y(), upper.z()};
  }

  bool do_intersect(const Geom_traits::Ball_3& ball) const {
    checkpoint();
    return surface_.nearest(at(ball.boundary().center()), ball.boundary().squared_radius()).face >=
           0;
  }

  template <class Kernel>
  bool do_intersect(
      const CGAL::Alpha_wraps_3::internal::Tetrahedron_with_outside_info<Kernel>& cell) const {
    checkpoint();
    const CGAL::Bbox_3& box = cell.m_bbox;
    bool isCut = false;
    surface_.forOverlaps({box.xmin(), box.ymin(), box.zmin()}, {box.xmax(), box.ymax(), box.zmax()},
                         0, [&](Eigen::Index place) {
                           if (isCut) return;
                           const auto face = triangle(surface_.faceAt(place));
                           // The predicates do not take faces without area.
                           isCut = !traits_.is_degenerate_3_object()(face) &&
                                   traits_.do_intersect_3_object()(cell, face);
                         });
    return isCut;
  }

  Point closest_point(const Point& p) const {
    const Vec3 nearest = surface_.nearest(at(p)).point;
    return {nearest.x(), nearest.y(), nearest.z()};
  }

  double squared_distance(const Point& p) const { return surface_.nearest(at(p)).squaredDistance; }

  double operator()(const Point& p) const { return std::sqrt(squared_distance(p)); }

  bool first_intersection(const Point& p, const Point& q, Point& first, double offset) const {
    constexpr double kPrecision = 0.01; // CGAL's own
    return CGAL::Alpha_wraps_3::internal::Offset_intersection<Geom_traits, const WrapOracle&>(
               *this, offset, kPrecision * offset, 1.0)
        .first_intersection(p, q, first);
  }

private:
  static Vec3 at(const Point& p) { return {p.x(), p.y(), p.z()}; }

  Geom_traits::Triangle_3 triangle(int face) const {
    const auto corner = [&](int k) {
      const auto p = surface_.vertices().row(surface_.faces()(face, k));
      return Point(p.x(), p.y(), p.z());
    };
    return {corner(0), corner(1), corner(2)};
  }

  const TriangleTree& surface_;
  Geom_traits traits_;
};

std::optional<TriangleMesh> wrapOf(const TriangleTree& surface, double ball, double offset) {
  const WrapOracle oracle(surface);
  SurfaceMesh wrap;
  try {
    CGAL::Alpha_wraps_3::internal::Alpha_wrap_3<WrapOracle> builder(oracle);
    builder(ball, offset, wrap);
  } catch (const std::exception&) {
    return std::nullopt;
  }
  wrap.collect_garbage();
  TriangleMesh result = triangleMesh(wrap);
  if (result.faces.rows() == 0) return std::nullopt;
  return result;
}

bool isGood(const TriangleMesh& mesh) {
  return facesWithoutArea(mesh.vertices, mesh.faces).empty() &&
         selfIntersectingFaces(mesh.vertices, mesh.faces).empty();
}

/// The wrap nearer to what it wraps, as far as it does not cross itself then.
std::optional<TriangleMesh> tightened(const TriangleMesh& wrap, const TriangleTree& surface,
                                      double offset, const MendingTask& task) {
  Points ways(wrap.vertices.rows(), 3);
  for (Eigen::Index v = 0; v < ways.rows(); ++v) {
    const Vec3 p = wrap.vertices.row(v).transpose();
    const Vec3 way = surface.nearest(p).point - p;
    const double length = way.norm();
    ways.row(v) = (length > offset ? Vec3(offset / length * way) : way).transpose();
  }
  for (const double share : {0.95, 0.8, 0.5, 0.0}) {
    TriangleMesh result = wrap;
    result.vertices = task.representable(wrap.vertices + share * ways);
    if (isGood(result)) return result;
  }
  return std::nullopt;
}

/// Faces with the outside on one side only, of at most some thousands.
Faces visibleFaces(const TriangleMesh& mesh) {
  constexpr Eigen::Index kMost = 8000;
  const Eigen::Index step = std::max<Eigen::Index>(1, mesh.faces.rows() / kMost);
  const WindingNumber winding(mesh.vertices, mesh.faces);
  const double beside = 10.0 * placeTolerance(mesh.vertices);
  Faces visible(mesh.faces.rows() / step + 1, 3);
  Eigen::Index rows = 0;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); f += step) {
    const Vec3 normal = areaNormal(mesh.vertices, mesh.faces, f).stableNormalized();
    Vec3 middle = Vec3::Zero();
    for (const int v : mesh.faces.row(f)) middle += mesh.vertices.row(v).transpose() / 3.0;
    const auto isInside = [&](const Vec3& p) { return std::abs(winding.at(p)) >= 0.5; };
    if (isInside(middle + beside * normal) != isInside(middle - beside * normal)) {
      visible.row(rows++) = mesh.faces.row(f);
    }
  }
  return visible.topRows(rows);
}

std::string percent(double share) {
  const double tenths = std::round(1000.0 * share);
  return (tenths < 0.0 ? "-" : "+") + std::to_string(static_cast<int>(std::abs(tenths)) / 10) +
         "." + std::to_string(static_cast<int>(std::abs(tenths)) % 10) + " %";
}

} // namespace

MendedMesh wrapped(const TriangleMesh& input, const MendingTask& task) {
  if (input.faces.rows() == 0) return {input};
  const double diagonal = diagonalOf(input.vertices);
  const double most = diagonal / 400.0;
  const double offset = task.wall.hides(4.0 * most) ? most : 0.25 * task.wall.exactly();
  const double volume = enclosedVolume(input);
  if (!(volume > kLeastVolume * std::pow(diagonal, 3))) return {input};

  // A ball that fits through a hole leaves the hollow inside.
  constexpr double kKept = 0.9;
  const double coarsest = kCoarsestBall * diagonal;
  const double holes = radiusOfHoles(input, 0.5 * kFinestBall * diagonal);
  const TriangleTree surface(input.vertices, input.faces);
  std::optional<TriangleMesh> wrap;
  for (const double ball : {std::clamp(holes, kFinestBall * diagonal, coarsest), coarsest}) {
    wrap = wrapOf(surface, ball, offset);
    if (wrap && signedVolume(wrap->vertices, wrap->faces) < kKept * volume) wrap.reset();
    if (wrap) break;
  }
  if (!wrap) return {input};
  wrap = tightened(*wrap, surface, offset, task);
  if (!wrap) return {input};

  MendedMesh result{std::move(*wrap)};
  const TriangleTree tree(result.mesh.vertices, result.mesh.faces);
  result.distance = std::max(greatestDistance(result.mesh.vertices, result.mesh.faces, surface),
                             greatestDistance(input.vertices, visibleFaces(input), tree));
  const double change = signedVolume(result.mesh.vertices, result.mesh.faces) / volume - 1.0;
  result.done = "wrapped, volume " + percent(change);
  if (task.wall.hides(result.distance) && std::abs(change) <= kMostVolume) return result;
  result.warning =
      "The model could not be mended piece by piece and was wrapped anew: its surface moved by up "
      "to " +
      percent(result.distance / diagonal).substr(1) +
      " of the diagonal and its volume changed by " + percent(change) +
      ", so look at the new outer surface.";
  return result;
}

} // namespace massprops
