// Times, memory and results of the whole filter from six thousand to a million vertices, next to
// what CGAL's skeletonisation of the same mesh takes in the same run. benchmarks/results.md keeps
// the output with the machine named.
//
// usage: scaling [all]   `all` measures the skeletonisation of the largest meshes, too: minutes, 5
// GB
#include "core/base/parallel.h"
#include "core/base/stopwatch.h"
#include "core/mesh/decimation.h"
#include "core/pipeline.h"
#include "judge/guarantee.h"
#include "organic_model.h"
#include "property/cases.h"
#include "samples.h"
#include "shapes.h"

#include <CGAL/Mean_curvature_flow_skeletonization.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/copy_face_graph.h>
#include <CGAL/extract_mean_curvature_flow_skeleton.h>

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace {

using namespace massprops;

struct Model {
  const char* name;
  GoalKind goal;
  std::function<TriangleMesh()> make;
  bool isLarge = false; ///< its skeletonisation takes minutes
};

/// Every triangle in four, so many times.
TriangleMesh refined(const char* sample, int times) {
  TriangleMesh mesh = testing::sampleMesh(sample);
  for (int i = 0; i < times; ++i) mesh = testing::subdivided(mesh);
  return mesh;
}

TriangleMesh dinosaur(Eigen::Index size) {
  const TriangleMesh fine = refined("toy_dinosaur", 1);
  return decimated(fine.vertices, fine.faces, {size, size, 0.0}).mesh;
}

/// As a file of floats holds it; in doubles a few faces at the rims of the feet cross.
TriangleMesh asFloats(TriangleMesh mesh) {
  mesh.vertices = mesh.vertices.cast<float>().cast<double>().eval();
  return mesh;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double number(const Result& result, const std::string& key) {
  return std::get<double>(result.report.at(key));
}

/// CGAL as its manual shows it. The mesh type must not be the one of core/skeleton.cpp: both
/// instantiations would be the same to the linker.
double cgalSkeletonSeconds(const TriangleMesh& mesh) {
  using Kernel = CGAL::Simple_cartesian<double>;
  using Polyhedron = CGAL::Polyhedron_3<Kernel>;
  CGAL::Surface_mesh<Kernel::Point_3> surface;
  using Vertex = CGAL::Surface_mesh<Kernel::Point_3>::Vertex_index;
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    surface.add_vertex({mesh.vertices(v, 0), mesh.vertices(v, 1), mesh.vertices(v, 2)});
  }
  const auto vertex = [](int v) { return Vertex(static_cast<Vertex::size_type>(v)); };
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    surface.add_face(vertex(mesh.faces(f, 0)), vertex(mesh.faces(f, 1)), vertex(mesh.faces(f, 2)));
  }
  Polyhedron polyhedron;
  CGAL::copy_face_graph(surface, polyhedron);
  const Stopwatch time;
  CGAL::Mean_curvature_flow_skeletonization<Polyhedron>::Skeleton skeleton;
  CGAL::extract_mean_curvature_flow_skeleton(polyhedron, skeleton);
  return time.seconds();
}

double residentMegabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

void measure(const Model& model, bool withSkeleton) {
  const TriangleMesh mesh = model.make();
  Options options;
  options.goal = model.goal;
  // As a float mesh stores it.
  options.representable = [](const Points& points) {
    return Points(points.cast<float>().cast<double>());
  };
  const int runs = mesh.vertices.rows() > 100000 ? 3 : 5;
  const double before = residentMegabytes();
  double memory = 0.0;
  constexpr const char* kStages[] = {"check", "copy",         "limit",      "skeleton",
                                     "basis", "optimization", "inspection", "total"};
  std::map<std::string, std::vector<double>> seconds;
  Result result;
  for (int run = 0; run < runs; ++run) {
    result = Result{};
    result = optimizeMassProperties(mesh, options);
    if (run == 0) memory = residentMegabytes() - before;
    for (const char* stage : kStages) {
      seconds[stage].push_back(number(result, std::string("seconds_") + stage));
    }
  }
  testing::PropertyCase promise;
  promise.input = promise.body = mesh;
  promise.options = options;
  promise.wall =
      0.01 * (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).norm();
  promise.floats = true;
  const std::size_t broken = testing::brokenPromises(promise, result).size();
  std::printf("%-12s %-5s %8ld", model.name, model.goal == GoalKind::Stand ? "Stand" : "Spin",
              static_cast<long>(mesh.vertices.rows()));
  for (const char* stage : kStages) std::printf(" %8.3f", median(seconds[stage]));
  if (withSkeleton) {
    std::vector<double> skeletonisation;
    for (int run = 0; run < (mesh.vertices.rows() > 150000 ? 1 : 3); ++run) {
      skeletonisation.push_back(cgalSkeletonSeconds(mesh));
    }
    const double plain = median(skeletonisation);
    std::printf(" %9.2f %6.3f", plain, median(seconds["total"]) / plain);
  } else {
    std::printf(" %9s %6s", "-", "-");
  }
  std::printf(" %7.0f %10.6f %9.1e  %s\n", memory, number(result, "objective_after"),
              number(result, "max_constraint_violation"), broken == 0 ? "holds" : "BROKEN");
  std::fflush(stdout);
}

} // namespace

int main(int argc, char** argv) {
  const bool all = argc > 1 && std::strcmp(argv[1], "all") == 0;
  const std::vector<Model> models = {
      {"box", GoalKind::Stand, [] { return testing::sampleMesh("box_on_corner"); }},
      {"dinosaur", GoalKind::Stand, [] { return testing::sampleMesh("toy_dinosaur"); }},
      {"dinosaur", GoalKind::Stand, [] { return dinosaur(20000); }},
      {"organic", GoalKind::Stand, [] { return benchmarks::organicModel(20000); }},
      {"organic", GoalKind::Stand, [] { return benchmarks::organicModel(100000); }},
      {"organic", GoalKind::Stand, [] { return asFloats(benchmarks::organicModel(970000)); }, true},
      {"top", GoalKind::Spin, [] { return refined("tilted_ellipsoid_top", 2); }},
      {"top", GoalKind::Spin, [] { return refined("tilted_ellipsoid_top", 3); }},
      {"top", GoalKind::Spin, [] { return refined("tilted_ellipsoid_top", 4); }},
      {"top", GoalKind::Spin, [] { return refined("tilted_ellipsoid_top", 5); }, true},
  };
  std::printf("Medians, seconds of wall time, %d threads; memory above the input in megabytes.\n",
              threadCount());
  std::printf("%-12s %-5s %8s %8s %8s %8s %8s %8s %8s %8s %8s %9s %6s %7s %10s %9s  %s\n", "model",
              "goal", "vertices", "check", "copies", "limit", "skeleton", "basis", "optimis.",
              "inspect.", "total", "CGAL's", "ratio", "memory", "objective", "violation",
              "guarantee");
  std::fflush(stdout);
  for (const Model& model : models) {
    // A process for each: peak memory is of the whole process, and nothing of one run is left in
    // the heap for the next.
    const pid_t child = fork();
    if (child == 0) {
      measure(model, all || !model.isLarge);
      _exit(0);
    }
    int status = 0;
    if (child < 0 || waitpid(child, &status, 0) != child || status != 0) {
      std::printf("%s: a run failed\n", model.name);
      return 1;
    }
  }
  return 0;
}
