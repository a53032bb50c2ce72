#include "core/mesh/hole_filling.h"

#include "core/base/interruption.h"
#include "core/mesh/cgal_mesh.h"
#include "core/mesh/degenerate_faces.h"

#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/refine.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>

#include <iterator>
#include <random>
#include <utility>
#include <vector>

namespace massprops {
namespace {

using Mesh = SurfaceMesh;
namespace Processing = CGAL::Polygon_mesh_processing;

void requireLid(bool isClosed) {
  if (isClosed) return;
  throw InvalidInput(
      "An opening of the surface cannot be closed by a lid, which open_surface needs "
      "for its own calculations: straighten its border with Smoothing > Laplacian "
      "Smooth on the selected border, then run again.");
}

/// The points, moved by next to nothing: no two triangulations tie then, which CGAL tells apart by
/// where in memory their triangles lie.
Points untied(const Points& points) {
  constexpr double kNextToNothing = 1e-9; // of their extent
  const double most =
      kNextToNothing * (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
  std::minstd_rand random; // begins as always
  Points result = points;
  for (double& coordinate : result.reshaped<Eigen::RowMajor>())
    coordinate +=
        most * static_cast<double>(random()) / static_cast<double>(std::minstd_rand::max());
  return result;
}

} // namespace

TriangleMesh withOpeningsFilled(const TriangleMesh& open) {
  auto mesh = surfaceMesh(open.vertices, open.faces);
  std::vector<Mesh::Halfedge_index> loops;
  Processing::extract_boundary_cycles(mesh, std::back_inserter(loops));
  for (const Mesh::Halfedge_index loop : loops) {
    checkpoint();
    std::vector<Mesh::Face_index> lid;
    // Most openings are flat; their triangulation in the plane has no flat triangles.
    Processing::triangulate_hole(mesh, loop, std::back_inserter(lid),
                                 CGAL::parameters::use_2d_constrained_delaunay_triangulation(true));
    requireLid(!lid.empty());
    std::vector<Mesh::Face_index> addedFaces;
    std::vector<Mesh::Vertex_index> addedVertices;
    Processing::refine(mesh, lid, std::back_inserter(addedFaces),
                       std::back_inserter(addedVertices));
  }

  TriangleMesh closed = triangleMesh(mesh);
  closed.faces.topRows(open.faces.rows()) = open.faces;
  for (const int f : facesWithoutArea(closed.vertices, closed.faces)) {
    requireLid(f < open.faces.rows());
  }
  return closed;
}

Faces holeFilling(const TriangleMesh& patch, const std::vector<int>& border) {
  auto mesh = surfaceMesh(untied(patch.vertices), patch.faces);
  if (static_cast<Eigen::Index>(mesh.number_of_faces()) < patch.faces.rows()) return {};
  const auto vertex = [](int v) { return Mesh::Vertex_index(static_cast<Mesh::size_type>(v)); };
  const Mesh::Halfedge_index first = mesh.halfedge(vertex(border[0]), vertex(border[1]));
  if (!mesh.is_valid(first) || !mesh.is_border(first)) return {};
  std::vector<Mesh::Face_index> added;
  // The least area takes time up to the cube of the border's length: a long border is tried in a
  // plane, and among the triangles of a Delaunay triangulation.
  constexpr std::size_t kLong = 128;
  Processing::triangulate_hole(
      mesh, first, std::back_inserter(added),
      CGAL::parameters::use_2d_constrained_delaunay_triangulation(border.size() > kLong)
          .do_not_use_cubic_algorithm(border.size() > kLong));
  Faces faces(static_cast<Eigen::Index>(added.size()), 3);
  for (std::size_t i = 0; i < added.size(); ++i) {
    faces.row(static_cast<Eigen::Index>(i)) = cornersOf(mesh, added[i]);
  }
  return faces;
}

} // namespace massprops
