#include "core/pipeline.h"

#include "core/cavity_search.h"
#include "core/harmonics.h"
#include "core/hollowing_report.h"
#include "core/laplacian.h"
#include "core/offset_field.h"
#include "core/skeleton.h"
#include "core/solid.h"
#include "core/stopwatch.h"
#include "core/workpiece.h"

#include <algorithm>
#include <future>

namespace massprops {
namespace {

/// Of the diagonal: smooths the noise of the skeleton's correspondence and keeps its shape.
constexpr double kDiffusionLength = 0.02;

std::unique_ptr<Goal> makeGoal(const Options& options, const Workpiece& piece,
                               const Moments& solidMoments) {
  switch (options.goal) {
  case GoalKind::Stand:
    return makeStandGoal(piece.contact, options.weights, piece.frame.length);
  case GoalKind::Spin:
    return makeSpinGoal(solidMoments, options.weights, piece.frame.length);
  }
  throw InvalidInput("This goal does not exist: choose one from the list.");
}

/// The vertices that `faces` use, renumbered.
TriangleMesh compacted(const Points& vertices, const Faces& faces) {
  std::vector<int> index(static_cast<std::size_t>(vertices.rows()), -1);
  for (Eigen::Index i = 0; i < faces.size(); ++i) {
    index[static_cast<std::size_t>(faces.data()[i])] = 0;
  }
  TriangleMesh mesh;
  mesh.vertices.resize(std::count(index.begin(), index.end(), 0), 3);
  int next = 0;
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    if (index[static_cast<std::size_t>(v)] < 0) continue;
    mesh.vertices.row(next) = vertices.row(v);
    index[static_cast<std::size_t>(v)] = next++;
  }
  mesh.faces = faces.unaryExpr([&](int v) { return index[static_cast<std::size_t>(v)]; });
  return mesh;
}

} // namespace

Result optimizeMassProperties(const TriangleMesh& model, const Options& options,
                              const Progress& progress) {
  const auto tell = [&](int percent, const char* stage) {
    if (progress) progress(percent, stage);
  };
  const Stopwatch total;
  StageTimes times;

  tell(0, "Checking the model");
  const Solid solid = makeSolid(model);
  requireSensible(options, solid.vertices().rows(), solid.diagonal());
  const Workpiece piece = makeWorkpiece(solid, options);

  // The basis does not need the skeleton: both cores work.
  tell(2, "Mean curvature skeleton and harmonic basis");
  const SparseMatrix L = cotanLaplacian(piece.vertices, piece.faces);
  const Vector area = vertexLumpedMass(piece.vertices, piece.faces);
  const Vector mass = area / area.sum();
  std::future<HarmonicBasis> pendingBasis = std::async(std::launch::async, [&] {
    const Stopwatch time;
    HarmonicBasis result = harmonicBasis(L, mass, options.basisSize);
    times.basis = time.seconds();
    return result;
  });
  const Stopwatch skeletonTime;
  const Points skeleton = meanCurvatureSkeleton(piece.vertices, piece.faces);
  times.skeleton = skeletonTime.seconds();
  const HarmonicBasis basis = pendingBasis.get();

  tell(65, "Offset directions");
  const OffsetField field =
      offsetField(piece.vertices, piece.faces, skeleton, L, area, kDiffusionLength);

  tell(70, "Optimization");
  const Moments solidMoments = moments(piece.vertices, piece.faces);
  const std::unique_ptr<Goal> goal = makeGoal(options, piece, solidMoments);
  const auto representable = [&](const Points& points) {
    return options.representable ? options.representable(points) : points;
  };
  CavityTask task{piece.vertices, piece.faces, field, basis, L, mass, *goal, options.weights};
  task.solidMoments = solidMoments;
  task.fillDensity = options.fillDensity / options.density;
  task.wall = piece.wall;
  task.inner = keepingWall(piece.vertices, piece.faces, field,
                           innerBounds(field, piece.wall, options.innerUpperBound), piece.wall);
  if (options.outerUpperBound > 0.0) {
    task.outer = outerBounds(piece.vertices, field, options.outerLowerBound / piece.frame.length,
                             options.outerUpperBound / piece.frame.length);
  }
  task.deliverable = [&](const Points& working) {
    return toWorking(piece.frame, representable(toModel(piece.frame, working)));
  };
  CavityResult cavity = searchCavity(
      task, [&](double share) { tell(70 + static_cast<int>(25.0 * share), "Optimization"); });
  if (cavity.status == CavityStatus::Found && !isBetterThanSolid(task, cavity)) {
    cavity.status = CavityStatus::NoGain;
  }

  tell(95, "Report");
  Result result;
  if (cavity.status == CavityStatus::Found) {
    result.inner =
        compacted(representable(toModel(piece.frame, cavity.inner)), cavity.cavity.faces);
    result.inner.faces.col(1).swap(result.inner.faces.col(2));
    if (task.outer) {
      result.outer = TriangleMesh{representable(toModel(piece.frame, cavity.outer)), piece.faces};
    }
  }
  result.report = hollowingReport(piece, task, cavity, options.goal, options.density, times);
  result.report.add("seconds_total", total.seconds());
  tell(100, "Done");
  return result;
}

} // namespace massprops
