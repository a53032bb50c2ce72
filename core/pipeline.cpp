#include "core/pipeline.h"

#include "core/answer/hollowing_report.h"
#include "core/base/parallel.h"
#include "core/base/stopwatch.h"
#include "core/mesh/components.h"
#include "core/mesh/decimation.h"
#include "core/model/frame.h"
#include "core/model/posed_model.h"
#include "core/model/solid.h"
#include "core/optimum/optimal_bound.h"
#include "core/reduced/cavity_search.h"
#include "core/reduced/harmonics.h"
#include "core/reduced/laplacian.h"
#include "core/reduced/offset_field.h"
#include "core/reduced/skeleton.h"

#include <algorithm>
#include <functional>
#include <stdexcept>

namespace massprops {
namespace {

/// Of the diagonal: smooths the noise of the skeleton's correspondence and keeps its shape.
constexpr double kDiffusionLength = 0.02;

/// Above this gap another search, with other directions, is worth its time.
constexpr double kFarFromLimit = 0.075;

/// What moves inwards is as fine as a cavity has to be: on finer ones, the objective does not
/// improve by more than the one or two per cent that it scatters by. In working lengths.
constexpr Coarseness kCage{12000, 3000, 1.5e-4};

/// Skeleton and basis are smooth: their proxy leads to cavities as good as the whole surface does
/// (benchmarks/results.md).
constexpr Coarseness kProxy{2400, 600, 3e-4};

/// A function of the basis needs a few vertices to have a shape.
Coarseness carrying(int basisSize, const Coarseness& wanted) {
  constexpr Eigen::Index kVerticesAFunction = 4;
  const Eigen::Index needed = kVerticesAFunction * basisSize;
  return {std::max(wanted.most, needed), std::max(wanted.least, needed), wanted.distance};
}

/// Per cent of the time at which stages begin. Seconds a vertex were measured on one machine; only
/// their ratios count.
struct Schedule {
  int copy, skeleton, directions, search;
  static constexpr int kEnd = 95;
};

Schedule scheduleFor(Eigen::Index vertexCount, int basisSize, bool isCopied) {
  const auto n = static_cast<double>(vertexCount);
  const auto cage = static_cast<double>(carrying(basisSize, kCage).most);
  const auto proxy = static_cast<double>(carrying(basisSize, kProxy).most);
  const double moving = isCopied ? std::min(n, 0.8 * cage) : n;
  const double check = 7e-7 * n;
  const double copy = isCopied ? 7e-7 * n + 1.2e-6 * std::min(n, cage) : 0.0;
  const double skeleton = 2.7e-5 * std::min(n, proxy) + 6e-7 * n;
  const double directions = 2.3e-6 * moving;
  const double search = 1.25e-5 * moving + 6e-7 * n;
  const double total = check + copy + skeleton + directions + search;
  const auto percent = [&](double seconds) {
    return static_cast<int>(Schedule::kEnd * seconds / total);
  };
  return {percent(check), percent(check + copy), percent(check + copy + skeleton),
          percent(check + copy + skeleton + directions)};
}

/// What moves inwards, and the smooth functions that move it, which live on a still coarser copy.
struct CoarseSurface {
  CoarseCopy cage;
  Vector mass; ///< of the cage, lumped, total 1
  Proxy proxy;
  Interpolation interpolation; ///< of the cage's vertices by the proxy's
  SparseMatrix laplacian;      ///< of the proxy
  Vector area;                 ///< that the proxy's vertices stand for on the cage
  Skeleton skeleton;
  HarmonicBasis basis;
};

/// `beside`: work for the core that the skeleton leaves free.
CoarseSurface coarseSurface(const PosedModel& posed, const Coarseness& forCage,
                            const Coarseness& forProxy, int basisSize,
                            const std::function<void()>& tellCopied,
                            const std::function<void()>& beside, Stages& stages) {
  const Stopwatch copying;
  CoarseCopy cage = coarseCopy(posed.vertices, posed.faces, forCage);
  Proxy proxy = makeProxy(cage.mesh.vertices, cage.mesh.faces, forProxy);
  stages.secondsCopy = copying.seconds();
  tellCopied();
  const Vector cageArea = vertexLumpedMass(cage.mesh.vertices, cage.mesh.faces);
  Interpolation interpolation = Interpolation::identity(cageArea.size());
  SparseMatrix laplacian;
  Vector area;
  HarmonicBasis basis;
  Skeleton skeleton;
  inParallel(
      [&] {
        const Stopwatch time;
        interpolation = interpolationFrom(proxy, cage.mesh.vertices);
        area = interpolation.transposeTimes(cageArea);
        laplacian = cotanLaplacian(proxy.mesh.vertices, proxy.mesh.faces);
        basis = harmonicBasis(proxy.mesh.vertices, proxy.mesh.faces, laplacian, area / area.sum(),
                              basisSize);
        stages.secondsBasis = time.seconds();
        beside();
      },
      [&] {
        const Stopwatch time;
        skeleton = meanCurvatureSkeleton(proxy.mesh.vertices, proxy.mesh.faces);
        stages.secondsSkeleton = time.seconds();
      });
  stages.skeletonFailures = skeleton.failedComponents;
  return {std::move(cage), cageArea / cageArea.sum(), std::move(proxy),    std::move(interpolation),
          laplacian,       std::move(area),           std::move(skeleton), std::move(basis)};
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
  const ThreadTeam team;
  Stages stages;

  tell(0, "Checking the model");
  const Solid solid =
      makeSolid(model, options.openSurface, rotationToUp(options.upAxis), CrossingCheck::Later);
  requireSensible(options, solid.vertices().rows(), solid.diagonal());
  const PosedModel posed = makePosedModel(solid, options);
  if (posed.open) requireSensibleForShell(options);
  const TriangleTree surface(posed.vertices, posed.open ? posed.open->skin : posed.faces,
                             TriangleTree::Order::Spatial);

  const bool needsAll = options.fullResolution || options.outerUpperBound > 0.0 || posed.open;
  const Eigen::Index n = posed.vertices.rows();
  const Schedule schedule = scheduleFor(n, options.basisSize, !needsAll);
  stages.secondsCheck = total.seconds();

  const Moments solidMoments = moments(posed.vertices, posed.faces);
  const std::unique_ptr<Goal> goal = makeGoal(options, posed, posed.vertices);
  const Coarseness whole{n, n, 0.0};
  std::optional<OptimalBound> limit;
  std::optional<CoarseSurface> coarse;
  const auto checkCrossings = [&] {
    const Stopwatch time;
    requireNoCrossings(solid);
    stages.secondsCheck += time.seconds();
  };
  const auto findLimit = [&] {
    if (options.outerUpperBound > 0.0 || posed.open) return;
    const Stopwatch time;
    const AdmissibleCells cells = admissibleCells(surface, posed.wall);
    if (cells.rows() == 0) return;
    limit = optimalBound(*goal, options.weights, solidMoments, fillingSeenBy(options), cells);
    stages.secondsLimit = time.seconds();
  };
  const auto makeCoarseSurface = [&] {
    tell(schedule.copy, "Coarse copies");
    coarse.emplace(coarseSurface(
        posed, needsAll ? whole : carrying(options.basisSize, kCage),
        options.fullResolution ? whole : carrying(options.basisSize, kProxy), options.basisSize,
        [&] { tell(schedule.skeleton, "Mean curvature skeleton and harmonic basis"); },
        checkCrossings, stages));
  };
  try {
    // The limit needs no copies: both cores work.
    inParallel(findLimit, makeCoarseSurface);
  } catch (const InvalidInput&) {
    throw;
  } catch (const std::runtime_error&) {
    // A stage that fails may do so for crossings that nobody has looked for yet.
    requireNoCrossings(solid);
    throw;
  }
  const bool isCopy = coarse->cage.mesh.vertices.rows() < n;
  const Points& x = coarse->cage.mesh.vertices;
  const Faces& faces = coarse->cage.mesh.faces;
  stages.repairs = solid.repairs().describe();

  tell(schedule.directions, "Offset directions");
  const Points axis = smoothedOverSurface(coarse->skeleton.points, coarse->laplacian, coarse->area,
                                          kDiffusionLength);
  Points fineAxis = coarse->interpolation * axis;
  if (posed.open) fineAxis = levelAtRim(x, faces, posed.isLid, *posed.open, fineAxis);
  const Faces& skin = posed.open ? posed.open->skin : faces;
  OffsetField field = offsetField(x, skin, fineAxis);

  tell(schedule.search, "Optimization");
  const auto representable = [&](const Points& points) {
    return options.representable ? options.representable(points) : points;
  };
  const SparseMatrix L =
      options.weights.smoothness > 0.0 ? cotanLaplacian(x, faces) : SparseMatrix();
  CavityTask task{surface, x, faces, field, coarse->basis, L, coarse->mass, *goal, options.weights};
  if (!coarse->interpolation.isIdentity()) {
    task.interpolation = &coarse->interpolation;
    task.proxy = &coarse->proxy;
  }
  if (posed.open) task.open = &*posed.open;
  task.solidMoments = solidMoments;
  task.fillDensity = fillingSeenBy(options);
  task.limit = limit;
  task.wall = posed.wall;
  task.inputMoments = solidMoments + moments(posed.cavities.vertices, posed.cavities.faces);
  const auto boundsFor = [&](double wall) {
    const auto bounds = isCopy ? innerBoundsOfCopy : innerBounds;
    return keepingWall(x, surface, field, bounds(field, wall, options.innerUpperBound), wall);
  };
  task.inner = boundsFor(task.wall);
  if (options.outerUpperBound > 0.0) {
    task.outer = outerBounds(posed.vertices, field, options.outerLowerBound / posed.frame.length,
                             options.outerUpperBound / posed.frame.length);
    if (options.goal == GoalKind::Hang && !posed.pivot) holdTop(posed.vertices, *task.outer);
    if (options.goal == GoalKind::Float || options.goal == GoalKind::StandEmptyAndFilled) {
      task.goalFor = [&](const Points& outer) { return makeGoal(options, posed, outer); };
    }
  }
  task.deliverable = [&](const Points& working) {
    return toWorking(posed.frame, representable(toModel(posed.frame, working)));
  };
  int percent = schedule.search;
  const auto tellSearch = [&](double share) {
    percent = std::max(percent, schedule.search +
                                    static_cast<int>((Schedule::kEnd - schedule.search) * share));
    tell(percent, "Optimization");
  };
  const auto isUseless = [&](const CavityResult& found) {
    // A shell is asked for whatever a solid body could do.
    return !posed.open && found.status == CavityStatus::Found && !isBetterThanSolid(task, found);
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
    field = offsetField(x, skin, fineAxis, kSteepClearance);
    task.inner = boundsFor(task.wall);
    CavityResult steep = searchCavity(task, tellSearch);
    const bool isSteepBetter = isBetter(task, steep, cavity);
    addEffort(isSteepBetter ? cavity : steep, isSteepBetter ? steep : cavity);
    if (isSteepBetter) cavity = std::move(steep);
  }
  if (isUseless(cavity)) cavity.status = CavityStatus::NoGain;
  if (cavity.status == CavityStatus::NoRoom) stages.largestWall = largestWall(task, boundsFor);

  tell(Schedule::kEnd, "Report");
  Result result;
  if (cavity.status == CavityStatus::Found) {
    const std::vector<int> places = placesInSolid(posed, coarse->cage.vertexOf);
    Points positions = representable(toModel(posed.frame, placed(cavity.inner, places)));
    Faces cavityFaces = cavity.cavity.faces;
    if (posed.open) {
      // The strips end in the very points of the model.
      positions.bottomRows(n) = solid.vertices();
      cavityFaces = withoutLids(cavityFaces, n);
    }
    Submesh inner = submesh(positions, placed(cavityFaces, places));
    result.inner = std::move(inner.mesh);
    if (result.inner.faces.rows() > 0) {
      result.inner.faces.col(1).swap(result.inner.faces.col(2));
    }
    result.innerWall = placed(cavity.inspection.wall, places)(inner.vertexOf) * posed.frame.length;
    if (task.outer || posed.cavities.faces.rows() > 0) {
      result.outer = TriangleMesh{
          representable(toModel(posed.frame, placed(cavity.outer, posed.vertexOf))), solid.faces()};
    }
  }
  // A verdict may depend on the outer surface as it has become.
  const std::unique_ptr<Goal> reached =
      cavity.status == CavityStatus::Found ? makeGoal(options, posed, cavity.outer) : nullptr;
  result.report = hollowingReport(posed, task, reached ? *reached : *goal, cavity, options, stages);
  if (reached && options.showAnswer) {
    tell(97, "Picture of the answer");
    PictureResult drawn = pictureOf(posed, task, *reached, cavity);
    result.picture = std::move(drawn.picture);
    if (!result.picture) result.report.add("picture", drawn.failure);
  }
  result.report.add("seconds_total", total.seconds());
  tell(100, "Done");
  return result;
}

} // namespace massprops
