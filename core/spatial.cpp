#include "core/spatial.h"

#include <CGAL/AABB_segment_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace massprops {
namespace {

/// Exact predicates: a ray through an edge or a vertex must not slip between the triangles.
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Segments = std::vector<Kernel::Segment_3>;
using TrianglePrimitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
using TriangleTraits = CGAL::AABB_traits<Kernel, TrianglePrimitive>;
using SegmentPrimitive = CGAL::AABB_segment_primitive<Kernel, Segments::const_iterator>;
using SegmentTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, SegmentPrimitive>>;

Vec3 vec(const Kernel::Point_3& p) {
  return {p.x(), p.y(), p.z()};
}

Vec3 nearestOnSegment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 edge = b - a;
  const double square = edge.squaredNorm();
  return square > 0.0 ? Vec3(a + std::clamp((p - a).dot(edge) / square, 0.0, 1.0) * edge) : a;
}

Vec3 nearestOnTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  Vec3 nearest = nearestOnSegment(p, a, b);
  for (const Vec3& other : {nearestOnSegment(p, b, c), nearestOnSegment(p, c, a)}) {
    if ((p - other).squaredNorm() < (p - nearest).squaredNorm()) nearest = other;
  }
  // The foot of the perpendicular by its barycentric coordinates, if it is inside.
  const Vec3 normal = (b - a).cross(c - a);
  const double ofA = (b - p).cross(c - p).dot(normal);
  const double ofB = (c - p).cross(a - p).dot(normal);
  const double ofC = (a - p).cross(b - p).dot(normal);
  if (ofA > 0.0 && ofB > 0.0 && ofC > 0.0) {
    const Vec3 foot = (ofA * a + ofB * b + ofC * c) / (ofA + ofB + ofC);
    if ((p - foot).squaredNorm() < (p - nearest).squaredNorm()) nearest = foot;
  }
  return nearest;
}

/// CGAL projects onto the plane of a triangle; one (almost) without area has none, and comparing
/// the NaN that comes out exactly ends the process.
struct RobustTraits : TriangleTraits {
  struct Closest_point {
    Kernel::Point_3 operator()(const Kernel::Point_3& query, const TrianglePrimitive& primitive,
                               const Kernel::Point_3& bound) const {
      const Kernel::Triangle_3& t = primitive.datum();
      const Vec3 p = vec(query);
      const Vec3 nearest =
          nearestOnTriangle(p, vec(t.vertex(0)), vec(t.vertex(1)), vec(t.vertex(2)));
      return (p - nearest).squaredNorm() < (p - vec(bound)).squaredNorm()
                 ? Kernel::Point_3(nearest.x(), nearest.y(), nearest.z())
                 : bound;
    }
  };
  Closest_point closest_point_object() const { return {}; }
};

using TriangleTree = CGAL::AABB_tree<RobustTraits>;

Kernel::Point_3 point(const Points& points, Eigen::Index i) {
  return {points(i, 0), points(i, 1), points(i, 2)};
}

Triangles triangles(const Points& vertices, const Faces& faces) {
  Triangles result;
  result.reserve(static_cast<std::size_t>(faces.rows()));
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    result.emplace_back(point(vertices, faces(f, 0)), point(vertices, faces(f, 1)),
                        point(vertices, faces(f, 2)));
  }
  return result;
}

/// Every edge of a closed surface once.
std::vector<std::pair<int, int>> edges(const Faces& faces) {
  std::vector<std::pair<int, int>> result;
  result.reserve(static_cast<std::size_t>(3 * faces.rows() / 2));
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int from = faces(f, k);
      const int to = faces(f, (k + 1) % 3);
      if (from < to) result.emplace_back(from, to);
    }
  }
  return result;
}

CGAL::Bbox_3 grown(const CGAL::Bbox_3& box, double margin) {
  return {box.xmin() - margin, box.ymin() - margin, box.zmin() - margin,
          box.xmax() + margin, box.ymax() + margin, box.zmax() + margin};
}

} // namespace

struct SurfaceIndex::Tree {
  Triangles triangles;
  TriangleTree tree;

  Nearest result(const Kernel::Point_3& query,
                 const TriangleTree::Point_and_primitive_id& closest) const {
    return {std::sqrt(CGAL::squared_distance(query, closest.first)),
            static_cast<int>(closest.second - triangles.cbegin()),
            {closest.first.x(), closest.first.y(), closest.first.z()}};
  }
};

SurfaceIndex::SurfaceIndex(const Points& vertices, const Faces& faces)
    : tree_(std::make_unique<Tree>()) {
  tree_->triangles = triangles(vertices, faces);
  tree_->tree.rebuild(tree_->triangles.cbegin(), tree_->triangles.cend());
  tree_->tree.accelerate_distance_queries();
}

SurfaceIndex::~SurfaceIndex() = default;
SurfaceIndex::SurfaceIndex(SurfaceIndex&&) noexcept = default;
SurfaceIndex& SurfaceIndex::operator=(SurfaceIndex&&) noexcept = default;

