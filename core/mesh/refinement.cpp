#include "core/mesh/refinement.h"

#include "core/mesh/cgal_mesh.h"
#include "core/mesh/degenerate_faces.h"

#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace massprops {
namespace {

using Edge = SurfaceMesh::Edge_index;
using HalfEdge = SurfaceMesh::Halfedge_index;
namespace Processing = CGAL::Polygon_mesh_processing;

/// The diagonals of two triangles that count as flat pass each other within this share of the
/// shorter one,
constexpr double kFlat = 1e-3;
/// or of the wanted edges, which is more than single precision rounds the corners of needles by.
constexpr double kNextToNothing = 1e-4;

Vec3 pointOf(const SurfaceMesh& mesh, SurfaceMesh::Vertex_index v) {
  const auto& p = mesh.point(v);
  return {p.x(), p.y(), p.z()};
}

double lengthOf(const SurfaceMesh& mesh, Edge e) {
  const HalfEdge h = mesh.halfedge(e);
  return (pointOf(mesh, mesh.source(h)) - pointOf(mesh, mesh.target(h))).norm();
}

/// The quadrilateral of the two triangles at an edge.
struct Diamond {
  Vec3 from, to;    ///< of the edge
  Vec3 left, right; ///< the corners opposite to it

  Diamond(const SurfaceMesh& mesh, HalfEdge h)
      : from(pointOf(mesh, mesh.source(h))), to(pointOf(mesh, mesh.target(h))),
        left(pointOf(mesh, mesh.target(mesh.next(h)))),
        right(pointOf(mesh, mesh.target(mesh.next(mesh.opposite(h))))) {}

  /// Whether the other diagonal leaves two triangles that face as these do, and the surface where
  /// it is.
  bool isFlatAndConvex(double nextToNothing) const {
    const Vec3 along = to - from;
    const Vec3 across = right - left;
    const Vec3 normal = along.cross(across);
    const double area = normal.norm();
    if (!(area > 0.0)) return false;
    const double apart = std::abs((left - from).dot(normal)) / area;
    if (apart > std::max(nextToNothing, kFlat * std::min(along.norm(), across.norm())))
      return false;
    // Both ends of either diagonal are on different sides of the other one.
    const auto side = [&](const Vec3& a, const Vec3& b, const Vec3& p) {
      return (b - a).cross(p - a).dot(normal);
    };
    const double least = kSafe * area * area;
    return side(left, right, to) < -least && side(left, right, from) > least &&
           side(from, to, left) < -least && side(from, to, right) > least;
  }

  /// The angles opposite to the edge add up to more than 180°.
  bool isDelaunay() const {
    const auto cotangent = [&](const Vec3& corner) {
      const Vec3 a = from - corner;
      const Vec3 b = to - corner;
      return a.dot(b) / a.cross(b).norm();
    };
    return cotangent(left) + cotangent(right) >= -kSafe;
  }
};

bool shouldFlip(const SurfaceMesh& mesh, Edge e, double nextToNothing) {
  const HalfEdge h = mesh.halfedge(e);
  const Diamond diamond(mesh, h);
  if (diamond.isDelaunay() || !diamond.isFlatAndConvex(nextToNothing)) return false;
  return !mesh.halfedge(mesh.target(mesh.next(h)), mesh.target(mesh.next(mesh.opposite(h))))
              .is_valid();
}

/// Of the flat parts.
void makeDelaunay(SurfaceMesh& mesh, double nextToNothing) {
  std::vector<Edge> waiting(mesh.edges().begin(), mesh.edges().end());
  std::vector<char> waits(mesh.number_of_edges(), 1);
  // Rounding must not let the flips go round in circles.
  std::size_t left = 20 * waiting.size();
  for (std::size_t i = 0; i < waiting.size() && left > 0; ++i) {
    const Edge e = waiting[i];
    waits[e.idx()] = 0;
    if (!shouldFlip(mesh, e, nextToNothing)) continue;
    const HalfEdge h = mesh.halfedge(e);
    CGAL::Euler::flip_edge(h, mesh);
    --left;
    const HalfEdge o = mesh.opposite(h);
    for (const HalfEdge around : {mesh.next(h), mesh.prev(h), mesh.next(o), mesh.prev(o)}) {
      const Edge neighbour = mesh.edge(around);
      if (waits[neighbour.idx()] != 0) continue;
      waits[neighbour.idx()] = 1;
      waiting.push_back(neighbour);
    }
  }
}

std::vector<Edge> longEdges(const SurfaceMesh& mesh, double edge) {
  std::vector<Edge> result;
  for (const Edge e : mesh.edges()) {
    if (lengthOf(mesh, e) > edge) result.push_back(e);
  }
  return result;
}

} // namespace

TriangleMesh refined(const Points& vertices, const Faces& faces, double edge) {
  constexpr int kMostRounds = 30;
  SurfaceMesh mesh = surfaceMesh(vertices, faces);
  double longest = longestEdge(vertices, faces);
  // The longest edges first, which keeps the triangles in shape; a little more than half, for what
  // has been halved must not be split or not by rounding.
  constexpr double kHalf = 0.51;
  for (int round = 0; round < kMostRounds; ++round) {
    makeDelaunay(mesh, kNextToNothing * edge);
    longest = std::max(edge, kHalf * longest);
    const std::vector<Edge> edges = longEdges(mesh, longest);
    if (edges.empty() && longest == edge) break;
    Processing::split_long_edges(edges, longest, mesh);
  }
  return triangleMesh(mesh);
}

double longestEdge(const Points& vertices, const Faces& faces) {
  double squared = 0.0;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      squared = std::max(
          squared, (vertices.row(faces(f, k)) - vertices.row(faces(f, (k + 1) % 3))).squaredNorm());
    }
  }
  return std::sqrt(squared);
}

} // namespace massprops
