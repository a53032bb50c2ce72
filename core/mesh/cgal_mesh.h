// Triangles as the mesh type that CGAL's algorithms take. For the sources that use these alone.
#pragma once

#include "core/base/types.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>

namespace massprops {

using SurfaceKernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<SurfaceKernel::Point_3>;

/// Vertices and faces keep their numbers. \pre every edge has one or two faces, which agree in
/// orientation, and every vertex one fan of them
inline SurfaceMesh surfaceMesh(const TriangleMesh& triangles) {
  SurfaceMesh mesh;
  for (Eigen::Index v = 0; v < triangles.vertices.rows(); ++v) {
    mesh.add_vertex({triangles.vertices(v, 0), triangles.vertices(v, 1), triangles.vertices(v, 2)});
  }
  for (Eigen::Index f = 0; f < triangles.faces.rows(); ++f) {
    const auto at = [&](int k) {
      return SurfaceMesh::Vertex_index(static_cast<SurfaceMesh::size_type>(triangles.faces(f, k)));
    };
    mesh.add_face(at(0), at(1), at(2));
  }
  return mesh;
}

} // namespace massprops
