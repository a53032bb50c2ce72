#include "surface_mesher.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>
#include <CGAL/boost/graph/iterator.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

namespace samples {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex = SurfaceMesh::Vertex_index;
using Halfedge = SurfaceMesh::Halfedge_index;
using Edge = SurfaceMesh::Edge_index;
using Face = SurfaceMesh::Face_index;

Kernel::Point_3 toCgal(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

/// Smallest angle of a triangle as its cosine: 0.5 is equilateral, 1 degenerate.
double cosineOfSmallestAngle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = (b - a).normalized();
  const Vec3 bc = (c - b).normalized();
  const Vec3 ca = (a - c).normalized();
  return std::max({-ab.dot(ca), -bc.dot(ab), -ca.dot(bc)});
}

/// A closed surface whose faces lie either in the ground (contact) or on the implicit surface; the
/// edges between the two kinds are the crease.
class GroundedSurface {
public:
  GroundedSurface(const MeshingProblem& problem, double spacing);

  int vertexCount() const { return static_cast<int>(mesh_.number_of_vertices()); }
  void remesh(double edgeLength, int iterations);
  void collapseTo(int vertexCount, double edgeLength);
  void polish(int iterations);
  Mesh result() const;

private:
  enum class Kind { Surface, Contact, Crease };

  Vec3 point(Vertex v) const {
    const Kernel::Point_3& p = mesh_.point(v);
    return {p.x(), p.y(), p.z()};
  }
  bool isCrease(Edge e) const {
    const Halfedge h = mesh_.halfedge(e);
    return contact_[mesh_.face(h)] != contact_[mesh_.face(mesh_.opposite(h))];
  }
  Kind kind(Vertex v) const;
  double relativeLength(const Vec3& a, const Vec3& b) const {
    return (a - b).norm() / problem_.relativeEdgeLength((a + b) / 2);
  }
  double relativeLength(Edge e) const {
    const Halfedge h = mesh_.halfedge(e);
    return relativeLength(point(mesh_.source(h)), point(mesh_.target(h)));
  }
  Vec3 project(Vec3 p, Kind kind) const;
  bool keepsOrientation(Vertex v, const Vec3& newPoint, Vertex exceptFacesWith) const;
  void splitLongEdges(double edgeLength);
  void split(Edge e);
  void collapseShortEdges(double edgeLength);
  bool collapse(Edge e, double longestAllowed);
  template <class Gain>
  void flipEdges(Gain gain);
  void flipForValence();
  void flipForAngles();
  void smooth();

