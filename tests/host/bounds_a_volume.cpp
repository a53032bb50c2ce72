// usage: bounds_a_volume <mesh file> ...
// Whether all triangles of all files together are the closed, correctly oriented boundary of a
// solid that does not cross itself, decided by CGAL's exact predicates. Status 0: they are.

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/repair_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>

#include <cstddef>
#include <cstdio>
#include <exception>
#include <vector>

namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using Triangle = std::vector<std::size_t>;

int refuse(const char* reason) {
  std::printf("%s\n", reason);
  return 1;
}

int run(int argc, char** argv) {
  std::vector<Point> points;
  std::vector<Triangle> triangles;
  for (int i = 1; i < argc; ++i) {
    std::vector<Point> filePoints;
    std::vector<Triangle> fileTriangles;
    if (!CGAL::IO::read_polygon_soup(argv[i], filePoints, fileTriangles)) {
      return refuse("a file cannot be read");
    }
    const std::size_t offset = points.size();
    points.insert(points.end(), filePoints.begin(), filePoints.end());
    for (Triangle& triangle : fileTriangles) {
      for (std::size_t& corner : triangle) corner += offset;
      triangles.push_back(triangle);
    }
  }
  // STL knows no shared vertices.
  const std::size_t all = triangles.size();
  PMP::repair_polygon_soup(points, triangles);
  if (triangles.empty()) return refuse("there are no triangles");
  if (triangles.size() != all) return refuse("some triangles are degenerate or double");
  if (!PMP::is_polygon_soup_a_polygon_mesh(triangles)) return refuse("the surface is not manifold");
  CGAL::Surface_mesh<Point> mesh;
  PMP::polygon_soup_to_polygon_mesh(points, triangles, mesh);
  if (!CGAL::is_closed(mesh)) return refuse("the surface is open");
  if (PMP::does_self_intersect(mesh)) return refuse("the surface crosses itself");
  if (!PMP::does_bound_a_volume(mesh)) return refuse("the surface is oriented wrongly");
  std::printf("%zu triangles bound a volume\n", triangles.size());
  return 0;
}

} // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  }
}
