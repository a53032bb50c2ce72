#include "core/validity.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>

#include <set>
#include <stdexcept>
#include <utility>

namespace massprops {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using FacePairs = std::vector<std::pair<Mesh::Face_index, Mesh::Face_index>>;

void append(Mesh& mesh, const Points& vertices, const Faces& faces) {
  const auto base = static_cast<Mesh::size_type>(mesh.number_of_vertices());
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    mesh.add_vertex({vertices(v, 0), vertices(v, 1), vertices(v, 2)});
  }
  const auto vertex = [&](int v) {
    return Mesh::Vertex_index(base + static_cast<Mesh::size_type>(v));
  };
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    if (mesh.add_face(vertex(faces(f, 0)), vertex(faces(f, 1)), vertex(faces(f, 2))) ==
        Mesh::null_face()) {
      throw std::logic_error("a surface to be checked is not manifold");
    }
  }
}

FacePairs intersections(const Mesh& mesh) {
  FacePairs pairs;
  CGAL::Polygon_mesh_processing::self_intersections<CGAL::Sequential_tag>(
      mesh, std::back_inserter(pairs));
  return pairs;
}

} // namespace

std::vector<int> selfIntersectingFaces(const Points& vertices, const Faces& faces) {
  Mesh mesh;
  append(mesh, vertices, faces);
  std::set<int> crossing;
  for (const auto& [a, b] : intersections(mesh)) {
    crossing.insert(static_cast<int>(a.idx()));
    crossing.insert(static_cast<int>(b.idx()));
  }
  return {crossing.begin(), crossing.end()};
}

std::vector<int> crossingFaces(const Points& inner, const Faces& innerFaces, const Points& outer,
                               const Faces& outerFaces) {
  Mesh mesh;
  append(mesh, inner, innerFaces);
  append(mesh, outer, outerFaces);
  const auto innerCount = static_cast<int>(innerFaces.rows());
  std::set<int> crossing;
  for (const auto& [a, b] : intersections(mesh)) {
    for (const auto face : {static_cast<int>(a.idx()), static_cast<int>(b.idx())}) {
      if (face < innerCount) crossing.insert(face);
    }
  }
  return {crossing.begin(), crossing.end()};
}

std::vector<bool> insideOf(const Points& points, const Points& surface, const Faces& faces) {
  Mesh mesh;
  append(mesh, surface, faces);
  const CGAL::Side_of_triangle_mesh<Mesh, Kernel> side(mesh);
  std::vector<bool> inside;
  for (Eigen::Index p = 0; p < points.rows(); ++p) {
    inside.push_back(side({points(p, 0), points(p, 1), points(p, 2)}) == CGAL::ON_BOUNDED_SIDE);
  }
  return inside;
}

} // namespace massprops
