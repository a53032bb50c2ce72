#include "samples.h"

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace massprops::testing {

TriangleMesh sampleMesh(const std::string& name) {
  return meshFile(std::string(MASSPROPS_SAMPLE_DIR) + "/" + name + ".ply");
}

TriangleMesh meshFile(const std::string& path) {
  std::vector<CGAL::Simple_cartesian<double>::Point_3> points;
  std::vector<std::vector<int>> polygons;
  if (!CGAL::IO::read_polygon_soup(path, points, polygons)) {
    throw std::runtime_error("cannot read " + path);
  }
  TriangleMesh mesh;
  mesh.vertices.resize(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t v = 0; v < points.size(); ++v) {
    mesh.vertices.row(static_cast<Eigen::Index>(v)) << points[v].x(), points[v].y(), points[v].z();
  }
  mesh.faces.resize(static_cast<Eigen::Index>(polygons.size()), 3);
  for (std::size_t f = 0; f < polygons.size(); ++f) {
    for (int k = 0; k < 3; ++k) {
      mesh.faces(static_cast<Eigen::Index>(f), k) = polygons[f].at(static_cast<std::size_t>(k));
    }
  }
  return mesh;
}

std::vector<std::string> sampleFiles() {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(MASSPROPS_SAMPLE_DIR)) {
    if (entry.path().extension() == ".ply") files.push_back(entry.path().string());
  }
  std::sort(files.begin(), files.end());
  return files;
}

} // namespace massprops::testing