Vector SurfaceIndex::chords(const Points& points, const Points& directions) const {
  Vector result(points.rows());
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const Kernel::Point_3 start = point(points, i);
    const Kernel::Vector_3 d(directions(i, 0), directions(i, 1), directions(i, 2));
    // CGAL cannot cut triangles without area.
    const auto isSkipped = [&](Triangles::const_iterator triangle) {
      return triangle->vertex(0) == start || triangle->vertex(1) == start ||
             triangle->vertex(2) == start || triangle->is_degenerate();
    };
    const auto hit = tree_->tree.first_intersection(Kernel::Ray_3(start, d), isSkipped);
    result[i] = std::numeric_limits<double>::infinity();
    if (hit) {
      if (const auto* at = boost::get<Kernel::Point_3>(&hit->first)) {
        result[i] = std::sqrt(CGAL::squared_distance(start, *at));
      } else if (const auto* along = boost::get<Kernel::Segment_3>(&hit->first)) {
        result[i] = std::sqrt(CGAL::squared_distance(start, *along));
      }
    }
  }
  return result;
}

SurfaceIndex::Nearest SurfaceIndex::nearest(const Vec3& p) const {
  const Kernel::Point_3 query(p.x(), p.y(), p.z());
  return tree_->result(query, tree_->tree.closest_point_and_primitive(query));
}

SurfaceIndex::Nearest SurfaceIndex::nearest(const Vec3& p, const Nearest& hint) const {
  if (hint.face < 0) return nearest(p);
  const Kernel::Point_3 query(p.x(), p.y(), p.z());
  const TriangleTree::Point_and_primitive_id start({hint.point.x(), hint.point.y(), hint.point.z()},
                                                   std::next(tree_->triangles.cbegin(), hint.face));
  return tree_->result(query, tree_->tree.closest_point_and_primitive(query, start));
}

std::vector<SurfaceIndex::Nearest> verticesAsHints(const Points& vertices, const Faces& faces) {
  std::vector<SurfaceIndex::Nearest> hints(static_cast<std::size_t>(vertices.rows()),
                                           {0.0, -1, Vec3::Zero()});
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    for (const int v : faces.row(f)) {
      hints[static_cast<std::size_t>(v)] = {0.0, static_cast<int>(f), vertices.row(v).transpose()};
    }
  }
  return hints;
}

Vector surfaceDistances(const Points& vertices, const Faces& faces, const Points& otherVertices,
                        const Faces& otherFaces, double horizon) {
  // Two disjoint triangles are nearest at a vertex of one and a point of the other, or at two
  // edges.
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vector distance = Vector::Constant(vertices.rows(), kInfinity);
  if (faces.rows() == 0) return distance;
  const std::vector<SurfaceIndex::Nearest> own = verticesAsHints(vertices, faces);
  const std::vector<SurfaceIndex::Nearest> others = verticesAsHints(otherVertices, otherFaces);
  // A cavity vertex lies near the outer vertex of the same number, when there is one.
  const auto hintFrom = [](const std::vector<SurfaceIndex::Nearest>& hints, Eigen::Index v) {
    return v < static_cast<Eigen::Index>(hints.size()) ? hints[static_cast<std::size_t>(v)]
                                                       : SurfaceIndex::Nearest{0.0, -1, {}};
  };
  const SurfaceIndex otherIndex(otherVertices, otherFaces);
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    if (own[static_cast<std::size_t>(v)].face < 0) continue;
    distance[v] = otherIndex.nearest(vertices.row(v).transpose(), hintFrom(others, v)).distance;
  }
  const SurfaceIndex ownIndex(vertices, faces);
  for (Eigen::Index v = 0; v < otherVertices.rows(); ++v) {
    const SurfaceIndex::Nearest nearest =
        ownIndex.nearest(otherVertices.row(v).transpose(), hintFrom(own, v));
    for (const int corner : faces.row(nearest.face)) {
      distance[corner] = std::min(distance[corner], nearest.distance);
    }
  }

  Segments segments;
  for (const auto& [from, to] : edges(otherFaces)) {
    segments.emplace_back(point(otherVertices, from), point(otherVertices, to));
  }
  const SegmentTree tree(segments.cbegin(), segments.cend());
  double least = distance.minCoeff();
  std::vector<Segments::const_iterator> near;
  for (const auto& [from, to] : edges(faces)) {
    const Kernel::Segment_3 edge(point(vertices, from), point(vertices, to));
    near.clear();
    tree.all_intersected_primitives(grown(edge.bbox(), std::max(horizon, least)),
                                    std::back_inserter(near));
    for (const auto segment : near) {
      const double d = std::sqrt(CGAL::squared_distance(edge, *segment));
      distance[from] = std::min(distance[from], d);
      distance[to] = std::min(distance[to], d);
      least = std::min(least, d);
    }
  }
  Vector around = distance;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const double face =
        std::min({distance[faces(f, 0)], distance[faces(f, 1)], distance[faces(f, 2)]});
    for (const int corner : faces.row(f)) around[corner] = std::min(around[corner], face);
  }
  return around;
}

} // namespace massprops
