#include "core/query/point_in_mesh.h"

#include "core/base/triangle.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace massprops {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Where a way from p to q meets a triangle.
enum class Meeting {
  None,
  Inside,  ///< once, within the triangle
  Edge,    ///< in a corner or along an edge, which tells nothing
  AtStart, ///< p lies on it
};

Meeting meetingOf(const Kernel::Triangle_3& triangle, const Kernel::Point_3& p,
                  const Kernel::Point_3& q) {
  const auto ofP = CGAL::orientation(triangle[0], triangle[1], triangle[2], p);
  const auto ofQ = CGAL::orientation(triangle[0], triangle[1], triangle[2], q);
  if (ofP == CGAL::COPLANAR) {
    if (triangle.has_on(p)) return Meeting::AtStart;
    const bool isAlong =
        ofQ == CGAL::COPLANAR && CGAL::do_intersect(triangle, Kernel::Segment_3(p, q));
    return isAlong ? Meeting::Edge : Meeting::None;
  }
  if (ofP == ofQ || ofQ == CGAL::COPLANAR) return Meeting::None;
  int left = 0;
  int right = 0;
  for (int k = 0; k < 3; ++k) {
    const auto side = CGAL::orientation(p, q, triangle[k], triangle[k + 1]);
    left += side == CGAL::POSITIVE ? 1 : 0;
    right += side == CGAL::NEGATIVE ? 1 : 0;
  }
  if (left > 0 && right > 0) return Meeting::None;
  return left + right == 3 ? Meeting::Inside : Meeting::Edge;
}

/// The way to a nearest point within a face meets the surface nowhere else, so that its side of the
/// face decides. Empty: the nearest point is not well within the face.
std::optional<bool> sideOfNearest(const Vec3& p, int nearestFace, const TriangleTree& surface) {
  const auto corner = [&](int k) {
    return Vec3(surface.vertices().row(surface.faces()(nearestFace, k)).transpose());
  };
  const Vec3 a = corner(0);
  const Vec3 b = corner(1);
  const Vec3 c = corner(2);
  const Vec3 weights = nearestWeights(p, a, b, c);
  const Vec3 normal = areaNormal(a, b, c);
  const Vec3 way = p - (weights[0] * a + weights[1] * b + weights[2] * c);
  constexpr double kWellInside = 1e-3;
  if (weights.minCoeff() > kWellInside && way.norm() > 1e-6 * (b - a).norm() &&
      std::abs(normal.dot(way)) > 0.999 * normal.norm() * way.norm()) {
    return normal.dot(way) < 0.0;
  }
  return std::nullopt;
}

} // namespace

PointInMesh::PointInMesh(const TriangleTree& surface)
    : surface_(surface), lower_(surface.lower()), upper_(surface.upper()),
      length_(2.0 * (upper_ - lower_).norm()) {}

bool PointInMesh::contains(const Vec3& p) const {
  if ((p.array() <= lower_.array()).any() || (p.array() >= upper_.array()).any()) return false;
  for (const int axis : {2, 0, 1}) {
    Vec3 end = p;
    end[axis] = upper_[axis] + length_;
    const Way way = walk(p, end);
    if (way != Way::Unknown) return way == Way::Inside;
  }
  // Through the middle of a face a way leads off its edges, at least.
  const Points& x = surface_.vertices();
  const Faces& faces = surface_.faces();
  constexpr Eigen::Index kMostTries = 61;
  const Eigen::Index step = std::max<Eigen::Index>(1, faces.rows() / kMostTries);
  for (Eigen::Index f = 0; f < faces.rows(); f += step) {
    const Vec3 middle =
        (x.row(faces(f, 0)) + x.row(faces(f, 1)) + x.row(faces(f, 2))).transpose() / 3.0;
    const Way way = walk(p, p + length_ * (middle - p).stableNormalized());
    if (way != Way::Unknown) return way == Way::Inside;
  }
  return false;
}

bool PointInMesh::contains(const Vec3& p, const TriangleTree::Hit& nearest) const {
  const std::optional<bool> side = sideOfNearest(p, nearest.face, surface_);
  return side ? *side : contains(p);
}

bool PointInMesh::contains(const Points& vertices, const Faces& component) const {
  // Some vertex has a nearest point within a face, most often the first.
  constexpr Eigen::Index kMostTries = 64;
  const Eigen::Index step = std::max<Eigen::Index>(1, component.rows() / kMostTries);
  for (Eigen::Index f = 0; f < component.rows(); f += step) {
    const Vec3 p = vertices.row(component(f, 0)).transpose();
    const std::optional<bool> side = sideOfNearest(p, surface_.nearest(p).face, surface_);
    if (side) return *side;
  }
  return contains(vertices.row(component(0, 0)).transpose());
}

PointInMesh::Way PointInMesh::walk(const Vec3& from, const Vec3& to) const {
  const Kernel::Point_3 p(from.x(), from.y(), from.z());
  const Kernel::Point_3 q(to.x(), to.y(), to.z());
  const Points& x = surface_.vertices();
  const auto exact = [&](int v) { return Kernel::Point_3(x(v, 0), x(v, 1), x(v, 2)); };
  bool isOdd = false;
  bool isKnown = true;
  bool isOnSurface = false;
  surface_.forOverlaps(from.cwiseMin(to), from.cwiseMax(to), 0, [&](Eigen::Index i) {
    if (!isKnown || isOnSurface) return;
    const auto face = surface_.faces().row(surface_.faceAt(i));
    const Kernel::Triangle_3 triangle(exact(face[0]), exact(face[1]), exact(face[2]));
    if (triangle.is_degenerate()) return; // its neighbours meet in it
    const Meeting meeting = meetingOf(triangle, p, q);
    isOnSurface = meeting == Meeting::AtStart;
    isKnown = meeting != Meeting::Edge;
    if (meeting == Meeting::Inside) isOdd = !isOdd;
  });
  if (isOnSurface) return Way::Outside;
  if (!isKnown) return Way::Unknown;
  return isOdd ? Way::Inside : Way::Outside;
}

} // namespace massprops
