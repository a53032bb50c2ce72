#include "core/model/local_crossings.h"

#include "core/base/triangle.h"
#include "core/mesh/components.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/hole_filling.h"
#include "core/mesh/signed_volume.h"
#include "core/query/self_intersection.h"
#include "core/query/surface_deviation.h"
#include "core/query/triangle_tree.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace massprops {
namespace {

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

/// Rings of faces that go with those that cross, at most.
constexpr int kMostRings = 4;
/// A hole with more edges is no small place.
constexpr std::size_t kLongestBorder = 400;

/// Every face with a vertex of a marked one.
void grow(const TriangleMesh& mesh, std::vector<char>& isMarked) {
  std::vector<char> isNear(at(mesh.vertices.rows()), 0);
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    if (isMarked[at(f)] == 0) continue;
    for (const int v : mesh.faces.row(f)) isNear[at(v)] = 1;
  }
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    for (const int v : mesh.faces.row(f)) {
      if (isNear[at(v)] != 0) isMarked[at(f)] = 1;
    }
  }
}

/// Loops around what is missing in a closed surface, in the sense of the faces that are missing;
/// empty where they touch.
std::vector<std::vector<int>> bordersOf(const TriangleMesh& mesh, const Faces& kept) {
  const std::vector<int> opposite = oppositeHalfEdges(mesh.vertices.rows(), kept);
  std::vector<int> next(at(mesh.vertices.rows()), -1);
  for (int h = 0; h < static_cast<int>(kept.size()); ++h) {
    if (opposite[at(h)] >= 0) continue;
    int& follows = next[at(kept.data()[nextHalfEdge(h)])];
    if (follows >= 0) return {};
    follows = kept.data()[h];
  }
  std::vector<std::vector<int>> borders;
  for (std::size_t v = 0; v < next.size(); ++v) {
    if (next[v] < 0) continue;
    std::vector<int> border;
    int w = static_cast<int>(v);
    while (next[at(w)] >= 0) {
      border.push_back(w);
      w = std::exchange(next[at(w)], -1);
    }
    borders.push_back(std::move(border));
  }
  return borders;
}

/// A closed surface without the marked faces, its holes closed; empty where that fails.
std::optional<TriangleMesh> replaced(const TriangleMesh& mesh, const std::vector<char>& isMarked) {
  Faces kept(mesh.faces.rows(), 3);
  Eigen::Index rows = 0;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    if (isMarked[at(f)] == 0) kept.row(rows++) = mesh.faces.row(f);
  }
  kept.conservativeResize(rows, 3);
  if (rows == 0) return std::nullopt;
  // Of what falls apart the largest stays; the rest is what crossed.
  const Components parts = connectedComponents(mesh.vertices.rows(), kept);
  if (parts.size() > 1) {
    kept = *std::max_element(parts.begin(), parts.end(), [&](const Faces& a, const Faces& b) {
      return surfaceArea(mesh.vertices, a) < surfaceArea(mesh.vertices, b);
    });
  }
  const std::vector<std::vector<int>> borders = bordersOf(mesh, kept);
  if (borders.empty()) return std::nullopt;
  const VertexCorners corners = vertexCorners(mesh.vertices.rows(), kept);
  std::vector<Faces> pieces{kept};
  for (const std::vector<int>& border : borders) {
    if (border.size() < 3 || border.size() > kLongestBorder) return std::nullopt;
    // The faces around it as a mesh of their own.
    std::vector<int> around;
    for (const int v : border) {
      for (const int c : corners.at(v)) around.push_back(c / 3);
    }
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    Faces faces(static_cast<Eigen::Index>(around.size()), 3);
    for (std::size_t i = 0; i < around.size(); ++i) {
      faces.row(static_cast<Eigen::Index>(i)) = kept.row(around[i]);
    }
    const Submesh patch = submesh(mesh.vertices, faces);
    std::vector<int> local;
    for (const int v : border) {
      const auto found = std::lower_bound(patch.vertexOf.begin(), patch.vertexOf.end(), v);
      local.push_back(static_cast<int>(found - patch.vertexOf.begin()));
    }
    Faces filling = holeFilling(patch.mesh, local);
    if (filling.rows() == 0) return std::nullopt;
    pieces.emplace_back(filling.unaryExpr([&](int v) { return patch.vertexOf[at(v)]; }));
  }
  const Faces faces = joined(pieces);
  const EdgeCounts edges = countEdges(mesh.vertices.rows(), faces);
  if (edges.boundary + edges.nonManifold + edges.incoherent > 0) return std::nullopt;
  return TriangleMesh{mesh.vertices, faces};
}

