#include "core/validity.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Side_of_triangle_mesh.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/box_intersection_d.h>

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

using TriangleIterator = std::vector<Kernel::Triangle_3>::const_iterator;
using Box = CGAL::Box_intersection_d::Box_with_handle_d<double, 3, TriangleIterator>;

std::vector<Kernel::Triangle_3> triangles(const Points& vertices, const Faces& faces) {
  const auto point = [&](int v) {
    return Kernel::Point_3(vertices(v, 0), vertices(v, 1), vertices(v, 2));
  };
  std::vector<Kernel::Triangle_3> result;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    result.emplace_back(point(faces(f, 0)), point(faces(f, 1)), point(faces(f, 2)));
  }
  return result;
}

std::vector<Box> boxes(const std::vector<Kernel::Triangle_3>& triangles) {
  std::vector<Box> result;
  for (auto t = triangles.cbegin(); t != triangles.cend(); ++t) result.emplace_back(t->bbox(), t);
  return result;
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
  const std::vector<int> own = selfIntersectingFaces(inner, innerFaces);
  std::set<int> crossing(own.begin(), own.end());
  const std::vector<Kernel::Triangle_3> innerTriangles = triangles(inner, innerFaces);
  const std::vector<Kernel::Triangle_3> outerTriangles = triangles(outer, outerFaces);
  for (std::size_t f = 0; f < innerTriangles.size(); ++f) {
    if (innerTriangles[f].is_degenerate()) crossing.insert(static_cast<int>(f));
  }
  std::vector<Box> innerBoxes = boxes(innerTriangles);
  std::vector<Box> outerBoxes = boxes(outerTriangles);
  CGAL::box_intersection_d(innerBoxes.begin(), innerBoxes.end(), outerBoxes.begin(),
                           outerBoxes.end(), [&](const Box& a, const Box& b) {
                             if (CGAL::do_intersect(*a.handle(), *b.handle())) {
                               crossing.insert(
                                   static_cast<int>(a.handle() - innerTriangles.cbegin()));
                             }
                           });
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
