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
};

/// One component without its crossings; empty where that fails.
std::optional<Mended> mendedComponent(const TriangleMesh& component,
                                      const std::vector<int>& crossing, const MendingTask& task) {
  constexpr double kMostVolume = 0.005;
  constexpr double kMostFaces = 0.1;
  constexpr std::size_t kFew = 100;
  const auto isMany = [](std::size_t crossings, Eigen::Index faces) {
    return crossings > kFew &&
           static_cast<double>(crossings) > kMostFaces * static_cast<double>(faces);
  };
  if (isMany(crossing.size(), component.faces.rows())) return std::nullopt;
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
      if (isMany(present.size(), mesh.faces.rows())) break;
    }
    const bool isKept = std::abs(signedVolume(mesh.vertices, mesh.faces) - volume) <=
                        kMostVolume * std::abs(volume);
    if (present.empty() && isKept && distance <= task.wall) {
      return Mended{submesh(mesh.vertices, mesh.faces).mesh, distance};
    }
  }
  return std::nullopt;
}

} // namespace

MendedMesh withoutLocalCrossings(const TriangleMesh& input, const MendingTask& task) {
  const EdgeCounts edges = countEdges(input.vertices.rows(), input.faces);
  if (edges.boundary + edges.nonManifold + edges.incoherent > 0) return {input};
  MendedMesh result{input};
  std::vector<Submesh> components = componentMeshes(input.vertices, input.faces);
  std::size_t mended = 0;
  for (Submesh& component : components) {
    std::vector<int> crossing =
        selfIntersectingFaces(component.mesh.vertices, component.mesh.faces);
    if (crossing.empty()) continue;
    std::optional<Mended> better = mendedComponent(component.mesh, crossing, task);
    if (!better) continue;
    mended += crossing.size();
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

} // namespace massprops
