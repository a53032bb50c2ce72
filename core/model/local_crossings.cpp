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
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace massprops {
namespace {

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

/// Rings of faces that go with those that cross, at most.
constexpr int kMostRings = 2;
/// A hole with more edges is no small place.
constexpr std::size_t kLongestBorder = 400;

Faces facesOf(const TriangleMesh& mesh, const std::vector<char>& isMarked) {
  Faces marked(mesh.faces.rows(), 3);
  Eigen::Index rows = 0;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    if (isMarked[at(f)] != 0) marked.row(rows++) = mesh.faces.row(f);
  }
  marked.conservativeResize(rows, 3);
  return marked;
}

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

/// Faces that have vertices in common, and what is around them.
struct Place {
  std::vector<int> faces;
  std::vector<std::vector<int>> borders; ///< loops in the sense of these faces
};

/// The loops around the faces of one number; empty where they touch or are no small place's.
std::vector<std::vector<int>> bordersOf(const TriangleMesh& mesh, const std::vector<int>& opposite,
                                        const std::vector<int>& some,
                                        const std::vector<int>& number) {
  std::map<int, int> next;
  for (const int f : some) {
    for (int k = 0; k < 3; ++k) {
      const int h = 3 * f + k;
      if (number[at(opposite[at(h)] / 3)] == number[at(f)]) continue;
      const bool isNew = next.emplace(mesh.faces(f, k), mesh.faces.data()[nextHalfEdge(h)]).second;
      if (!isNew) return {};
    }
  }
  std::vector<std::vector<int>> borders;
  while (!next.empty()) {
    std::vector<int> border;
    for (auto v = next.begin(); v != next.end();) {
      border.push_back(v->first);
      const int w = v->second;
      next.erase(v);
      v = next.find(w);
    }
    if (border.size() < 3 || border.size() > kLongestBorder) return {};
    borders.push_back(std::move(border));
  }
  return borders;
}

std::vector<Place> placesOf(const TriangleMesh& mesh, const std::vector<char>& isMarked) {
  const std::vector<int> vertexNumber =
      componentNumbers(mesh.vertices.rows(), facesOf(mesh, isMarked));
  std::vector<int> number(at(mesh.faces.rows()), -1);
  std::vector<Place> places;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    if (isMarked[at(f)] == 0) continue;
    number[at(f)] = vertexNumber[at(mesh.faces(f, 0))];
    if (places.size() <= at(number[at(f)])) places.resize(at(number[at(f)]) + 1);
    places[at(number[at(f)])].faces.push_back(static_cast<int>(f));
  }
  const std::vector<int> opposite = oppositeHalfEdges(mesh.vertices.rows(), mesh.faces);
  for (Place& place : places) place.borders = bordersOf(mesh, opposite, place.faces, number);
  return places;
}

/// Triangles in the loop; none where there are none to be had. `corners`: of the faces around it.
Faces filling(const TriangleMesh& mesh, const VertexCorners& corners, const Faces& kept,
              const std::vector<int>& border) {
  std::vector<int> around;
  for (const int v : border) {
    for (const int c : corners.at(v)) around.push_back(c / 3);
  }
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  Faces faces(static_cast<Eigen::Index>(around.size()), 3);
  for (std::size_t i = 0; i < around.size(); ++i)
    faces.row(static_cast<Eigen::Index>(i)) = kept.row(around[i]);
  const Submesh patch = submesh(mesh.vertices, faces);
  std::vector<int> local;
  for (const int v : border) {
    const auto found = std::lower_bound(patch.vertexOf.begin(), patch.vertexOf.end(), v);
    local.push_back(static_cast<int>(found - patch.vertexOf.begin()));
  }
  return holeFilling(patch.mesh, local).unaryExpr([&](int v) { return patch.vertexOf[at(v)]; });
}

/// New faces for those of the place; none where that fails or adds or takes more volume than
/// `most`.
std::vector<Faces> fillings(const TriangleMesh& mesh, const VertexCorners& corners,
                            const Faces& kept, const Place& place, double most) {
  std::vector<Faces> result;
  for (const std::vector<int>& border : place.borders) {
    if (corners.at(border.front()).size() == 0) continue; // of what has fallen off
    result.push_back(filling(mesh, corners, kept, border));
    if (result.back().rows() == 0) return {};
  }
  // Between the old faces and the new ones.
  Faces old(static_cast<Eigen::Index>(place.faces.size()), 3);
  for (std::size_t i = 0; i < place.faces.size(); ++i)
    old.row(static_cast<Eigen::Index>(i)) = mesh.faces.row(place.faces[i]);
  flip(old);
  std::vector<Faces> both = result;
  both.push_back(old);
  if (!(std::abs(signedVolume(mesh.vertices, joined(both))) <= most)) return {};
  return result;
}

