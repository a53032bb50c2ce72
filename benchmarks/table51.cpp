// Prints the rows of [Thesis, Table 5.1] for our samples, each over the published times of its
// stages, and besides what CGAL's skeletonisation alone takes on the same mesh and what the moments
// cost.
// benchmarks/results.md keeps the output with the machine named.
#include "core/base/stopwatch.h"
#include "core/physics/moments.h"
#include "core/pipeline.h"
#include "core/reduced/laplacian.h"

#include <CGAL/IO/PLY.h>
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
#include <ctime>
#include <exception>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

using namespace massprops;
using Kernel = CGAL::Simple_cartesian<double>;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

constexpr int kRuns = 5;

/// Seconds, as the columns that we print. The published stages do not always add up to the total.
struct Stages {
  double skeleton, harmonics, optimization, matrices, total;
};

struct Sample {
  const char* file;
  GoalKind goal;
  Stages thesis, reference; ///< [Thesis, Table 5.1]
};

constexpr Sample kSamples[] = {
    {"box_on_corner.ply",
     GoalKind::Stand,
     {3.216, 0.315, 3.510, 0.037, 7.078},
     {3.216, 0.597, 4.402, 0.830, 9.045}},
    {"tilted_ellipsoid_top.ply",
     GoalKind::Spin,
     {0.320, 0.025, 0.063, 0.015, 0.423},
     {0.320, 0.031, 1.512, 0.136, 1.999}},
};

Mesh readMesh(const std::string& path) {
  Mesh mesh;
  if (!CGAL::IO::read_PLY(path, mesh, CGAL::parameters::use_binary_mode(true)) ||
      mesh.number_of_faces() == 0) {
    throw std::runtime_error("cannot read " + path);
  }
  return mesh;
}

TriangleMesh arrays(const Mesh& mesh) {
  TriangleMesh result;
  result.vertices.resize(static_cast<Eigen::Index>(mesh.number_of_vertices()), 3);
  result.faces.resize(static_cast<Eigen::Index>(mesh.number_of_faces()), 3);
  for (const auto v : mesh.vertices()) {
    const Kernel::Point_3& p = mesh.point(v);
    result.vertices.row(static_cast<Eigen::Index>(v.idx())) << p.x(), p.y(), p.z();
  }
  for (const auto f : mesh.faces()) {
    int corner = 0;
    for (const auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh)) {
      result.faces(static_cast<Eigen::Index>(f.idx()), corner++) = static_cast<int>(v.idx());
    }
  }
  return result;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double medianSeconds(const std::function<void()>& work) {
  std::vector<double> seconds;
  for (int run = 0; run < kRuns; ++run) {
    const Stopwatch watch;
    work();
    seconds.push_back(watch.seconds());
  }
  return median(seconds);
}

/// CGAL as its manual shows it. The mesh type must not be the one of core/reduced/skeleton.cpp:
/// both instantiations would be the same to the linker.
double cgalSkeletonSeconds(const Mesh& mesh) {
  using Polyhedron = CGAL::Polyhedron_3<Kernel>;
  Polyhedron polyhedron;
  CGAL::copy_face_graph(mesh, polyhedron);
  return medianSeconds([&] {
    CGAL::Mean_curvature_flow_skeletonization<Polyhedron>::Skeleton skeleton;
    CGAL::extract_mean_curvature_flow_skeleton(polyhedron, skeleton);
  });
}

TriangleMesh readSample(const Sample& sample) {
  return arrays(readMesh(std::string(MASSPROPS_SAMPLE_DIR) + "/" + sample.file));
}