/// How far the marked faces lie from the new surface.
double distanceOf(const TriangleMesh& mesh, const std::vector<char>& isMarked,
                  const TriangleMesh& other) {
  Faces marked(mesh.faces.rows(), 3);
  Eigen::Index rows = 0;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    if (isMarked[at(f)] != 0) marked.row(rows++) = mesh.faces.row(f);
  }
  return greatestDistance(mesh.vertices, marked.topRows(rows),
                          TriangleTree(other.vertices, other.faces));
}

struct Mended {
  TriangleMesh mesh;
  double distance;
  std::size_t left = 0; ///< faces that go on crossing
};

/// So many that this is no matter of a few places.
bool areMany(const std::vector<int>& crossing, const TriangleMesh& mesh) {
  constexpr double kMostFaces = 0.1;
  constexpr std::size_t kFew = 100;
  return crossing.size() > kFew &&
         static_cast<double>(crossing.size()) > kMostFaces * static_cast<double>(mesh.faces.rows());
}

bool hasVolume(double volume, const TriangleMesh& mesh) {
  constexpr double kMostChange = 0.005;
  return std::abs(signedVolume(mesh.vertices, mesh.faces) - volume) <=
         kMostChange * std::abs(volume);
}

/// One component without its crossings; empty where that fails.
std::optional<Mended> mendedComponent(const TriangleMesh& component,
                                      const std::vector<int>& crossing, const MendingTask& task) {
  if (areMany(crossing, component)) return std::nullopt;
  const double volume = signedVolume(component.vertices, component.faces);
  for (int rings = 0; rings <= kMostRings; ++rings) {
    TriangleMesh mesh = component;
    std::vector<int> present = crossing;
    double distance = 0.0;
    // What is new may cross, too.
    constexpr int kRounds = 3;
    for (int round = 0; round < kRounds && !present.empty(); ++round) {
      std::vector<char> isMarked(at(mesh.faces.rows()), 0);
      for (const int f : present) isMarked[at(f)] = 1;
      for (int ring = 0; ring < rings + round; ++ring) grow(mesh, isMarked);
      std::optional<TriangleMesh> next = replaced(mesh, isMarked);
      if (!next) break;
      distance += distanceOf(mesh, isMarked, *next);
      mesh = std::move(*next);
      present = selfIntersectingFaces(mesh.vertices, mesh.faces);
      if (areMany(present, mesh)) break;
    }
    if (present.empty() && hasVolume(volume, mesh) && task.wall.hides(distance)) {
      return Mended{submesh(mesh.vertices, mesh.faces).mesh, distance, 0};
    }
  }
  return std::nullopt;
}

/// The marked faces in pieces that have no vertex in common.
std::vector<std::vector<int>> piecesOf(const TriangleMesh& mesh, const std::vector<int>& marked) {
  Faces faces(static_cast<Eigen::Index>(marked.size()), 3);
  for (std::size_t i = 0; i < marked.size(); ++i)
    faces.row(static_cast<Eigen::Index>(i)) = mesh.faces.row(marked[i]);
  const std::vector<int> number = componentNumbers(mesh.vertices.rows(), faces);
  std::vector<std::vector<int>> pieces;
  for (std::size_t i = 0; i < marked.size(); ++i) {
    const std::size_t piece = at(number[at(faces(static_cast<Eigen::Index>(i), 0))]);
    if (pieces.size() <= piece) pieces.resize(piece + 1);
    pieces[piece].push_back(marked[i]);
  }
  return pieces;
}

