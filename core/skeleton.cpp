#include "core/skeleton.h"

#include "core/arena_allocator.h"
#include "core/components.h"
#include "core/spatial.h"

// The skeletonisation orders its edges by their address [CGAL issue 7511], and its mesh type takes
// its allocator from this macro: nodes from an arena have addresses in the order of their creation.
#define CGAL_ALLOCATOR(T) massprops::ArenaAllocator<T>
#include <CGAL/Polyhedron_3_fwd.h>
#undef CGAL_ALLOCATOR
#define CGAL_ALLOCATOR(T) std::allocator<T>

#include <CGAL/Mean_curvature_flow_skeletonization.h>
#include <CGAL/Random.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>

#include <cmath>
#include <limits>
#include <stdexcept>

namespace massprops {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
/// Of this file alone: another instantiation of the skeletonisation, with CGAL's own allocator,
/// would have the same name to the linker, which keeps one of them for both.
struct FlowKernel : Kernel {
  /// The flow asks whether Voronoi poles are inside, by rays from them, and tries again for ever
  /// when the pole of points that are all but in a plane is no number. Such a one is outside.
  struct Construct_ray_3 {
    Ray_3 operator()(const Point_3& from, const Vector_3& direction) const {
      const bool isPoint =
          std::isfinite(from.x()) && std::isfinite(from.y()) && std::isfinite(from.z());
      if (raysLeft == 0)
        throw std::runtime_error("the mean curvature flow does not come to an end");
      --raysLeft;
      return isPoint ? Ray_3(from, direction) : Ray_3(Point_3(kFar, kFar, kFar), direction);
    }
    Ray_3 operator()(const Point_3& from, const Point_3& to) const { return {from, to}; }
  };
  Construct_ray_3 construct_ray_3_object() const { return {}; }

  static constexpr double kFar = 1e3;
  static thread_local std::size_t raysLeft;
};
thread_local std::size_t FlowKernel::raysLeft = 0;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Skeletonization = CGAL::Mean_curvature_flow_skeletonization<Mesh, FlowKernel>;

Mesh cgalMesh(const Points& vertices, const Faces& faces) {
  Mesh mesh;
  const auto n = static_cast<Mesh::size_type>(vertices.rows());
  const auto m = static_cast<Mesh::size_type>(faces.rows());
  mesh.reserve(n, n + m, m);
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    mesh.add_vertex({vertices(v, 0), vertices(v, 1), vertices(v, 2)});
  }
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    mesh.add_face(Mesh::Vertex_index(static_cast<Mesh::size_type>(faces(f, 0))),
                  Mesh::Vertex_index(static_cast<Mesh::size_type>(faces(f, 1))),
                  Mesh::Vertex_index(static_cast<Mesh::size_type>(faces(f, 2))));
  }
  return mesh;
}

/// Edges that are shorter collapse while the flow contracts the surface, of the diagonal; twice of
/// what CGAL takes halves the time and changes the skeleton by less than its noise.
constexpr double kLeastEdge = 0.003;

double diagonalOf(const Points& vertices) {
  return (vertices.colwise().maxCoeff() - vertices.colwise().minCoeff()).norm();
}

/// Of one component.
/// \throw std::exception when the flow does not come to an end or loses a vertex
Points contractedPoints(const Points& vertices, const Faces& faces, std::size_t bytesPerVertex) {
  const ArenaScope arena(bytesPerVertex * static_cast<std::size_t>(vertices.rows()));
  CGAL::get_default_random() = CGAL::Random(0);
  // One ray a vertex and step, of which there are up to 500, and as many again.
  FlowKernel::raysLeft = 1000 * static_cast<std::size_t>(vertices.rows());
  const Mesh mesh = cgalMesh(vertices, faces);
  Skeletonization::Skeleton skeleton;
  {
    Skeletonization flow(mesh);
    flow.set_min_edge_length(kLeastEdge * diagonalOf(vertices));
    flow.contract_until_convergence();
    flow.convert_to_skeleton(skeleton);
  }
  Points points = Points::Constant(vertices.rows(), 3, std::numeric_limits<double>::quiet_NaN());
  for (const auto node : CGAL::make_range(boost::vertices(skeleton))) {
    const Kernel::Point_3& p = skeleton[node].point;
    for (const auto vertex : skeleton[node].vertices) {
      points.row(static_cast<Eigen::Index>(vertex)) << p.x(), p.y(), p.z();
    }
  }
  if (!points.allFinite()) {
    throw std::runtime_error("the mean curvature flow lost a vertex of this mesh");
  }
  return points;
}

Points halfWayThrough(const Points& vertices, const Faces& faces) {
  Points inward = Points::Zero(vertices.rows(), 3);
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const Vec3 a = vertices.row(faces(f, 0)).transpose();
    const Vec3 b = vertices.row(faces(f, 1)).transpose();
    const Vec3 c = vertices.row(faces(f, 2)).transpose();
    for (const int v : faces.row(f)) inward.row(v) -= (b - a).cross(c - a).transpose();
  }
  inward.rowwise().normalize();
  const Vector half =
      0.5 * chords(TriangleTree(vertices, faces), vertices, inward).cwiseMin(diagonalOf(vertices));
  return vertices + half.asDiagonal() * inward;
}

} // namespace

Skeleton meanCurvatureSkeleton(const Points& vertices, const Faces& faces,
                               std::size_t flowBytesPerVertex) {
  Skeleton skeleton{Points(vertices.rows(), 3), 0};
  for (const Faces& component : connectedComponents(vertices.rows(), faces)) {
    const Submesh part = submesh(vertices, component);
    Points points;
    try {
      points = contractedPoints(part.mesh.vertices, part.mesh.faces, flowBytesPerVertex);
    } catch (const std::exception&) {
      points = halfWayThrough(part.mesh.vertices, part.mesh.faces);
      ++skeleton.failedComponents;
    }
    for (std::size_t i = 0; i < part.vertexOf.size(); ++i) {
      skeleton.points.row(part.vertexOf[i]) = points.row(static_cast<Eigen::Index>(i));
    }
  }
  return skeleton;
}

} // namespace massprops
