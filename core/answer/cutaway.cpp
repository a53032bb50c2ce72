#include "core/answer/cutaway.h"

#include "core/mesh/cgal_mesh.h"

#include <CGAL/Polygon_mesh_processing/clip.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace massprops {
namespace {

using Kernel = SurfaceKernel;
using Mesh = SurfaceMesh;

/// Of the body's size: cut points are rounded.
constexpr double kOnPlane = 1e-9;

} // namespace

std::optional<ColouredMesh> cutaway(const TriangleMesh& material, Eigen::Index cavityVertices,
                                    const Vec3& point, const Vec3& normal) {
  auto mesh = surfaceMesh(material.vertices, material.faces);
  mesh.set_recycle_garbage(false); // vertices are known by their numbers
  if (!CGAL::Polygon_mesh_processing::clip(
          mesh,
          Kernel::Plane_3(Kernel::Point_3(point.x(), point.y(), point.z()),
                          Kernel::Vector_3(normal.x(), normal.y(), normal.z())),
          CGAL::parameters::clip_volume(true))) {
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