/// The surface with new faces in these places; where that fails the place stays as it is, or, where
/// `all` are to be replaced, nothing comes of it. Of what falls apart the largest stays; the rest
/// is what crossed.
std::optional<TriangleMesh> replaced(const TriangleMesh& mesh, std::vector<Place> places,
                                     double mostVolume, bool all) {
  const auto fails = [](const Place& place) { return place.borders.empty(); };
  for (;;) {
    if (all && std::any_of(places.begin(), places.end(), fails)) return std::nullopt;
    std::vector<char> stays(at(mesh.faces.rows()), 1);
    for (const Place& place : places) {
      for (const int f : place.faces) stays[at(f)] = fails(place) ? 1 : 0;
    }
    const Components parts = connectedComponents(mesh.vertices.rows(), facesOf(mesh, stays));
    if (parts.empty()) return std::nullopt;
    const Faces kept =
        *std::max_element(parts.begin(), parts.end(), [&](const Faces& a, const Faces& b) {
          return surfaceArea(mesh.vertices, a) < surfaceArea(mesh.vertices, b);
        });
    const VertexCorners corners = vertexCorners(mesh.vertices.rows(), kept);
    std::vector<Faces> pieces{kept};
    bool hasFailed = false;
    for (Place& place : places) {
      if (fails(place)) continue;
      std::vector<Faces> found = fillings(mesh, corners, kept, place, mostVolume);
      if (found.empty()) place.borders.clear();
      hasFailed = hasFailed || found.empty();
      pieces.insert(pieces.end(), found.begin(), found.end());
    }
    if (hasFailed) continue;
    const Faces faces = joined(pieces);
    const EdgeCounts edges = countEdges(mesh.vertices.rows(), faces);
    if (edges.boundary + edges.nonManifold + edges.incoherent > 0) return std::nullopt;
    return TriangleMesh{mesh.vertices, faces};
  }
}

struct Mended {
  TriangleMesh mesh;
  double distance;
  std::size_t left; ///< faces that go on crossing
};

/// So many that this is no matter of a few places.
bool areMany(const std::vector<int>& crossing, const TriangleMesh& mesh) {
  constexpr double kMostFaces = 0.1;
  constexpr std::size_t kFew = 100;
  return crossing.size() > kFew &&
         static_cast<double>(crossing.size()) > kMostFaces * static_cast<double>(mesh.faces.rows());
}

/// One component with fewer crossings, each place with as few rings around it as it takes; empty
/// where none can be mended, or not all and `all` are to be.
std::optional<Mended> mendedComponent(const TriangleMesh& component,
                                      const std::vector<int>& crossing, const MendingTask& task,
                                      bool all) {
  if (areMany(crossing, component)) return std::nullopt;
  constexpr double kMostChange = 0.005;
  const double volume = signedVolume(component.vertices, component.faces);
  const double most = kMostChange * std::abs(volume);
  Mended result{component, 0.0, crossing.size()};
  std::vector<int> present = crossing;
  for (int rings = 0; rings <= kMostRings && !present.empty(); ++rings) {
    const TriangleMesh& mesh = result.mesh;
    std::vector<char> isMarked(at(mesh.faces.rows()), 0);
    for (const int f : present) isMarked[at(f)] = 1;
    for (int ring = 0; ring < rings; ++ring) grow(mesh, isMarked);
    std::optional<TriangleMesh> next = replaced(mesh, placesOf(mesh, isMarked), most, all);
    if (!next || std::abs(signedVolume(next->vertices, next->faces) - volume) > most) continue;
    // What is new may cross, too.
    std::vector<int> others = selfIntersectingFaces(next->vertices, next->faces);
    if (others.size() >= present.size()) continue;
    result.distance += greatestDistance(mesh.vertices, facesOf(mesh, isMarked),
                                        TriangleTree(next->vertices, next->faces));
    result.mesh = *std::move(next);
    present = std::move(others);
  }
  result.left = present.size();
  if (result.left == crossing.size() || (all && result.left > 0) ||
      !task.wall.hides(result.distance))
    return std::nullopt;
  result.mesh = submesh(result.mesh.vertices, result.mesh.faces).mesh;
  return result;
}

MendedMesh mended(const TriangleMesh& input, const MendingTask& task, bool all) {
  const EdgeCounts edges = countEdges(input.vertices.rows(), input.faces);
  if (edges.boundary + edges.nonManifold + edges.incoherent > 0) return {input};
  MendedMesh result{input};
  std::vector<TriangleMesh> parts;
  std::size_t mended = 0;
  for (Submesh& component : componentMeshes(input.vertices, input.faces)) {
    const std::vector<int> crossing =
        selfIntersectingFaces(component.mesh.vertices, component.mesh.faces);
    std::optional<Mended> better;
    if (!crossing.empty()) better = mendedComponent(component.mesh, crossing, task, all);
    parts.push_back(std::move(better ? better->mesh : component.mesh));
    if (!better) continue;
    mended += crossing.size() - better->left;
    result.distance = std::max(result.distance, better->distance);
  }
  if (mended == 0) return result;
  result.mesh = assembled(parts);
  result.done = counted(mended, "crossing face", "crossing faces") + " replaced";
  return result;
}

} // namespace

MendedMesh withoutLocalCrossings(const TriangleMesh& input, const MendingTask& task) {
  return mended(input, task, true);
}

MendedMesh withFewerCrossings(const TriangleMesh& input, const MendingTask& task) {
  return mended(input, task, false);
}

} // namespace massprops
