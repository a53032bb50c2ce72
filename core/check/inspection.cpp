#include "core/check/inspection.h"

#include "core/mesh/components.h"
#include "core/mesh/degenerate_faces.h"
#include "core/mesh/signed_volume.h"
#include "core/model/open_surface.h"
#include "core/query/nesting.h"
#include "core/query/point_in_mesh.h"
#include "core/query/self_intersection.h"
#include "core/query/triangle_distance.h"

#include <algorithm>
#include <initializer_list>

namespace massprops {
namespace {

double safely(double wall) {
  return (1.0 + kMeasured) * wall;
}

/// The vertices of these faces, ascending.
std::vector<int> verticesOf(const Faces& faces,
                            std::initializer_list<const std::vector<int>*> lists) {
  std::vector<int> vertices;
  for (const std::vector<int>* list : lists) {
    for (const int f : *list) {
      for (const int v : faces.row(f)) vertices.push_back(v);
    }
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

/// Adds what is not in the list yet, which stays ascending.
void add(const std::vector<int>& more, std::vector<int>& list) {
  list.insert(list.end(), more.begin(), more.end());
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
}

/// Of faces that cross each other or have no area, ascending.
std::vector<int> foldedVertices(const Points& points, const Faces& faces,
                                TriangleTree::Order order = TriangleTree::Order::Any) {
  const std::vector<int> folded = selfIntersectingFaces(points, faces, order);
  const std::vector<int> flat = facesWithoutArea(points, faces);
  return verticesOf(faces, {&folded, &flat});
}

std::vector<int> thinnerThan(double wall, const Eigen::Ref<const Vector>& walls) {
  std::vector<int> thin;
  for (Eigen::Index v = 0; v < walls.size(); ++v) {
    if (walls[v] < safely(wall)) thin.push_back(static_cast<int>(v));
  }
  return thin;
}

} // namespace

Inspection inspect(const Points& inner, const Faces& innerFaces, const TriangleTree& outer,
                   double wall, ClearanceQuery* clearance,
                   const std::function<Points(const Points&)>& stored) {
  Inspection inspection;
  add(foldedVertices(stored ? stored(inner) : inner, innerFaces, TriangleTree::Order::Spatial),
      inspection.crossing);
  ClearanceQuery fresh(outer);
  Clearance found =
      (clearance != nullptr ? *clearance : fresh).measure(inner, innerFaces, safely(wall));
  add(verticesOf(innerFaces, {&found.crossing}), inspection.crossing);
  inspection.wall = std::move(found.distance);
  inspection.leastWall = found.least;
  inspection.nearestFace = std::move(found.nearestFace);
  inspection.wallOfVertexAtLeast = std::move(found.vertexBounds);
  inspection.thin = thinnerThan(wall, inspection.wall);

  const Components components = connectedComponents(inner.rows(), innerFaces);
  inspection.components = static_cast<int>(components.size());
  const std::vector<int> depths = nestingDepths(inner, components);
  for (std::size_t c = 0; c < components.size(); ++c) {
    // What crosses the outer surface is reported above; else all of a component is inside, or
    // nothing.
    const bool inside = PointInMesh(outer).contains(inner, components[c]);
    const bool outward = signedVolume(inner, components[c]) > 0.0;
    if (inside && outward && depths[c] == 0) continue;
    add(std::vector<int>(components[c].data(), components[c].data() + components[c].size()),
        inspection.crossing);
  }
  return inspection;
}

std::vector<int> outerCrossings(const TriangleTree& outer,
                                const std::function<Points(const Points&)>& stored) {
  const std::vector<int> folds =
      stored ? selfIntersectingFaces(stored(outer.vertices()), outer.faces(),
                                     TriangleTree::Order::Spatial)
             : selfIntersectingFaces(outer);
  return verticesOf(outer.faces(), {&folds});
}

Inspection inspectShell(const Points& positions, const Faces& cavity, const TriangleTree& skin,
                        double wall, const std::function<Points(const Points&)>& stored) {
  const Eigen::Index n = positions.rows() / 2;
  Inspection inspection;
  const Faces shell = shellOf(skin.faces(), cavity, n);
  std::vector<int> bad = foldedVertices(stored ? stored(positions) : positions, shell);
  if (bad.empty()) {
    const Components parts = connectedComponents(positions.rows(), shell);
    const std::vector<int> depths = nestingDepths(positions, parts);
    for (std::size_t c = 0; c < parts.size(); ++c) {
      // Closed cavities lie in the material and face into it; the rest bounds it from outside.
      const double volume = signedVolume(positions, parts[c]);
      if (depths[c] == (volume > 0.0 ? 0 : 1)) continue;
      bad.insert(bad.end(), parts[c].data(), parts[c].data() + parts[c].size());
    }
  }
  for (int& v : bad) v = v < n ? v : v - static_cast<int>(n);
  add(bad, inspection.crossing);

  Clearance clearance =
      ClearanceQuery(skin).measure(positions, withoutStrips(cavity, n), safely(wall));
  inspection.wall = std::move(clearance.distance);
  inspection.wall.tail(n).setZero();
  inspection.leastWall = clearance.least;
  inspection.nearestFace = std::move(clearance.nearestFace);
  inspection.wallOfVertexAtLeast = std::move(clearance.vertexBounds);
  inspection.thin = thinnerThan(wall, inspection.wall.head(n));
  inspection.components = static_cast<int>(connectedComponents(positions.rows(), cavity).size());
  return inspection;
}

} // namespace massprops
