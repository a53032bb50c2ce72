#include "core/answer/cutaway.h"

#include "core/mesh/cgal_mesh.h"

#include <CGAL/Polygon_mesh_processing/corefinement.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace massprops {
namespace {

using Kernel = SurfaceKernel;
using Mesh = SurfaceMesh;

/// Of the body's size: cut points are rounded.
constexpr double kOnPlane = 1e-9;

/// A cube that holds all of the body on the side of the plane that `normal` points away from.
TriangleMesh halfSpace(const Points& body, const Vec3& point, const Vec3& normal) {
  const Vec3 low = body.colwise().minCoeff().transpose();
  const Vec3 high = body.colwise().maxCoeff().transpose();
  const Vec3 n = normal.normalized();
  const Vec3 u = n.unitOrthogonal();
  const Vec3 v = n.cross(u);
  const double height = n.dot(0.5 * (low + high) - point);
  const Vec3 foot = 0.5 * (low + high) - height * n;
  const double reach = (high - low).norm() + std::abs(height);
  TriangleMesh cube{Points(8, 3), Faces(12, 3)};
  for (int corner = 0; corner < 8; ++corner) {
    const double x = (corner & 1) != 0 ? reach : -reach;
    const double y = (corner & 2) != 0 ? reach : -reach;
    const double z = (corner & 4) != 0 ? 0.0 : -reach;
    cube.vertices.row(corner) = (foot + x * u + y * v + z * n).transpose();
  }
  cube.faces << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2,
      4, 6, 1, 3, 5, 3, 7, 5;
  return cube;
}

} // namespace

std::optional<ColouredMesh> cutaway(const TriangleMesh& material, Eigen::Index cavityVertices,
                                    const Vec3& point, const Vec3& normal) {
  auto mesh = surfaceMesh(material.vertices, material.faces);
  mesh.set_recycle_garbage(false); // vertices are known by their numbers
  // What PMP::clip does, without the half of it that cuts surfaces and takes as long to compile.
  const TriangleMesh beyond = halfSpace(material.vertices, point, normal);
  auto half = surfaceMesh(beyond.vertices, beyond.faces);
  if (!CGAL::Polygon_mesh_processing::corefine_and_compute_intersection(mesh, half, mesh)) {
    return std::nullopt;
  }

  const double onPlane =
      kOnPlane *
      (material.vertices.colwise().maxCoeff() - material.vertices.colwise().minCoeff()).norm();
  const auto positionOf = [&](Mesh::Vertex_index v) {
    const Kernel::Point_3& p = mesh.point(v);
    return Vec3(p.x(), p.y(), p.z());
  };
  const auto isOnPlane = [&](Mesh::Vertex_index v) {
    return std::abs(normal.dot(positionOf(v) - point)) <= onPlane * normal.norm();
  };

  // A piece of a surface that is not cut away has a corner of that surface, which keeps its number.
  enum Kind { Outer, Cavity, Cut };
  const Colour colours[] = {kOuterColour, kCavityColour, kCutColour};
  ColouredMesh result;
  std::vector<Vec3> points;
  std::vector<int> numbers[3];
  for (std::vector<int>& number : numbers) number.assign(mesh.num_vertices(), -1);
  result.mesh.faces.resize(static_cast<Eigen::Index>(mesh.number_of_faces()), 3);
  Eigen::Index row = 0;
  for (const Mesh::Face_index f : mesh.faces()) {
    std::vector<Mesh::Vertex_index> corners;
    for (const Mesh::Vertex_index v : mesh.vertices_around_face(mesh.halfedge(f))) {
      corners.push_back(v);
    }
    const std::size_t least = std::min({corners[0].idx(), corners[1].idx(), corners[2].idx()});
    const Kind kind = std::all_of(corners.begin(), corners.end(), isOnPlane) ? Cut
                      : least < static_cast<std::size_t>(cavityVertices)     ? Cavity
                                                                             : Outer;
    for (int k = 0; k < 3; ++k) {
      const Mesh::Vertex_index v = corners[static_cast<std::size_t>(k)];
      int& number = numbers[kind][v.idx()];
      if (number < 0) {
        number = static_cast<int>(points.size());
        points.push_back(positionOf(v));
        result.colours.push_back(colours[kind]);
      }
      result.mesh.faces(row, k) = number;
    }
    ++row;
  }
  result.mesh.vertices.resize(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t v = 0; v < points.size(); ++v) {
    result.mesh.vertices.row(static_cast<Eigen::Index>(v)) = points[v].transpose();
  }
  return result;
}

} // namespace massprops