  const MeshingProblem& problem_;
  SurfaceMesh mesh_;
  SurfaceMesh::Property_map<Face, bool> contact_;
};

GroundedSurface::GroundedSurface(const MeshingProblem& problem, double spacing)
    : problem_(problem), contact_(mesh_.add_property_map<Face, bool>("f:contact", false).first) {
  const Vec3 lower(problem.lower.x(), problem.lower.y(), 0);
  const Vec3 extent = problem.upper - lower;
  std::array<int, 3> n{};
  for (int i = 0; i < 3; ++i)
    n[static_cast<std::size_t>(i)] = static_cast<int>(std::ceil(extent[i] / spacing)) + 1;

  const auto node = [&](int i, int j, int k) { return (k * n[1] + j) * n[0] + i; };
  const auto position = [&](int index) {
    const int i = index % n[0];
    const int j = index / n[0] % n[1];
    const int k = index / n[0] / n[1];
    return Vec3(lower + spacing * Vec3(i, j, k));
  };
  std::vector<double> value(static_cast<std::size_t>(n[0] * n[1] * n[2]));
  for (std::size_t i = 0; i < value.size(); ++i)
    value[i] = problem.solid(position(static_cast<int>(i)));

  std::map<std::pair<int, int>, Vertex> vertexOnEdge;
  const auto crossing = [&](int a, int b) {
    const auto [entry, isNew] = vertexOnEdge.try_emplace(std::minmax(a, b));
    if (isNew) {
      const double va = value[static_cast<std::size_t>(a)];
      const double vb = value[static_cast<std::size_t>(b)];
      const double t = std::clamp(va / (va - vb), 0.1, 0.9);
      entry->second = mesh_.add_vertex(toCgal(position(a) + t * (position(b) - position(a))));
    }
    return entry->second;
  };
  // Kuhn's six tetrahedra of a cube: one for each order of the axes.
  constexpr int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  const auto addFace = [&](Vertex a, Vertex b, Vertex c) {
    if (mesh_.add_face(a, b, c) == SurfaceMesh::null_face())
      throw std::runtime_error("marching tetrahedra left the manifold");
  };
  for (int k = 0; k + 1 < n[2]; ++k)
    for (int j = 0; j + 1 < n[1]; ++j)
      for (int i = 0; i + 1 < n[0]; ++i)
        for (int o = 0; o < 6; ++o) {
          std::array<int, 3> corner{i, j, k};
          std::array<int, 4> tet{node(i, j, k)};
          for (std::size_t s = 0; s < 3; ++s) {
            ++corner[static_cast<std::size_t>(orders[o][s])];
            tet[s + 1] = node(corner[0], corner[1], corner[2]);
          }
          if (o >= 3) std::swap(tet[2], tet[3]); // positive orientation
          // Even permutations that bring the inside corners to the front.
          std::array<int, 4> in{}, out{};
          std::size_t ins = 0, outs = 0;
          int parity = 0;
          for (std::size_t c = 0; c < 4; ++c) {
            if (value[static_cast<std::size_t>(tet[c])] < 0) {
              parity += static_cast<int>(outs);
              in[ins++] = tet[c];
            } else {
              out[outs++] = tet[c];
            }
          }
          const bool odd = parity % 2 == 1;
          if (ins == 1) {
            if (odd) std::swap(out[0], out[1]);
            addFace(crossing(in[0], out[0]), crossing(in[0], out[1]), crossing(in[0], out[2]));
          } else if (ins == 2) {
            if (odd) std::swap(out[0], out[1]);
            const Vertex a = crossing(in[0], out[0]), b = crossing(in[0], out[1]);
            const Vertex c = crossing(in[1], out[1]), d = crossing(in[1], out[0]);
            addFace(a, b, c);
            addFace(a, c, d);
          } else if (ins == 3) {
            if (odd) std::swap(in[0], in[1]);
            addFace(crossing(in[0], out[0]), crossing(in[1], out[0]), crossing(in[2], out[0]));
          }
        }

  // The surface is open where it meets the ground: each loop there bounds a contact area.
  std::vector<Halfedge> borders;
  for (const Halfedge h : mesh_.halfedges())
    if (mesh_.is_border(h)) borders.push_back(h);
  for (const Halfedge h : borders) {
    if (!mesh_.is_border(h)) continue;
    Vec3 sum = Vec3::Zero();
    int count = 0;
    for (const Halfedge g : CGAL::halfedges_around_face(h, mesh_)) {
      const Vec3 p = point(mesh_.target(g));
      if (p.z() > 0) throw std::runtime_error("the solid reaches out of its box");
      sum += p;
      ++count;
    }
    mesh_.set_face(h, mesh_.add_face());
    for (const Halfedge g : CGAL::halfedges_around_face(h, mesh_)) mesh_.set_face(g, mesh_.face(h));
    mesh_.set_halfedge(mesh_.face(h), h);
    const Halfedge center = CGAL::Euler::add_center_vertex(h, mesh_);
    mesh_.point(mesh_.target(center)) = toCgal(sum / count);
    for (const Face f : CGAL::faces_around_target(center, mesh_)) contact_[f] = true;
  }
}

GroundedSurface::Kind GroundedSurface::kind(Vertex v) const {
  bool contact = false, surface = false;
  for (const Face f : CGAL::faces_around_target(mesh_.halfedge(v), mesh_))
    (contact_[f] ? contact : surface) = true;
  return contact ? (surface ? Kind::Crease : Kind::Contact) : Kind::Surface;
}

Vec3 GroundedSurface::project(Vec3 p, Kind kind) const {
  if (kind != Kind::Surface) p.z() = 0;
  if (kind == Kind::Contact) return p;
  for (int i = 0; i < 8; ++i) {
    const double distance = problem_.solid(p);
    if (std::abs(distance) < 1e-6) break;
    Vec3 g = gradient(problem_.solid, p);
    if (kind == Kind::Crease) g.z() = 0;
    p -= distance * g / std::max(g.squaredNorm(), 0.05);
  }
  return p;
}

/// Whether no face around `v` is turned over when `v` moves; faces with `exceptFacesWith` do not
/// count.
bool GroundedSurface::keepsOrientation(Vertex v, const Vec3& newPoint,
                                       Vertex exceptFacesWith) const {
  for (const Halfedge h : CGAL::halfedges_around_target(v, mesh_)) {
    const Vertex b = mesh_.target(mesh_.next(h));
    const Vertex c = mesh_.source(h);
    if (b == exceptFacesWith || c == exceptFacesWith) continue;
    const Vec3 pb = point(b);
    const Vec3 pc = point(c);
    // What the face was like before is no guide near the crease, where it may be turned over.
    Vec3 outwards;
    if (contact_[mesh_.face(h)])
      outwards = -Vec3::UnitZ();
    else if (std::min({newPoint.z(), pb.z(), pc.z()}) <= 0)
      outwards = gradient(problem_.solid, (newPoint + pb + pc) / 3).normalized();
    else
      outwards = (pb - point(v)).cross(pc - point(v)).normalized();
    const Vec3 after = (pb - newPoint).cross(pc - newPoint);
    if (after.dot(outwards) <= 0.3 * after.norm() ||
        cosineOfSmallestAngle(newPoint, pb, pc) > 0.995)
      return false;
  }
  return true;
}

void GroundedSurface::split(Edge e) {
  Halfedge h = mesh_.halfedge(e);
  const Vec3 middle = (point(mesh_.source(h)) + point(mesh_.target(h))) / 2;
  const Halfedge sides[2] = {CGAL::Euler::split_edge(h, mesh_), mesh_.opposite(h)};
  const Vertex v = mesh_.target(sides[0]);
  mesh_.point(v) = toCgal(middle);
  for (const Halfedge side : sides) {
    const bool contact = contact_[mesh_.face(side)];
    // From the new vertex to the opposite corner.
    const Halfedge diagonal = CGAL::Euler::split_face(side, mesh_.next(mesh_.next(side)), mesh_);
    contact_[mesh_.face(diagonal)] = contact;
    contact_[mesh_.face(mesh_.opposite(diagonal))] = contact;
  }
  const Vec3 projected = project(middle, kind(v));
  if (keepsOrientation(v, projected, SurfaceMesh::null_vertex()))
    mesh_.point(v) = toCgal(projected);
}

void GroundedSurface::splitLongEdges(double edgeLength) {
  const std::vector<Edge> edges(mesh_.edges().begin(), mesh_.edges().end());
  for (const Edge e : edges)
    if (relativeLength(e) > edgeLength * 4 / 3) split(e);
}

bool GroundedSurface::collapse(Edge e, double longestAllowed) {
  const Halfedge h = mesh_.halfedge(e);
  const Vertex a = mesh_.source(h), b = mesh_.target(h);
  const Kind ka = kind(a), kb = kind(b);
  if (ka == Kind::Crease && kb == Kind::Crease && !isCrease(e)) return false;
  if (!CGAL::Euler::does_satisfy_link_condition(e, mesh_)) return false;
  // In order of preference; a crease vertex stays on the crease.
  std::vector<Vec3> candidates;
  if (ka == kb) candidates.push_back(project((point(a) + point(b)) / 2, ka));
  if (ka == kb || ka == Kind::Crease) candidates.push_back(point(a));
  if (ka == kb || kb == Kind::Crease) candidates.push_back(point(b));
  const auto isAllowed = [&](const Vec3& p) {
    for (const Vertex v : {a, b}) {
      const Vertex other = v == a ? b : a;
      if (!keepsOrientation(v, p, other)) return false;
      for (const Vertex w : CGAL::vertices_around_target(v, mesh_))
        if (w != other && relativeLength(point(w), p) > longestAllowed) return false;
    }
    return true;
  };
  const auto p = std::find_if(candidates.begin(), candidates.end(), isAllowed);
  if (p == candidates.end()) return false;
  const Vertex kept = CGAL::Euler::collapse_edge(e, mesh_);
  mesh_.point(kept) = toCgal(*p);
  return true;
}

void GroundedSurface::collapseShortEdges(double edgeLength) {
  const std::vector<Edge> edges(mesh_.edges().begin(), mesh_.edges().end());
  for (const Edge e : edges)
    if (!mesh_.is_removed(e) && relativeLength(e) < edgeLength * 4 / 5)
      collapse(e, edgeLength * 4 / 3);
}

/// Flips every inner edge where `gain(a, b, c, d)` of the edge ab between corners c, d is positive.
template <class Gain>
void GroundedSurface::flipEdges(Gain gain) {
  for (const Edge e : mesh_.edges()) {
    if (isCrease(e)) continue;
    const Halfedge h = mesh_.halfedge(e);
    const Vertex a = mesh_.source(h), b = mesh_.target(h);
    const Vertex c = mesh_.target(mesh_.next(h));
    const Vertex d = mesh_.target(mesh_.next(mesh_.opposite(h)));
    if (mesh_.halfedge(c, d) != SurfaceMesh::null_halfedge() || gain(a, b, c, d) <= 0) continue;
    const Vec3 pa = point(a), pb = point(b), pc = point(c), pd = point(d);
    const Vec3 before = (pb - pa).cross(pc - pa) + (pd - pa).cross(pb - pa);
    const Vec3 after[2] = {(pd - pc).cross(pb - pc), (pa - pc).cross(pd - pc)};
    const bool turnsOver = after[0].dot(before) < 0.8 * after[0].norm() * before.norm() ||
                           after[1].dot(before) < 0.8 * after[1].norm() * before.norm();
    if (!turnsOver) CGAL::Euler::flip_edge(h, mesh_);
  }
}

void GroundedSurface::flipForValence() {
  const auto excess = [&](Vertex v, int change) {
    const int valence = static_cast<int>(mesh_.degree(v)) + change;
    return (valence - 6) * (valence - 6);
  };
  flipEdges([&](Vertex a, Vertex b, Vertex c, Vertex d) {
    const double angles = std::max(cosineOfSmallestAngle(point(c), point(d), point(b)),
                                   cosineOfSmallestAngle(point(d), point(c), point(a)));
    if (angles > 0.94) return 0;
    return excess(a, 0) + excess(b, 0) + excess(c, 0) + excess(d, 0) - excess(a, -1) -
           excess(b, -1) - excess(c, 1) - excess(d, 1);
  });
}

void GroundedSurface::flipForAngles() {
  flipEdges([&](Vertex a, Vertex b, Vertex c, Vertex d) {
    const Vec3 pa = point(a), pb = point(b), pc = point(c), pd = point(d);
    return std::max(cosineOfSmallestAngle(pa, pb, pc), cosineOfSmallestAngle(pb, pa, pd)) -
           std::max(cosineOfSmallestAngle(pc, pd, pb), cosineOfSmallestAngle(pd, pc, pa)) - 1e-9;
  });
}

void GroundedSurface::smooth() {
  const double smallestHeight = 1e-3 * (problem_.upper - problem_.lower).norm();
  for (const Vertex v : mesh_.vertices()) {
    const Kind k = kind(v);
    Vec3 sum = Vec3::Zero();
    double weights = 0;
    for (const Halfedge h : CGAL::halfedges_around_target(v, mesh_)) {
      if (k == Kind::Crease && !isCrease(mesh_.edge(h))) continue;
      const Vec3 q = point(mesh_.source(h));
      const double size = problem_.relativeEdgeLength(q);
      const double weight = 1 / (size * size);
      sum += weight * q;
      weights += weight;
    }
    const Vec3 p = point(v);
    Vec3 step = sum / weights - p;
    if (k == Kind::Surface) {
      const Vec3 normal = gradient(problem_.solid, p).normalized();
      step -= normal.dot(step) * normal;
    }
    const Vec3 target = project(p + 0.7 * step, k);
    if ((k != Kind::Surface || target.z() > smallestHeight) &&
        keepsOrientation(v, target, SurfaceMesh::null_vertex()))
      mesh_.point(v) = toCgal(target);
  }
}

void GroundedSurface::remesh(double edgeLength, int iterations) {
  for (int i = 0; i < iterations; ++i) {
    splitLongEdges(edgeLength);
    collapseShortEdges(edgeLength);
    flipForValence();
    smooth();
    smooth();
    mesh_.collect_garbage();
  }
}

void GroundedSurface::collapseTo(int vertexCount, double edgeLength) {
  while (this->vertexCount() > vertexCount) {
    std::vector<std::pair<double, Edge>> edges;
    for (const Edge e : mesh_.edges()) edges.emplace_back(relativeLength(e), e);
    std::sort(edges.begin(), edges.end());
    bool done = false;
    for (const auto& [length, e] : edges)
      if (collapse(e, edgeLength * 1.6)) {
        done = true;
        break;
      }
    mesh_.collect_garbage();
    if (!done) throw std::runtime_error("no edge can be collapsed");
  }
  while (this->vertexCount() < vertexCount) {
    Edge longest = *mesh_.edges().begin();
    for (const Edge e : mesh_.edges())
      if (relativeLength(e) > relativeLength(longest)) longest = e;
    split(longest);
  }
}

void GroundedSurface::polish(int iterations) {
  for (int i = 0; i < iterations; ++i) {
    if (i < iterations / 2)
      flipForValence();
    else
      flipForAngles();
    smooth();
  }
  flipForAngles();
}

Mesh GroundedSurface::result() const {
  SurfaceMesh rounded = mesh_;
  for (const Vertex v : rounded.vertices()) {
    const Vec3 p = point(v).cast<float>().cast<double>();
    rounded.point(v) = toCgal(p);
  }
  rounded.collect_garbage();
  std::vector<std::size_t> components(rounded.number_of_faces());
  const auto componentOf = rounded.add_property_map<Face, std::size_t>("f:component").first;
  if (!CGAL::is_closed(rounded) || !rounded.is_valid() ||
      PMP::connected_components(rounded, componentOf) != 1)
    throw std::runtime_error("the surface is not one closed component");
  if (PMP::does_self_intersect(rounded)) throw std::runtime_error("the surface intersects itself");
  if (!PMP::is_outward_oriented(rounded)) throw std::runtime_error("the surface is inside out");

  Mesh mesh;
  for (const Vertex v : rounded.vertices()) {
    const Kernel::Point_3& p = rounded.point(v);
    mesh.vertices.push_back(
        {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())});
  }
  for (const Face f : rounded.faces()) {
    std::array<int, 3> corners{};
    std::size_t i = 0;
    for (const Vertex v : CGAL::vertices_around_face(rounded.halfedge(f), rounded))
      corners[i++] = static_cast<int>(v);
    mesh.faces.push_back(corners);
  }
  return mesh;
}

} // namespace

Mesh meshAboveGround(const MeshingProblem& problem) {
  // A vertex of an equilateral mesh owns √3/2 of its squared edge length.
  const Vec3 extent = problem.upper - problem.lower;
  double edgeLength = std::sqrt(2 * extent.x() * extent.z() / problem.vertexCount);
  GroundedSurface surface(problem, edgeLength);
  for (int i = 0; i < 6; ++i) {
    surface.remesh(edgeLength, 4);
    const double ratio = static_cast<double>(surface.vertexCount()) / problem.vertexCount;
    if (i > 1 && ratio >= 1 && ratio < 1.01) break;
    edgeLength *= std::sqrt(ratio / 1.004);
  }
  surface.remesh(edgeLength, 6);
  surface.collapseTo(problem.vertexCount, edgeLength);
  surface.polish(12);
  return surface.result();
}

} // namespace samples
