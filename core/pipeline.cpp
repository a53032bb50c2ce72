#include "core/pipeline.h"

#include "core/cavity_search.h"
#include "core/components.h"
#include "core/harmonics.h"
#include "core/hollowing_report.h"
#include "core/laplacian.h"
#include "core/limit.h"
#include "core/offset_field.h"
#include "core/parallel.h"
#include "core/proxy.h"
#include "core/skeleton.h"
#include "core/solid.h"
#include "core/stopwatch.h"
#include "core/workpiece.h"

#include <algorithm>
#include <functional>

namespace massprops {
namespace {

/// Of the diagonal: smooths the noise of the skeleton's correspondence and keeps its shape.
constexpr double kDiffusionLength = 0.02;

/// Above this gap another search, with other directions, is worth its time.
constexpr double kFarFromLimit = 0.075;

/// Vertices of the proxy. On models with thin limbs its skeleton costs some per cent of what
/// hollowing gains, with a scatter that falls slowly with its size (benchmarks/results.md). The
/// whole of a small model takes less than a second.
Eigen::Index proxySize(Eigen::Index vertexCount) {
  constexpr Eigen::Index kSmall = 5000;
  constexpr double kShare = 0.46;
  constexpr double kMost = 5000.0;
  if (vertexCount <= kSmall) return vertexCount;
  return static_cast<Eigen::Index>(std::min(kShare * static_cast<double>(vertexCount), kMost));
}

/// Share of the time until skeleton and basis are known: theirs goes with the proxy, that of the
/// rest with the surface. Seconds a vertex, of which only the ratio counts.
double shareOfSkeleton(Eigen::Index vertexCount, Eigen::Index proxyCount) {
  constexpr double kSkeleton = 8e-5;
  constexpr double kRest = 3.5e-5;
  const double skeleton = kSkeleton * static_cast<double>(proxyCount);
  return skeleton / (skeleton + kRest * static_cast<double>(vertexCount));
}

/// The outer surface keeps the point that the body hangs from.
void holdTop(const Points& vertices, OffsetBounds& bounds) {
  constexpr double kTop = 1e-4; // as at the ground contacts
  const double top = vertices.col(2).maxCoeff();
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    if (vertices(v, 2) >= top - kTop) bounds.lower[v] = bounds.upper[v] = 0.0;
  }
}

/// The greatest wall below the wanted one that leaves room for a cavity, within an eighth of it; 0
/// when none was found down to a thousandth. Near its limit the search finds a cavity at one wall
/// and none at a slightly thinner one, so that a wall counts only when a thinner one works, too.
double largestWall(CavityTask task, const std::function<OffsetBounds(double)>& boundsFor) {
  const auto hasRoom = [&](double wall) {
    task.wall = wall;
    task.inner = boundsFor(wall);
    return leavesRoom(task);
  };
  const auto works = [&](double wall) { return hasRoom(wall) && hasRoom(0.99 * wall); };
  const OffsetBounds thinnest = boundsFor(0.0);
  double tooThick =
      std::min(task.wall, thinnest.upper.cwiseProduct(task.field.clearance).maxCoeff());
  double found = 0.0;
  constexpr int kHalvings = 10;
  for (int i = 0; i < kHalvings && found == 0.0 && tooThick > 0.0; ++i) {
    const double half = 0.5 * tooThick;
    (works(half) ? found : tooThick) = half;
  }
  constexpr int kBisections = 3;
  for (int i = 0; i < kBisections && found > 0.0; ++i) {
    const double middle = 0.5 * (found + tooThick);
    (works(middle) ? found : tooThick) = middle;
  }
  return found;
}

} // namespace