/// Peak resident memory of one run in a process of its own, megabytes. A child starts with its
/// parent's memory: to be called before anything else.
double peakMegabytes(const Sample& sample) {
  const pid_t child = fork();
  if (child == 0) {
    Options options;
    options.goal = sample.goal;
    options.cavityShape = CavityShape::Offset;
    optimizeMassProperties(readSample(sample), options);
    _exit(0);
  }
  int status = 0;
  rusage usage{};
  if (child < 0 || wait4(child, &status, 0, &usage) != child || status != 0) {
    throw std::runtime_error("a run failed");
  }
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// Nanoseconds of processor time per triangle of the ten moments with all their derivatives.
double nanosecondsPerTriangle(const TriangleMesh& model) {
  const Points directions = model.vertices.rowwise().normalized();
  const int repetitions = static_cast<int>(2000000 / model.faces.rows()) + 1;
  double sink = 0.0;
  std::vector<double> seconds;
  for (int run = 0; run < kRuns; ++run) {
    const std::clock_t start = std::clock();
    for (int i = 0; i < repetitions; ++i) {
      sink += momentsWithRates(model.vertices, model.faces, directions).rates(0, 0);
    }
    seconds.push_back(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
  }
  if (sink == 0.0) std::puts("");
  return 1e9 * median(seconds) /
         (static_cast<double>(repetitions) * static_cast<double>(model.faces.rows()));
}

double number(const Result& result, const char* key) {
  return std::get<double>(result.report.at(key));
}

void printRow(const char* name, const char* vertices, const Stages& s) {
  std::printf("%-26s %8s %9.3f %9.3f %9.3f %9.4f %9.3f", name, vertices, s.skeleton, s.harmonics,
              s.optimization, s.matrices, s.total);
}

void printSample(const Sample& sample, double memory) {
  const Mesh mesh = readMesh(std::string(MASSPROPS_SAMPLE_DIR) + "/" + sample.file);
  const TriangleMesh model = arrays(mesh);
  Options options;
  options.goal = sample.goal;
  options.cavityShape = CavityShape::Offset;

  std::vector<double> skeleton;
  std::vector<double> basis;
  std::vector<double> optimization;
  std::vector<double> total;
  Result result;
  for (int run = 0; run < kRuns; ++run) {
    result = optimizeMassProperties(model, options);
    skeleton.push_back(number(result, "seconds_skeleton"));
    basis.push_back(number(result, "seconds_basis"));
    optimization.push_back(number(result, "seconds_optimization"));
    total.push_back(number(result, "seconds_total"));
  }
  const double matrices = medianSeconds([&] {
    const SparseMatrix L = cotanLaplacian(model.vertices, model.faces);
    const Vector mass = vertexLumpedMass(model.vertices, model.faces);
    if (L.nonZeros() + mass.size() == 0) throw std::logic_error("no mesh");
  });
  const double plain = cgalSkeletonSeconds(mesh);
  const double seconds = median(total);

  const std::string vertices = std::to_string(model.vertices.rows());
  printRow(sample.file, vertices.c_str(),
           {median(skeleton), median(basis), median(optimization), matrices, seconds});
  std::printf(" %11.6f %11.6f\n", number(result, "objective_before"),
              number(result, "objective_after"));
  printRow("  published, thesis", "", sample.thesis);
  std::puts("");
  printRow("  published, reference", "", sample.reference);
  std::puts("");
  std::printf("  CGAL's skeletonisation alone %.3f s; total / skeletonisation alone %.2f; "
              "optimisation / total %.1f %%\n",
              plain, seconds / plain, 100.0 * median(optimization) / seconds);
  std::printf("  moments with gradient %.1f ns a triangle; peak memory %.0f MB\n",
              nanosecondsPerTriangle(model), memory);
  std::fflush(stdout);
}

} // namespace

int main() {
  try {
    std::vector<double> memory;
    for (const Sample& sample : kSamples) memory.push_back(peakMegabytes(sample));
    std::printf("Medians of %d runs, seconds of wall time.\n", kRuns);
    std::printf("%-26s %8s %9s %9s %9s %9s %9s %11s %11s\n", "model", "vertices", "skeleton",
                "harmonics", "optimis.", "matrices", "total", "f before", "f after");
    for (std::size_t i = 0; i < memory.size(); ++i) printSample(kSamples[i], memory[i]);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
  return 0;
}
