// The search for crossings of a surface with itself against CGAL's, both on one core and on the
// same triangles: processor time, medians of five runs in turns. Then the same search five million
// units from the origin, in model coordinates.
//
// usage: crossings [vertices of the largest model, 1000000 by default]
#include "core/base/parallel.h"
#include "core/mesh/cgal_mesh.h"
#include "core/query/self_intersection.h"
#include "organic_model.h"
#include "samples.h"

#include <CGAL/Polygon_mesh_processing/self_intersections.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace {

using namespace massprops;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

/// Of the processor, for all runs on one thread.
template <class Run>
double secondsOf(const Run& run) {
  const std::clock_t start = std::clock();
  run();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

/// Faces in spatial order, as all callers have them.
TriangleMesh inOrder(const TriangleMesh& mesh) {
  const std::vector<int> order = spatialOrder(mesh.vertices, mesh.faces);
  TriangleMesh result{mesh.vertices, Faces(mesh.faces.rows(), 3)};
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    result.faces.row(f) = mesh.faces.row(order[static_cast<std::size_t>(f)]);
  }
  return result;
}

/// With the tree.
std::size_t own(const TriangleMesh& mesh) {
  return selfIntersectingFaces(mesh.vertices, mesh.faces, TriangleTree::Order::Spatial).size();
}

/// With the mesh that it takes.
std::size_t cgals(const TriangleMesh& triangles) {
  const auto mesh = surfaceMesh(triangles.vertices, triangles.faces);
  std::vector<std::pair<SurfaceMesh::Face_index, SurfaceMesh::Face_index>> pairs;
  CGAL::Polygon_mesh_processing::self_intersections(mesh, std::back_inserter(pairs));
  return pairs.size();
}

void compare(const char* name, const TriangleMesh& model) {
  const TriangleMesh mesh = inOrder(model);
  TriangleMesh far = mesh;
  far.vertices.array() += 5e6;
  std::vector<double> ours;
  std::vector<double> theirs;
  std::vector<double> farAway;
  std::size_t found = 0;
  constexpr int kRuns = 5;
  for (int run = 0; run < kRuns; ++run) {
    ours.push_back(secondsOf([&] { found += own(mesh); }));
    theirs.push_back(secondsOf([&] { found += cgals(mesh); }));
    farAway.push_back(secondsOf([&] { found += own(far); }));
  }
  std::printf("%-14s %9ld %12.4f %12.4f %8.1f %14.2f %10zu\n", name,
              static_cast<long>(mesh.faces.rows()), median(ours), median(theirs),
              median(theirs) / median(ours), median(farAway) / median(ours), found);
  std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv) {
  const long largest = argc > 1 ? std::atol(argv[1]) : 1000000;
  setThreadCount(1);
  std::printf("%-14s %9s %12s %12s %8s %14s %10s\n", "model", "triangles", "own s", "CGAL s",
              "CGAL/own", "far/near own", "crossings");
  compare("toy_dog", testing::sampleMesh("toy_dog"));
  for (const long size : {10000L, 100000L, 1000000L}) {
    if (size > largest) continue;
    compare(("animal " + std::to_string(size)).c_str(), benchmarks::organicModel(size));
  }
  return 0;
}