Result optimizeMassProperties(const TriangleMesh& model, const Options& options,
                              const Progress& progress) {
  const auto tell = [&](int percent, const char* stage) {
    if (progress) progress(percent, stage);
  };
  const Stopwatch total;
  Stages stages;

  constexpr int kStart = 2;
  constexpr int kEnd = 95;
  tell(0, "Checking the model");
  const Solid solid = makeSolid(model, options.openSurface);
  requireSensible(options, solid.vertices().rows(), solid.diagonal());
  const Workpiece piece = makeWorkpiece(solid, options);
  if (piece.open) requireSensibleForShell(options);
  const Faces& skin = piece.open ? piece.open->skin : piece.faces;

  // Skeleton and basis are smooth: a coarse copy of the surface carries them. The basis does not
  // need the skeleton: both cores work.
  tell(kStart, "Mean curvature skeleton and harmonic basis");
  const Proxy proxy =
      makeProxy(piece.vertices, piece.faces,
                options.fullResolution ? piece.vertices.rows() : proxySize(piece.vertices.rows()));
  const TriangleMesh& coarse = proxy.mesh;
  const Vector area = vertexLumpedMass(piece.vertices, piece.faces);
  const Vector mass = area / area.sum();
  const SparseMatrix coarseL = cotanLaplacian(coarse.vertices, coarse.faces);
  const Vector coarseArea = proxy.interpolation.transposeTimes(area);
  const Moments solidMoments = moments(piece.vertices, piece.faces);
  const std::unique_ptr<Goal> goal = makeGoal(options, piece, piece.vertices);
  const int afterSkeleton =
      kStart + static_cast<int>((kEnd - kStart) *
                                shareOfSkeleton(piece.vertices.rows(), coarse.vertices.rows()));
  const auto tellBeside = [&](double share) {
    tell(kStart + static_cast<int>(share * (afterSkeleton - kStart)), "Mean curvature skeleton");
  };
  Skeleton skeleton;
  HarmonicBasis basis;
  std::optional<Limit> limit;
  inParallel(
      [&] {
        const Stopwatch time;
        skeleton = meanCurvatureSkeleton(coarse.vertices, coarse.faces);
        stages.secondsSkeleton = time.seconds();
      },
      [&] {
        const Stopwatch time;
        basis = harmonicBasis(coarse.vertices, coarse.faces, coarseL, coarseArea / coarseArea.sum(),
                              options.basisSize);
        stages.secondsBasis = time.seconds();
        tellBeside(0.25);
        if (options.outerUpperBound > 0.0 || piece.open) return;
        const Stopwatch limitTime;
        const AdmissibleCells cells =
            admissibleCells(piece.vertices, piece.faces, coarse, piece.wall);
        if (cells.rows() == 0) return;
        tellBeside(0.5);
        limit = limitOf(*goal, options.weights, solidMoments, fillingSeenBy(options), cells);
        stages.secondsLimit = limitTime.seconds();
        tellBeside(0.75);
      });
  stages.skeletonFailures = skeleton.failedComponents;
  stages.repairs = solid.repairs().describe();

  tell(afterSkeleton, "Offset directions");
  const Points axis = smoothedOverSurface(skeleton.points, coarseL, coarseArea, kDiffusionLength);
  Points fineAxis = proxy.interpolation * axis;
  if (piece.open) {
    fineAxis = levelAtRim(piece.vertices, piece.faces, piece.isLid, *piece.open, fineAxis);
  }
  OffsetField field = offsetField(piece.vertices, skin, fineAxis);

  const int beforeSearch = afterSkeleton + (kEnd - afterSkeleton) / 8;
  tell(beforeSearch, "Optimization");
  const auto representable = [&](const Points& points) {
    return options.representable ? options.representable(points) : points;
  };
  const SparseMatrix L = options.weights.smoothness > 0.0
                             ? cotanLaplacian(piece.vertices, piece.faces)
                             : SparseMatrix();
  CavityTask task{piece.vertices, piece.faces, field, basis, L, mass, *goal, options.weights};
  if (!proxy.interpolation.isIdentity()) task.proxy = &proxy;
  if (piece.open) task.open = &*piece.open;
  task.solidMoments = solidMoments;
  task.fillDensity = fillingSeenBy(options);
  task.limit = limit;
  task.wall = piece.wall;
  task.inputMoments = solidMoments + moments(piece.cavities.vertices, piece.cavities.faces);
  const auto boundsFor = [&](double wall) {
    return keepingWall(piece.vertices, skin, field,
                       innerBounds(field, wall, options.innerUpperBound), wall);
  };
  task.inner = boundsFor(task.wall);
  if (options.outerUpperBound > 0.0) {
    task.outer = outerBounds(piece.vertices, field, options.outerLowerBound / piece.frame.length,
                             options.outerUpperBound / piece.frame.length);
    if (options.goal == GoalKind::Hang && !piece.pivot) holdTop(piece.vertices, *task.outer);
    if (options.goal == GoalKind::Float || options.goal == GoalKind::StandEmptyAndFilled) {
      task.goalFor = [&](const Points& outer) { return makeGoal(options, piece, outer); };
    }
  }
  task.deliverable = [&](const Points& working) {
    return toWorking(piece.frame, representable(toModel(piece.frame, working)));
  };
  int percent = beforeSearch;
  const auto tellSearch = [&](double share) {
    percent = std::max(percent, beforeSearch + static_cast<int>((kEnd - beforeSearch) * share));
    tell(percent, "Optimization");
  };
  const auto isUseless = [&](const CavityResult& found) {
    // A shell is asked for whatever a solid body could do.
    return !piece.open && found.status == CavityStatus::Found && !isBetterThanSolid(task, found);
  };
  CavityResult cavity = searchCavity(task, tellSearch);
  if (task.limit && isUseless(cavity)) {
    // What was trimmed off later may have been what the start near the limit lived on.
    CavityTask plain = task;
    plain.limit.reset();
    cavity = searchCavity(plain, tellSearch);
  }
  // The limit knows nothing of smoothness.
  if (options.weights.smoothness == 0.0 && gapToLimit(task, cavity) > kFarFromLimit) {
    field = offsetField(piece.vertices, skin, fineAxis, kSteepClearance);
    task.inner = boundsFor(task.wall);
    CavityResult steep = searchCavity(task, tellSearch);
    const bool isSteepBetter = isBetter(task, steep, cavity);
    addEffort(isSteepBetter ? cavity : steep, isSteepBetter ? steep : cavity);
    if (isSteepBetter) cavity = std::move(steep);
  }
  if (isUseless(cavity)) cavity.status = CavityStatus::NoGain;
  if (cavity.status == CavityStatus::NoRoom) stages.largestWall = largestWall(task, boundsFor);

  tell(kEnd, "Report");
  Result result;
  if (cavity.status == CavityStatus::Found) {
    const Eigen::Index n = piece.vertices.rows();
    Points positions = representable(toModel(piece.frame, inSolidOrder(piece, cavity.inner)));
    Faces faces = cavity.cavity.faces;
    if (piece.open) {
      // The strips end in the very points of the model.
      positions.bottomRows(n) = solid.vertices();
      faces = withoutLids(faces, n);
    }
    Submesh inner = submesh(positions, inSolidOrder(piece, faces));
    result.inner = std::move(inner.mesh);
    if (result.inner.faces.rows() > 0) {
      result.inner.faces.col(1).swap(result.inner.faces.col(2));
    }
    result.innerWall =
        inSolidOrder(piece, cavity.inspection.wall)(inner.vertexOf) * piece.frame.length;
    if (task.outer || piece.cavities.faces.rows() > 0) {
      result.outer = TriangleMesh{
          representable(toModel(piece.frame, inSolidOrder(piece, cavity.outer))), solid.faces()};
    }
  }
  // A verdict may depend on the outer surface as it has become.
  const std::unique_ptr<Goal> reached =
      cavity.status == CavityStatus::Found ? makeGoal(options, piece, cavity.outer) : nullptr;
  result.report = hollowingReport(piece, task, reached ? *reached : *goal, cavity, options, stages);
  if (reached && options.showAnswer) {
    tell(97, "Picture of the answer");
    result.picture = pictureOf(piece, task, *reached, cavity);
  }
  result.report.add("seconds_total", total.seconds());
  tell(100, "Done");
  return result;
}

} // namespace massprops
