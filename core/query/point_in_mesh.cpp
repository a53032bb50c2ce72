#include "core/query/point_in_mesh.h"

#include "core/base/triangle.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace massprops {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// Whether a point is inside of a closed surface, by the parity of the crossings on a way out of
/// it. A way that meets an edge tells nothing: other ways are tried, a bounded number of them.
class PointInMesh {
public:
  explicit PointInMesh(const TriangleTree& surface)
      : x_(surface.vertices()), faces_(surface.faces()), tree_(surface), lower_(surface.lower()),
        upper_(surface.upper()), length_(2.0 * (upper_ - lower_).norm()) {}

  bool isInside(const Vec3& p) const {
    if ((p.array() <= lower_.array()).any() || (p.array() >= upper_.array()).any()) return false;
    for (const int axis : {2, 0, 1}) {
      Vec3 end = p;
      end[axis] = upper_[axis] + length_;
      const Way way = walk(p, end);
      if (way != Way::Unknown) return way == Way::Inside;
    }
    // Through the middle of a face a way leads off its edges, at least.
    constexpr Eigen::Index kMostTries = 61;
    const Eigen::Index step = std::max<Eigen::Index>(1, faces_.rows() / kMostTries);
    for (Eigen::Index f = 0; f < faces_.rows(); f += step) {
      const Vec3 middle =
          (x_.row(faces_(f, 0)) + x_.row(faces_(f, 1)) + x_.row(faces_(f, 2))).transpose() / 3.0;
      const Vec3 end = p + length_ * (middle - p).stableNormalized();
      const Way way = walk(p, end);
      if (way != Way::Unknown) return way == Way::Inside;
    }
    return false;
  }

private:
  enum class Way { Inside, Outside, Unknown };

  Way walk(const Vec3& from, const Vec3& to) const {
    const Kernel::Point_3 p(from.x(), from.y(), from.z());
    const Kernel::Point_3 q(to.x(), to.y(), to.z());
    bool isOdd = false;
    bool isKnown = true;
    bool isOnSurface = false;
    tree_.forOverlaps(from.cwiseMin(to), from.cwiseMax(to), 0, [&](Eigen::Index i) {
      if (!isKnown || isOnSurface) return;
      const auto face = faces_.row(tree_.faceAt(i));
      const Kernel::Triangle_3 triangle(exact(face[0]), exact(face[1]), exact(face[2]));
      if (triangle.is_degenerate()) return; // its neighbours meet in it
      const auto ofP = CGAL::orientation(triangle[0], triangle[1], triangle[2], p);
      const auto ofQ = CGAL::orientation(triangle[0], triangle[1], triangle[2], q);
      if (ofP == CGAL::COPLANAR) {
        if (triangle.has_on(p))
          isOnSurface = true;
        else if (ofQ == CGAL::COPLANAR)
          isKnown = !CGAL::do_intersect(triangle, Segment(p, q));
        return;
      }
      if (ofP == ofQ || ofQ == CGAL::COPLANAR) return;
      int left = 0;
      int right = 0;
      for (int k = 0; k < 3; ++k) {
        const auto side = CGAL::orientation(p, q, triangle[k], triangle[k + 1]);
        left += side == CGAL::POSITIVE ? 1 : 0;
        right += side == CGAL::NEGATIVE ? 1 : 0;
      }
      if (left > 0 && right > 0) return;
      isKnown = left + right == 3;
      isOdd = !isOdd;
    });
    if (isOnSurface) return Way::Outside;
    if (!isKnown) return Way::Unknown;
    return isOdd ? Way::Inside : Way::Outside;
  }

  using Segment = Kernel::Segment_3;
  Kernel::Point_3 exact(int v) const { return {x_(v, 0), x_(v, 1), x_(v, 2)}; }

  const Points& x_;
  const Faces& faces_;
  const TriangleTree& tree_;
  Vec3 lower_, upper_;
  double length_;
};

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
  const Vec3 normal = (b - a).cross(c - a);
  const Vec3 way = p - (weights[0] * a + weights[1] * b + weights[2] * c);
  constexpr double kWellInside = 1e-3;
  if (weights.minCoeff() > kWellInside && way.norm() > 1e-6 * (b - a).norm() &&
      std::abs(normal.dot(way)) > 0.999 * normal.norm() * way.norm()) {
    return normal.dot(way) < 0.0;
  }
  return std::nullopt;
}

} // namespace

bool isInside(const Vec3& p, const TriangleTree& surface) {
  return PointInMesh(surface).isInside(p);
}

bool isInside(const Vec3& p, const TriangleTree::Hit& nearest, const TriangleTree& surface) {
  const std::optional<bool> side = sideOfNearest(p, nearest.face, surface);
  return side ? *side : isInside(p, surface);
}

bool isInside(const Points& vertices, const Faces& component, const TriangleTree& surface) {
  // Some vertex has a nearest point within a face, most often the first.
  constexpr Eigen::Index kMostTries = 64;
  const Eigen::Index step = std::max<Eigen::Index>(1, component.rows() / kMostTries);
  for (Eigen::Index f = 0; f < component.rows(); f += step) {
    const Vec3 p = vertices.row(component(f, 0)).transpose();
    const std::optional<bool> side = sideOfNearest(p, surface.nearest(p).face, surface);
    if (side) return *side;
  }
  return isInside(vertices.row(component(0, 0)).transpose(), surface);
}

} // namespace massprops
