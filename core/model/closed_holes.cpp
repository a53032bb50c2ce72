#include "core/model/closed_holes.h"

#include "core/base/interruption.h"
#include "core/base/triangle.h"
#include "core/mesh/cgal_mesh.h"
#include "core/mesh/components.h"
#include "core/mesh/signed_volume.h"
#include "core/query/self_intersection.h"
#include "core/query/surface_deviation.h"
#include "core/query/triangle_tree.h"

#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/fair.h>
#include <CGAL/Polygon_mesh_processing/refine.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>
#include <vector>

namespace massprops {
namespace {

using Mesh = SurfaceMesh;
namespace Processing = CGAL::Polygon_mesh_processing;

/// Of the surface's area, that a hole's patch may have.
constexpr double kMostArea = 0.05;
/// Of the model's height, that the border of an open base may rise above the ground.
constexpr double kNearGround = 0.15;

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

/// From the fairest to the plainest.
enum class Shape { Smooth, Taut, Plain, Fan };

struct Loop {
  std::vector<int> border;
  int component = 0;
  bool isNearGround = false;
  bool isOpen = false; ///< stays so
  Shape shape = Shape::Smooth;
  bool crosses = false;
  std::vector<int> patch; ///< faces, after those of the input
  double area = 0.0;
};

std::vector<Loop> loopsOf(const TriangleMesh& mesh) {
  const auto surface = surfaceMesh(mesh.vertices, mesh.faces);
  if (static_cast<Eigen::Index>(surface.number_of_faces()) < mesh.faces.rows()) return {};
  std::vector<Mesh::Halfedge_index> starts;
  Processing::extract_boundary_cycles(surface, std::back_inserter(starts));
  std::vector<Loop> loops;
  for (const Mesh::Halfedge_index start : starts) {
    Loop loop;
    for (const Mesh::Halfedge_index h : CGAL::halfedges_around_face(start, surface)) {
      loop.border.push_back(static_cast<int>(surface.target(h).idx()));
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

/// Triangles in the loop that begins with the half-edge, none where there are none to be had.
std::vector<Mesh::Face_index> plainPatch(Mesh& mesh, Mesh::Halfedge_index start, std::size_t length,
                                         Shape shape) {
  std::vector<Mesh::Face_index> patch;
  // The least area takes time up to the cube of the border's length.
  constexpr std::size_t kLong = 48;
  constexpr std::size_t kVeryLong = 200;
  if (shape != Shape::Fan) {
    Processing::triangulate_hole(
        mesh, start, std::back_inserter(patch),
        CGAL::parameters::use_2d_constrained_delaunay_triangulation(length > kLong)
            .do_not_use_cubic_algorithm(length > kVeryLong));
  }
  if (!patch.empty()) return patch;
  // Triangles around the middle of the border.
  Vec3 middle = Vec3::Zero();
  for (const Mesh::Halfedge_index h : CGAL::halfedges_around_face(start, mesh)) {
    const auto& p = mesh.point(mesh.target(h));
    middle += Vec3(p.x(), p.y(), p.z()) / static_cast<double>(length);
  }
  const Mesh::Face_index face = mesh.add_face();
  for (const Mesh::Halfedge_index h : CGAL::halfedges_around_face(start, mesh)) {
    mesh.set_face(h, face);
  }
  mesh.set_halfedge(face, start);
  const Mesh::Halfedge_index spoke = CGAL::Euler::add_center_vertex(start, mesh);
  mesh.point(mesh.target(spoke)) = {middle.x(), middle.y(), middle.z()};
  for (const Mesh::Halfedge_index h : CGAL::halfedges_around_target(spoke, mesh)) {
    patch.push_back(mesh.face(h));
  }
  return patch;
}

void fill(Mesh& mesh, Loop& loop) {
  const auto vertex = [](int v) { return Mesh::Vertex_index(static_cast<Mesh::size_type>(v)); };
  const Mesh::Halfedge_index start =
      mesh.halfedge(vertex(loop.border.front()), vertex(loop.border[1]));
  loop.patch.clear();
  std::vector<Mesh::Face_index> patch = plainPatch(mesh, start, loop.border.size(), loop.shape);
  constexpr std::size_t kSmall = 4;
  if (loop.shape != Shape::Plain && loop.border.size() > kSmall) {
    std::vector<Mesh::Face_index> addedFaces;
    std::vector<Mesh::Vertex_index> added;
    Processing::refine(mesh, patch, std::back_inserter(addedFaces), std::back_inserter(added));
    patch.insert(patch.end(), addedFaces.begin(), addedFaces.end());
    std::vector<std::pair<Mesh::Vertex_index, SurfaceKernel::Point_3>> before;
    before.reserve(added.size());
    for (const Mesh::Vertex_index v : added) before.emplace_back(v, mesh.point(v));
    constexpr std::size_t kMostUnknowns = 20000;
    const unsigned continuity = loop.shape == Shape::Smooth ? 1 : 0;
    const bool isFair =
        added.empty() || added.size() > kMostUnknowns ||
        Processing::fair(mesh, added, CGAL::parameters::fairing_continuity(continuity));
    bool isFinite = true;
    for (const Mesh::Vertex_index v : added) {
      const auto& p = mesh.point(v);
      isFinite = isFinite && std::isfinite(p.x() + p.y() + p.z());
    }
    if (!isFair || !isFinite) {
      for (const auto& [v, p] : before) mesh.point(v) = p;
    }
  }
  std::sort(patch.begin(), patch.end());
  patch.erase(std::unique(patch.begin(), patch.end()), patch.end());
  for (const Mesh::Face_index f : patch) loop.patch.push_back(static_cast<int>(f.idx()));
}

/// The surface with patches in all loops that do not stay open.
TriangleMesh filled(const TriangleMesh& mesh, std::vector<Loop>& loops, const MendingTask& task) {
  auto surface = surfaceMesh(mesh.vertices, mesh.faces);
  for (Loop& loop : loops) {
    checkpoint();
    loop.patch.clear();
    if (!loop.isOpen) fill(surface, loop);
  }
  TriangleMesh result = triangleMesh(surface);
  result.faces.topRows(mesh.faces.rows()) = mesh.faces;
  const Eigen::Index added = result.vertices.rows() - mesh.vertices.rows();
  result.vertices.bottomRows(added) = task.representable(result.vertices.bottomRows(added));
  for (Loop& loop : loops) {
    loop.area = 0.0;
    for (const int f : loop.patch) {
      loop.area += 0.5 * areaNormal(result.vertices, result.faces, f).norm();
    }
  }
  return result;
}

/// Marks the loops whose patches cross something of their own component.
void findCrossings(const TriangleMesh& mesh, std::vector<Loop>& loops) {
  const std::vector<int> number = componentNumbers(mesh.vertices.rows(), mesh.faces);
  const std::vector<Submesh> parts = componentMeshes(mesh.vertices, mesh.faces);
  std::vector<std::vector<int>> facesOf;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    const auto c = at(number[at(mesh.faces(f, 0))]);
    if (facesOf.size() <= c) facesOf.resize(c + 1);
    facesOf[c].push_back(static_cast<int>(f));
  }
  std::vector<char> crosses(at(mesh.faces.rows()), 0);
  std::vector<char> isAsked(facesOf.size(), 0);
  for (const Loop& loop : loops) isAsked[at(number[at(loop.border.front())])] = 1;
  for (std::size_t c = 0; c < facesOf.size(); ++c) {
    if (isAsked[c] == 0) continue;
    const TriangleMesh& part = parts[c].mesh;
    for (const int f : selfIntersectingFaces(part.vertices, part.faces)) {
      crosses[at(facesOf[c][at(f)])] = 1;
    }
  }
  for (Loop& loop : loops) {
    loop.crosses = std::any_of(loop.patch.begin(), loop.patch.end(),
                               [&](int f) { return crosses[at(f)] != 0; });
  }
}

/// Leaves loops open that run along another component.
void leaveSeams(const TriangleMesh& mesh, const std::vector<int>& component,
                std::vector<Loop>& loops) {
  constexpr double kAlong = 0.01; // of the diagonal
  constexpr double kMostlyAlong = 0.8;
  constexpr std::size_t kMostComponents = 64; // more are a soup
  const double reach = kAlong * diagonalOf(mesh.vertices);
  std::vector<int> concerned;
  concerned.reserve(loops.size());
  for (const Loop& loop : loops) concerned.push_back(loop.component);
  std::sort(concerned.begin(), concerned.end());
  concerned.erase(std::unique(concerned.begin(), concerned.end()), concerned.end());
  const int components = *std::max_element(component.begin(), component.end()) + 1;
  if (components < 2) return;
  if (concerned.size() > kMostComponents) {
    for (Loop& loop : loops) loop.isOpen = true;
    return;
  }
  for (const int c : concerned) {
    Faces others(mesh.faces.rows(), 3);
    Eigen::Index rows = 0;
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
      if (component[at(mesh.faces(f, 0))] != c) others.row(rows++) = mesh.faces.row(f);
    }
    others.conservativeResize(rows, 3);
    const TriangleTree tree(mesh.vertices, others);
    for (Loop& loop : loops) {
      if (loop.component != c) continue;
      std::size_t along = 0;
      for (const int v : loop.border) {
        if (tree.nearest(mesh.vertices.row(v).transpose(), reach * reach).face >= 0) ++along;
      }
      loop.isOpen =
          static_cast<double>(along) > kMostlyAlong * static_cast<double>(loop.border.size());
    }
  }
}

bool isNearGround(const TriangleMesh& mesh, const std::vector<int>& border, const Vec3& up) {
  const Vector heights = mesh.vertices * up;
  const double ground = heights.minCoeff();
  const double limit = ground + kNearGround * (heights.maxCoeff() - ground);
  if (std::any_of(border.begin(), border.end(), [&](int v) { return heights[v] > limit; })) {
    return false;
  }
  // What it spans lies level.
  Vec3 normal = Vec3::Zero();
  const Vec3 first = mesh.vertices.row(border.front()).transpose();
  for (std::size_t i = 0; i < border.size(); ++i) {
    const Vec3 p = mesh.vertices.row(border[i]).transpose();
    const Vec3 q = mesh.vertices.row(border[(i + 1) % border.size()]).transpose();
    normal += (p - first).cross(q - first);
  }
  constexpr double kLevel = 0.7;
  return std::abs(normal.dot(up)) > kLevel * normal.norm();
}

/// Leaves loops open that no patch makes a body of.
void leaveSheets(const TriangleMesh& mesh, std::vector<Loop>& loops) {
  const std::vector<int> number = componentNumbers(mesh.vertices.rows(), mesh.faces);
  const Components components = connectedComponents(mesh.vertices.rows(), mesh.faces);
  for (Loop& loop : loops) {
    const Faces& faces = components[at(number[at(loop.border.front())])];
    const double area = surfaceArea(mesh.vertices, faces);
    constexpr double kFlat = 1e-3; // of a cube with this surface: 0.068
    loop.isOpen =
        loop.isOpen || std::abs(signedVolume(mesh.vertices, faces)) < kFlat * std::pow(area, 1.5);
  }
}

[[noreturn]] void refuse(std::size_t openings, std::size_t edges) {
  throw LargeOpening(
      "The surface is open along " + counted(edges, "boundary edge", "boundary edges") + ", and " +
      counted(openings, "opening is", "openings are") +
      " too large to be a hole: switch open_surface on if it is to become a shell with these "
      "openings, or use Remeshing > Close Holes, then run again.");
}

/// Refuses large openings, and leaves those open that are seams.
void requireHoles(const TriangleMesh& mesh, const std::vector<int>& component,
                  std::vector<Loop>& loops) {
  const double area = surfaceArea(mesh.vertices, mesh.faces);
  std::vector<Loop> large;
  for (const Loop& loop : loops) {
    if (!loop.isNearGround && loop.area > kMostArea * area) large.push_back(loop);
  }
  if (large.empty()) return;
  leaveSeams(mesh, component, large);
  std::size_t openings = 0;
  std::size_t edges = 0;
  for (const Loop& loop : large) {
    if (loop.isOpen) continue;
    ++openings;
    edges += loop.border.size();
  }
  for (Loop& loop : loops) {
    for (const Loop& other : large) {
      if (other.border.front() == loop.border.front()) loop.isOpen = other.isOpen;
    }
  }
  if (openings > 0) refuse(openings, edges);
}

MendedMesh closed(const TriangleMesh& input, const MendingTask& task, bool takesOpenings) {
  std::vector<Loop> loops = loopsOf(input);
  if (loops.empty()) return {input};
  const std::vector<int> component = componentNumbers(input.vertices.rows(), input.faces);
  for (Loop& loop : loops) {
    loop.component = component[at(loop.border.front())];
    loop.isNearGround = isNearGround(input, loop.border, task.rotation.transpose() * Vec3::UnitZ());
    // A smooth one would bulge into the ground.
    if (loop.isNearGround) loop.shape = Shape::Taut;
  }
  TriangleMesh closed;
  for (bool isNew = true; isNew;) {
    closed = filled(input, loops, task);
    findCrossings(closed, loops);
    isNew = false;
    for (Loop& loop : loops) {
      if (!loop.crosses || loop.shape == Shape::Fan) continue;
      loop.shape = static_cast<Shape>(static_cast<int>(loop.shape) + 1);
      isNew = true;
    }
  }
  if (!takesOpenings) requireHoles(input, component, loops);
  leaveSheets(closed, loops);
  const auto count = static_cast<std::size_t>(
      std::count_if(loops.begin(), loops.end(), [](const Loop& loop) { return !loop.isOpen; }));
  if (count == 0) return {input};
  if (count < loops.size()) closed = filled(input, loops, task);

  MendedMesh result{std::move(closed)};
  result.done = counted(count, "hole", "holes") + " closed";
  const Eigen::Index patches = result.mesh.faces.rows() - input.faces.rows();
  result.distance = greatestDistance(result.mesh.vertices, result.mesh.faces.bottomRows(patches),
                                     TriangleTree(input.vertices, input.faces));
  return result;
}

} // namespace

MendedMesh closedHoles(const TriangleMesh& input, const MendingTask& task) {
  return closed(input, task, false);
}

MendedMesh closedOpenings(const TriangleMesh& input, const MendingTask& task) {
  return closed(input, task, true);
}

} // namespace massprops
