#include "core/drill/cutting.h"

#include "core/mesh/cgal_mesh.h"
#include "core/mesh/components.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/degenerate_faces.h"
#include "core/mesh/signed_volume.h"
#include "core/query/self_intersection.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace massprops {
namespace {

using Exact = CGAL::Exact_predicates_exact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Exact::Point_3>;

/// Corner k, k + 1 and k + 2, the one with the smallest number first.
Eigen::RowVector3i smallestFirst(const Eigen::RowVector3i& corners) {
  Eigen::Index k = 0;
  corners.minCoeff(&k);
  return {corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]};
}

/// The vertices that were `given` under their number, and faces of these alone, keep their order;
/// the others are sorted: in CGAL's it depends on where in memory its boxes are.
TriangleMesh rounded(const Mesh& mesh, const Points& given,
                     const std::function<Points(const Points&)>& representable) {
  using Place = std::pair<std::array<double, 3>, std::size_t>; // with the vertex's number
  std::vector<Place> places;
  std::vector<Place> others;
  for (const auto v : mesh.vertices()) {
    const Exact::Point_3& p = mesh.point(v);
    const Vec3 place(CGAL::to_double(CGAL::exact(p.x())), CGAL::to_double(CGAL::exact(p.y())),
                     CGAL::to_double(CGAL::exact(p.z())));
    const auto row = static_cast<Eigen::Index>(v.idx());
    const bool isOld = row < given.rows() && given.row(row) == place.transpose();
    (isOld ? places : others).push_back({{place.x(), place.y(), place.z()}, v.idx()});
  }
  const auto old = static_cast<int>(places.size());
  std::sort(others.begin(), others.end());
  places.insert(places.end(), others.begin(), others.end());
  TriangleMesh result{Points(static_cast<Eigen::Index>(places.size()), 3), Faces()};
  std::vector<int> number(mesh.number_of_vertices() + mesh.number_of_removed_vertices(), -1);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto& [p, v] = places[i];
    result.vertices.row(static_cast<Eigen::Index>(i)) << p[0], p[1], p[2];
    number[v] = static_cast<int>(i);
  }
  std::vector<Eigen::RowVector3i> faces;
  std::vector<Eigen::RowVector3i> cut;
  for (const auto f : mesh.faces()) {
    const Eigen::RowVector3i corners =
        smallestFirst(cornersOf(mesh, f).unaryExpr([&](int v) { return number[v]; }));
    (corners.maxCoeff() < old ? faces : cut).push_back(corners);
  }
  std::sort(cut.begin(), cut.end(), [](const auto& a, const auto& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  });
  faces.insert(faces.end(), cut.begin(), cut.end());
  result.faces.resize(static_cast<Eigen::Index>(faces.size()), 3);
  for (std::size_t i = 0; i < faces.size(); ++i)
    result.faces.row(static_cast<Eigen::Index>(i)) = faces[i];
  result.vertices = representable(result.vertices);
  return result;
}

Eigen::Index eulerCharacteristic(const TriangleMesh& mesh) {
  // Every edge has two faces.
  return mesh.vertices.rows() - mesh.faces.rows() / 2;
}

std::size_t componentCount(const TriangleMesh& mesh) {
  return connectedComponents(mesh.vertices.rows(), mesh.faces).size();
}

bool isSound(const TriangleMesh& mesh) {
  if (mesh.faces.rows() == 0) return false;
  const EdgeCounts edges = countEdges(mesh.vertices.rows(), mesh.faces);
  return edges.boundary + edges.nonManifold + edges.incoherent == 0 &&
         facesWithoutArea(mesh.vertices, mesh.faces).empty() &&
         selfIntersectingFaces(mesh.vertices, mesh.faces).empty();
}

/// The pieces that are left of so many when each hole joins a cavity with the body around it.
struct Expected {
  Eigen::Index euler;
  std::size_t components;
};

class Cutter {
public:
  Cutter(const TriangleMesh& material, const std::vector<Hole>& holes, Expected expected,
         const std::function<Points(const Points&)>& representable)
      : material_(material), holes_(holes), expected_(expected), representable_(representable) {}

  std::optional<TriangleMesh> body() const {
    Mesh mesh = surfaceMesh<Mesh>(material_.vertices, material_.faces);
    const TriangleMesh all = drillsFor(0.0);
    Mesh drills = surfaceMesh<Mesh>(all.vertices, all.faces);
    if (!CGAL::Polygon_mesh_processing::corefine_and_compute_difference(mesh, drills, mesh)) {
      return {};
    }
    TriangleMesh result = rounded(mesh, material_.vertices, representable_);
    const bool isAsExpected = eulerCharacteristic(result) == expected_.euler &&
                              componentCount(result) == expected_.components;
    return isAsExpected && isSound(result) ? std::optional(std::move(result)) : std::nullopt;
  }

  std::optional<std::vector<TriangleMesh>> plugs(double clearance) const {
    Mesh mesh = surfaceMesh<Mesh>(material_.vertices, material_.faces);
    const TriangleMesh whole = drillsFor(clearance);
    Mesh drills = surfaceMesh<Mesh>(whole.vertices, whole.faces);
    if (!CGAL::Polygon_mesh_processing::corefine_and_compute_intersection(mesh, drills, drills)) {
      return {};
    }
    const TriangleMesh all = rounded(drills, whole.vertices, representable_);
    if (!isSound(all)) return {};
    std::vector<TriangleMesh> result;
    for (Submesh& part : componentMeshes(all.vertices, all.faces)) {
      if (eulerCharacteristic(part.mesh) != 2) return {};
      result.push_back(std::move(part.mesh));
    }
    return result.size() == holes_.size() ? std::optional(std::move(result)) : std::nullopt;
  }

private:
  TriangleMesh drillsFor(double clearance) const {
    std::vector<TriangleMesh> drills;
    for (const Hole& hole : holes_) drills.push_back(drillOf(hole, clearance));
    return assembled(drills);
  }

  const TriangleMesh& material_;
  const std::vector<Hole>& holes_;
  Expected expected_;
  const std::function<Points(const Points&)>& representable_;
};

} // namespace

std::optional<DrilledBody> drilled(const TriangleMesh& outer, const TriangleMesh& cavity,
                                   const std::vector<Hole>& holes, double clearance,
                                   const std::function<Points(const Points&)>& representable) {
  TriangleMesh inwards = submesh(cavity.vertices, cavity.faces).mesh;
  flip(inwards.faces);
  const TriangleMesh material =
      assembled({submesh(outer.vertices, outer.faces).mesh, std::move(inwards)});
  Expected expected{eulerCharacteristic(material) - 2 * static_cast<Eigen::Index>(holes.size()),
                    componentCount({outer.vertices, outer.faces})};
  const Cutter cutter(material, holes, expected, representable);
  std::optional<TriangleMesh> body = cutter.body();
  if (!body) return {};
  std::optional<std::vector<TriangleMesh>> plugs = cutter.plugs(clearance);
  if (!plugs) return {};
  return DrilledBody{std::move(*body), std::move(*plugs)};
}

} // namespace massprops
