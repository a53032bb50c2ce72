#include "command_line/text_files.h"

#include <CGAL/IO/OBJ.h>
#include <CGAL/IO/OFF.h>
#include <CGAL/Simple_cartesian.h>

#include <array>
#include <vector>

namespace massprops {
namespace {

using Point = CGAL::Simple_cartesian<double>::Point_3;

struct Soup {
  std::vector<Point> points;
  std::vector<std::vector<int>> polygons;
};

Soup soupOf(const TriangleMesh& mesh) {
  Soup soup;
  soup.points.reserve(static_cast<std::size_t>(mesh.vertices.rows()));
  for (const auto& p : mesh.vertices.rowwise()) soup.points.emplace_back(p.x(), p.y(), p.z());
  soup.polygons.reserve(static_cast<std::size_t>(mesh.faces.rows()));
  for (const auto& f : mesh.faces.rowwise()) soup.polygons.push_back({f[0], f[1], f[2]});
  return soup;
}

/// Digits that tell every double from its neighbours.
auto allDigits() {
  return CGAL::parameters::stream_precision(17);
}

} // namespace

bool readObj(const std::string& path, TriangleMesh& mesh) {
  Soup soup;
  if (!CGAL::IO::read_OBJ(path, soup.points, soup.polygons)) return false;
  mesh.vertices.resize(static_cast<Eigen::Index>(soup.points.size()), 3);
  Eigen::Index row = 0;
  for (const Point& p : soup.points) mesh.vertices.row(row++) << p.x(), p.y(), p.z();

  std::vector<std::array<int, 3>> triangles;
  for (const std::vector<int>& polygon : soup.polygons) {
    for (std::size_t i = 2; i < polygon.size(); ++i) {
      triangles.push_back({polygon[0], polygon[i - 1], polygon[i]});
    }
  }
  mesh.faces.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  row = 0;
  for (const auto& t : triangles) mesh.faces.row(row++) << t[0], t[1], t[2];
  return true;
}

bool writeObj(const std::string& path, const TriangleMesh& mesh) {
  const Soup soup = soupOf(mesh);
  return CGAL::IO::write_OBJ(path, soup.points, soup.polygons, allDigits());
}

bool writeOff(const std::string& path, const TriangleMesh& mesh) {
  const Soup soup = soupOf(mesh);
  return CGAL::IO::write_OFF(path, soup.points, soup.polygons, allDigits());
}

} // namespace massprops
