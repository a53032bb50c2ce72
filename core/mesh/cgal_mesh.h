// Triangles as the mesh type that CGAL's algorithms take, and back. For the sources that use these
// alone.
#pragma once

#include "core/base/types.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

namespace massprops {

using SurfaceKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<SurfaceKernel::Point_3>;

/// Vertices and faces keep their numbers where every edge has one or two faces, which agree in
/// orientation, and every vertex one fan of them; a face that breaks this is left out.
template <class Mesh = SurfaceMesh>
Mesh surfaceMesh(const Points& vertices, const Faces& faces) {
  using Size = typename Mesh::size_type;
  Mesh mesh;
  const auto n = static_cast<Size>(vertices.rows());
  const auto m = static_cast<Size>(faces.rows());
  mesh.reserve(n, n + m, m);
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    mesh.add_vertex({vertices(v, 0), vertices(v, 1), vertices(v, 2)});
  }
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const auto at = [&](int k) {
      return typename Mesh::Vertex_index(static_cast<Size>(faces(f, k)));
    };
    mesh.add_face(at(0), at(1), at(2));
  }
  return mesh;
}

/// The corners of a triangle, from the one that CGAL lists first.
template <class Mesh>
Eigen::RowVector3i cornersOf(const Mesh& mesh, typename Mesh::Face_index face) {
  Eigen::RowVector3i corners;
  int k = 0;
  for (const auto v : mesh.vertices_around_face(mesh.halfedge(face))) {
    corners[k++] = static_cast<int>(v.idx());
  }
  return corners;
}

/// Vertices and faces keep their numbers. \pre triangles, and no garbage
template <class Mesh>
TriangleMesh triangleMesh(const Mesh& mesh) {
  TriangleMesh triangles{Points(static_cast<Eigen::Index>(mesh.number_of_vertices()), 3),
                         Faces(static_cast<Eigen::Index>(mesh.number_of_faces()), 3)};
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    triangles.vertices.row(static_cast<Eigen::Index>(v.idx())) << p.x(), p.y(), p.z();
  }
  for (const auto f : mesh.faces()) {
    triangles.faces.row(static_cast<Eigen::Index>(f.idx())) = cornersOf(mesh, f);
  }
  return triangles;
}

} // namespace massprops
