#include "core/skeleton.h"

#include "core/arena_allocator.h"

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

#include <stdexcept>
#include <vector>

namespace massprops {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Skeletonization = CGAL::Mean_curvature_flow_skeletonization<Mesh>;

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

} // namespace

Points meanCurvatureSkeleton(const Points& vertices, const Faces& faces) {
  const ArenaScope arena(static_cast<std::size_t>(vertices.rows()));
  CGAL::get_default_random() = CGAL::Random(0);
  const Mesh mesh = cgalMesh(vertices, faces);
  Skeletonization::Skeleton skeleton;
  {
    Skeletonization flow(mesh);
    flow.contract_until_convergence();
    flow.convert_to_skeleton(skeleton);
  }
  Points points(vertices.rows(), 3);
  std::vector<char> reached(static_cast<std::size_t>(vertices.rows()), 0);
  for (const auto node : CGAL::make_range(boost::vertices(skeleton))) {
    const Kernel::Point_3& p = skeleton[node].point;
    for (const auto vertex : skeleton[node].vertices) {
      const auto v = static_cast<std::size_t>(vertex);
      points.row(static_cast<Eigen::Index>(v)) << p.x(), p.y(), p.z();
      reached[v] = 1;
    }
  }
  for (const char r : reached) {
    if (r == 0) throw std::runtime_error("the mean curvature flow lost a vertex of this mesh");
  }
  return points;
}

} // namespace massprops