/// As `mendedComponent`, but one place after the other, each with as few rings as it takes. Where
/// that fails it goes on crossing; empty where it fails everywhere.
std::optional<Mended> mendedPlaces(const TriangleMesh& component, std::vector<int> crossing,
                                   const MendingTask& task) {
  if (areMany(crossing, component)) return std::nullopt;
  constexpr double kMostFaces = 2e6; // looked at for crossings, a ring
  constexpr double kMostPlaces = 100.0;
  const double volume = signedVolume(component.vertices, component.faces);
  double left = std::min(kMostPlaces, kMostFaces / static_cast<double>(component.faces.rows()));
  TriangleMesh mesh = component;
  std::vector<int> inVain; // places, by a vertex
  const auto mendOne = [&] {
    for (const std::vector<int>& place : piecesOf(mesh, crossing)) {
      const int key = mesh.faces(place.front(), 0);
      if (std::find(inVain.begin(), inVain.end(), key) != inVain.end()) continue;
      if (--left < 0.0) return false;
      std::vector<char> isMarked(at(mesh.faces.rows()), 0);
      for (const int f : place) isMarked[at(f)] = 1;
      for (int rings = 0; rings <= kMostRings; ++rings) {
        if (rings > 0) grow(mesh, isMarked);
        std::optional<TriangleMesh> next = replaced(mesh, isMarked);
        if (!next || !hasVolume(volume, *next)) continue;
        std::vector<int> others = selfIntersectingFaces(next->vertices, next->faces);
        if (others.size() >= crossing.size()) continue;
        if (!task.wall.hides(distanceOf(mesh, isMarked, *next))) continue;
        mesh = *std::move(next);
        crossing = std::move(others);
        return true;
      }
      inVain.push_back(key);
    }
    return false;
  };
  bool isAny = false;
  while (!crossing.empty() && mendOne()) isAny = true;
  if (!isAny) return std::nullopt;
  mesh = submesh(mesh.vertices, mesh.faces).mesh;
  const double distance = greatestDistance(component.vertices, component.faces,
                                           TriangleTree(mesh.vertices, mesh.faces));
  if (!task.wall.hides(distance)) return std::nullopt;
  return Mended{std::move(mesh), distance, crossing.size()};
}

/// Each component by `way`, which gets its crossing faces.
template <class Way>
MendedMesh withoutCrossings(const TriangleMesh& input, const Way& way) {
  const EdgeCounts edges = countEdges(input.vertices.rows(), input.faces);
  if (edges.boundary + edges.nonManifold + edges.incoherent > 0) return {input};
  MendedMesh result{input};
  std::vector<Submesh> components = componentMeshes(input.vertices, input.faces);
  std::size_t mended = 0;
  for (Submesh& component : components) {
    std::vector<int> crossing =
        selfIntersectingFaces(component.mesh.vertices, component.mesh.faces);
    if (crossing.empty()) continue;
    std::optional<Mended> better = way(component.mesh, crossing);
    if (!better) continue;
    mended += crossing.size() - better->left;
    result.distance = std::max(result.distance, better->distance);
    component.mesh = std::move(better->mesh);
  }
  if (mended == 0) return result;
  std::vector<TriangleMesh> parts;
  parts.reserve(components.size());
  for (Submesh& component : components) parts.push_back(std::move(component.mesh));
  result.mesh = assembled(parts);
  result.done = counted(mended, "crossing face", "crossing faces") + " replaced";
  return result;
}

} // namespace

MendedMesh withoutLocalCrossings(const TriangleMesh& input, const MendingTask& task) {
  return withoutCrossings(input, [&](const TriangleMesh& part, const std::vector<int>& crossing) {
    return mendedComponent(part, crossing, task);
  });
}

MendedMesh withFewerCrossings(const TriangleMesh& input, const MendingTask& task) {
  return withoutCrossings(input, [&](const TriangleMesh& part, const std::vector<int>& crossing) {
    std::optional<Mended> all = mendedComponent(part, crossing, task);
    return all ? std::move(all) : mendedPlaces(part, crossing, task);
  });
}

} // namespace massprops
