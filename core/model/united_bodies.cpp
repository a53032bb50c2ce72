#include "core/model/united_bodies.h"

#include "core/mesh/cgal_mesh.h"
#include "core/mesh/components.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/signed_volume.h"
#include "core/query/point_in_mesh.h"
#include "core/query/self_intersection.h"
#include "core/query/triangle_tree.h"

#include <CGAL/Polygon_mesh_processing/corefinement.h>

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

namespace massprops {
namespace {

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

/// More are no assembly but a soup.
constexpr std::size_t kMostBodies = 400;

/// The union as a closed surface; empty where it has none that is manifold, or where one of them
/// crosses itself.
std::optional<TriangleMesh> unionOf(const TriangleMesh& a, const TriangleMesh& b) {
  auto one = surfaceMesh(a.vertices, a.faces);
  auto two = surfaceMesh(b.vertices, b.faces);
  SurfaceMesh all;
  try {
    if (!CGAL::Polygon_mesh_processing::corefine_and_compute_union(
            one, two, all, CGAL::parameters::throw_on_self_intersection(true))) {
      return std::nullopt;
    }
  } catch (const std::exception&) {
    return std::nullopt;
  }
  all.collect_garbage();
  return triangleMesh(all);
}

/// One after the other, in pairs of about equal size.
std::optional<TriangleMesh> unionOf(std::vector<TriangleMesh> bodies) {
  while (bodies.size() > 1) {
    std::vector<TriangleMesh> next;
    for (std::size_t i = 0; i < bodies.size(); i += 2) {
      if (i + 1 == bodies.size()) {
        next.push_back(std::move(bodies[i]));
        continue;
      }
      std::optional<TriangleMesh> both = unionOf(bodies[i], bodies[i + 1]);
      if (!both) return std::nullopt;
      next.push_back(std::move(*both));
    }
    bodies = std::move(next);
  }
  return std::move(bodies.front());
}

/// Numbers of the components that cross another one; empty where one of them crosses itself.
std::optional<std::vector<char>> crossingOthers(const TriangleMesh& mesh,
                                                const std::vector<Submesh>& components) {
  const std::vector<int> number = componentNumbers(mesh.vertices.rows(), mesh.faces);
  std::vector<char> crosses(components.size(), 0);
  for (const int f : selfIntersectingFaces(mesh.vertices, mesh.faces)) {
    crosses[at(number[at(mesh.faces(f, 0))])] = 1;
  }
  for (std::size_t c = 0; c < components.size(); ++c) {
    if (crosses[c] == 0) continue;
    const TriangleMesh& part = components[c].mesh;
    if (!selfIntersectingFaces(part.vertices, part.faces).empty()) return std::nullopt;
  }
  return crosses;
}

/// Components of bodies that do not cross: those that bound material from outside, and the cavities
/// right inside of them.
TriangleMesh withoutWhatIsInside(const TriangleMesh& mesh, std::size_t& inside) {
  std::vector<Submesh> components = componentMeshes(mesh.vertices, mesh.faces);
  if (components.size() < 2) return mesh;
  std::vector<Eigen::AlignedBox3d> boxes(components.size());
  std::vector<double> volumes;
  for (std::size_t c = 0; c < components.size(); ++c) {
    const TriangleMesh& part = components[c].mesh;
    boxes[c].extend(Vec3(part.vertices.colwise().minCoeff().transpose()));
    boxes[c].extend(Vec3(part.vertices.colwise().maxCoeff().transpose()));
    volumes.push_back(signedVolume(part.vertices, part.faces));
  }
  std::vector<int> depth(components.size(), 0);
  for (std::size_t outer = 0; outer < components.size(); ++outer) {
    std::vector<std::size_t> candidates;
    for (std::size_t c = 0; c < components.size(); ++c) {
      if (c != outer && boxes[outer].contains(boxes[c])) candidates.push_back(c);
    }
    if (candidates.empty()) continue;
    TriangleMesh outward = components[outer].mesh;
    if (volumes[outer] < 0.0) flip(outward.faces);
    const TriangleTree tree(outward.vertices, outward.faces);
    const PointInMesh body(tree);
    for (const std::size_t c : candidates) {
      if (body.contains(components[c].mesh.vertices, components[c].mesh.faces)) ++depth[c];
    }
  }
  std::vector<TriangleMesh> kept;
  for (std::size_t c = 0; c < components.size(); ++c) {
    if (depth[c] == 0 || (depth[c] == 1 && volumes[c] < 0.0)) {
      kept.push_back(std::move(components[c].mesh));
    } else {
      ++inside;
    }
  }
  return inside == 0 ? mesh : assembled(kept);
}

} // namespace

MendedMesh unitedBodies(const TriangleMesh& input, const MendingTask& /*task*/) {
  const EdgeCounts edges = countEdges(input.vertices.rows(), input.faces);
  if (edges.boundary + edges.nonManifold + edges.incoherent > 0) return {input};
  std::vector<Submesh> components = componentMeshes(input.vertices, input.faces);
  if (components.size() < 2) return {input};
  const std::optional<std::vector<char>> crosses = crossingOthers(input, components);
  if (!crosses) return {input};

  MendedMesh result{input};
  std::vector<TriangleMesh> bodies;
  std::vector<TriangleMesh> others;
  for (std::size_t c = 0; c < components.size(); ++c) {
    TriangleMesh& part = components[c].mesh;
    if ((*crosses)[c] != 0 && signedVolume(part.vertices, part.faces) < 0.0) flip(part.faces);
    ((*crosses)[c] != 0 ? bodies : others).push_back(std::move(part));
  }
  const std::size_t united = bodies.size();
  if (united > kMostBodies) return {input};
  if (united > 1) {
    // From left to right, so that neighbours meet early.
    std::stable_sort(bodies.begin(), bodies.end(),
                     [](const TriangleMesh& a, const TriangleMesh& b) {
                       return a.vertices.col(0).minCoeff() < b.vertices.col(0).minCoeff();
                     });
    std::optional<TriangleMesh> all = unionOf(std::move(bodies));
    if (!all) return {input};
    others.push_back(std::move(*all));
    result.mesh = assembled(others);
    result.done = counted(united, "overlapping body", "overlapping bodies") + " united";
  }
  std::size_t inside = 0;
  result.mesh = withoutWhatIsInside(result.mesh, inside);
  if (inside > 0) {
    result.done += (united > 1 ? ", " : "") + counted(inside, "component", "components") +
                   " inside of another left out";
  }
  return result;
}

} // namespace massprops
