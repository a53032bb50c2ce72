#include "core/pipeline.h"

#include "core/answer/delivery.h"
#include "core/answer/hollowing_report.h"
#include "core/base/parallel.h"
#include "core/base/stopwatch.h"
#include "core/model/frame.h"
#include "core/model/posed_model.h"
#include "core/model/solid.h"
#include "core/optimum/optimal_bound.h"
#include "core/reduced/moving_surface.h"
#include "core/reduced/schedule.h"
#include "core/reduced/search_strategy.h"

#include <algorithm>
#include <functional>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

namespace massprops {
namespace {

/// Reports to the caller how far the run has come; never goes back.
class ProgressBar {
public:
  explicit ProgressBar(const Progress& progress) : progress_(progress) {}

  void show(int percent, const char* stage) {
    percent_ = std::max(percent_, percent);
    if (progress_) progress_(percent_, stage);
  }

  /// The share of a stage that takes the bar from one percentage to another.
  std::function<void(double)> within(int from, int to, const char* stage) {
    return [=](double share) { show(from + static_cast<int>((to - from) * share), stage); };
  }

private:
  const Progress& progress_;
  int percent_ = 0;
};

PosedModel posed(const Solid& solid, const Options& options) {
  requireSensible(options, solid.vertices().rows(), solid.diagonal());
  PosedModel result = makePosedModel(solid, options);
  if (result.open) requireSensibleForShell(options);
  return result;
}

bool moves(const Options& options) {
  return options.outerUpperBound > 0.0;
}

/// The model, checked and put upright, and what follows from it alone. Neither copied nor moved,
/// for its parts refer to each other.
struct Preparation {
  Preparation(const TriangleMesh& model, const Options& options)
      : solid(makeSolid(model, options.openSurface, rotationToUp(options.upAxis),
                        CrossingCheck::Later)),
        piece(posed(solid, options)),
        surface(piece.vertices, piece.open ? piece.open->skin : piece.faces,
                TriangleTree::Order::Spatial),
        solidMoments(moments(piece.vertices, piece.faces)),
        goal(makeGoal(options, piece, piece.vertices)),
        isDecimated(!options.fullResolution && !moves(options) && !piece.open),
        schedule(scheduleFor(piece.vertices.rows(), options.basisSize, isDecimated)) {}
  Preparation(const Preparation&) = delete;
  Preparation& operator=(const Preparation&) = delete;

  const Stopwatch time;
  const Solid solid;
  const PosedModel piece;
  const TriangleTree surface;
  const Moments solidMoments; ///< of the outer surface, working frame
  const std::unique_ptr<Goal> goal;
  const bool isDecimated; ///< whether a copy moves inwards
  const Schedule schedule;
  const double seconds = time.seconds(); ///< all of this took
};

Preparation prepare(const TriangleMesh& model, const Options& options, ProgressBar& bar) {
  bar.show(0, "Checking the model");
  return {model, options};
}

/// What moves inwards, and what the best of all cavities could do.
struct Foundation {
  Coarsening coarse;
  std::optional<OptimalBound> bound;
  double secondsBound = 0.0, secondsCrossings = 0.0;
};

Foundation coarsen(const Preparation& model, const Options& options, ProgressBar& bar) {
  Foundation result;
  const auto checkCrossings = [&] {
    const Stopwatch time;
    requireNoCrossings(model.solid);
    result.secondsCrossings = time.seconds();
  };
  const auto findBound = [&] {
    if (moves(options) || model.piece.open) return;
    const Stopwatch time;
    const AdmissibleCells cells = admissibleCells(model.surface, model.piece.wall);
    if (cells.rows() == 0) return;
    result.bound = optimalBound(*model.goal, options.weights, model.solidMoments,
                                fillingSeenBy(options), cells);
    result.secondsBound = time.seconds();
  };
  const auto coarsenModel = [&] {
    bar.show(model.schedule.copy, "Coarse copies");
    const CoarseningOptions wanted{options.basisSize, model.isDecimated, !options.fullResolution,
                                   options.weights.smoothness > 0.0};
    result.coarse = coarsen(
        model.piece, wanted,
        [&] { bar.show(model.schedule.skeleton, "Mean curvature skeleton and harmonic basis"); },
        checkCrossings);
  };
  try {
    // The bound needs no copies: both cores work.
    inParallel(findBound, coarsenModel);
  } catch (const InvalidInput&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    // A stage that fails may do so for crossings that nobody has looked for yet.
    requireNoCrossings(model.solid);
    throw;
  }
  return result;
}

/// How far offsets along the field may go for a wall to be kept.
OffsetBounds boundsKeeping(double wall, const Preparation& model, const MovingSurface& moving,
                           const OffsetField& field, const Options& options) {
  const bool isCopy = moving.vertices.rows() < model.piece.vertices.rows();
  const auto bounds = isCopy ? innerBoundsOfCopy : innerBounds;
  return keepingWall(moving.vertices, model.surface, field,
                     bounds(field, wall, options.innerUpperBound), wall);
}

/// The outer surface's own bounds; it keeps the point that the body hangs from.
OffsetBounds boundsOfOuter(const Preparation& model, const OffsetField& field,
                           const Options& options) {
  const PosedModel& piece = model.piece;
  OffsetBounds bounds =
      outerBounds(piece.vertices, field, options.outerLowerBound / piece.frame.length,
                  options.outerUpperBound / piece.frame.length);
  if (options.goal != GoalKind::Hang || piece.pivot) return bounds;
  constexpr double kTop = 1e-4; // as at the ground contacts
  const double top = piece.vertices.col(2).maxCoeff();
  for (Eigen::Index v = 0; v < piece.vertices.rows(); ++v) {
    if (piece.vertices(v, 2) >= top - kTop) bounds.lower[v] = bounds.upper[v] = 0.0;
  }
  return bounds;
}

Points representable(const Options& options, const Points& points) {
  return options.representable ? options.representable(points) : points;
}

/// The search for a cavity with offsets along directions of at least this clearance.
CavityTask taskAlong(double wantedClearance, const Preparation& model, const Foundation& foundation,
                     const Options& options) {
  const PosedModel& piece = model.piece;
  const MovingSurface& moving = *foundation.coarse.moving;
  const Points& axis = foundation.coarse.axis;
  OffsetField field =
      piece.open
          ? offsetField(moving.vertices, piece.open->skin,
                        levelAtRim(moving.vertices, moving.faces, piece.isLid, *piece.open, axis),
                        wantedClearance)
          : offsetField(moving.vertices, moving.faces, axis, wantedClearance);
  CavityTask task{model.surface, *model.goal, {}, options.weights};
  task.model.surface = foundation.coarse.moving;
  task.model.inner = boundsKeeping(piece.wall, model, moving, field, options);
  if (moves(options)) task.model.outer = boundsOfOuter(model, field, options);
  task.model.field = std::move(field);
  task.model.fillDensity = fillingSeenBy(options);
  task.model.solidMoments = model.solidMoments;
  task.model.isOpen = piece.open.has_value();
  if (piece.open) task.open = &*piece.open;
  task.inputMoments = model.solidMoments + moments(piece.cavities.vertices, piece.cavities.faces);
  task.wall = piece.wall;
  task.bound = foundation.bound;
  const bool followsOuter =
      options.goal == GoalKind::Float || options.goal == GoalKind::StandEmptyAndFilled;
  if (moves(options) && followsOuter) {
    task.goalFor = [&](const Points& outer) { return makeGoal(options, piece, outer); };
  }
  task.deliverable = [&](const Points& working) {
    return toWorking(piece.frame, representable(options, toModel(piece.frame, working)));
  };
  return task;
}

/// What was asked for, and the best answer.
struct Search {
  CavityTask task;
  CavityResult cavity;
  /// For the outer surface as it has become, which a verdict may depend on.
  std::unique_ptr<Goal> goalAfter = {};
  double largestWall = 0.0; ///< working length; when the wanted one leaves no room
  double secondsLargestWall = 0.0;
};

Search search(const Preparation& model, const Foundation& foundation, const Options& options,
              ProgressBar& bar) {
  bar.show(model.schedule.directions, "Offset directions");
  Search result{taskAlong(kSlantedClearance, model, foundation, options), {}};
  bar.show(model.schedule.search, "Optimization");
  result.cavity = bestCavity(
      result.task, [&] { return taskAlong(kSteepClearance, model, foundation, options); },
      bar.within(model.schedule.search, Schedule::kEnd, "Optimization"));
  const bool isFound = result.cavity.status == CavityStatus::Found;
  result.goalAfter =
      makeGoal(options, model.piece, isFound ? result.cavity.outer : model.piece.vertices);
  if (result.cavity.status != CavityStatus::NoRoom) return result;

  const Stopwatch time;
  constexpr int kFound = 99; // before the report
  result.largestWall = largestWall(
      result.task,
      [&](double wall) {
        return boundsKeeping(wall, model, *foundation.coarse.moving, result.task.model.field,
                             options);
      },
      bar.within(Schedule::kEnd, kFound, "Largest wall that leaves room"));
  result.secondsLargestWall = time.seconds();
  return result;
}

Result deliver(const Preparation& model, const Foundation& foundation, const Search& found,
               const Options& options, ProgressBar& bar) {
  bar.show(Schedule::kEnd, "Report");
  Result result;
  Delivery delivery =
      deliver(model.solid, model.piece, found.task, found.cavity, foundation.coarse.vertexOf,
              [&](const Points& points) { return representable(options, points); });
  result.inner = std::move(delivery.inner);
  result.innerWall = std::move(delivery.innerWall);
  result.outer = std::move(delivery.outer);
  if (found.cavity.status == CavityStatus::Found && options.showAnswer) {
    bar.show(97, "Picture of the answer");
    result.picture = pictureOf(model.piece, found.task, *found.goalAfter, found.cavity);
  }
  return result;
}

Report report(const Preparation& model, const Foundation& foundation, const Search& found,
              const Options& options) {
  const Coarsening& coarse = foundation.coarse;
  Stages stages;
  stages.repairs = model.solid.repairs().describe();
  stages.skeletonFailures = coarse.skeletonFailures;
  stages.largestWall = found.largestWall;
  stages.secondsCheck = model.seconds + foundation.secondsCrossings;
  stages.secondsCopy = coarse.secondsCopy;
  stages.secondsSkeleton = coarse.secondsSkeleton;
  stages.secondsBasis = coarse.secondsBasis;
  stages.secondsLimit = foundation.secondsBound;
  stages.secondsLargestWall = found.secondsLargestWall;
  return hollowingReport(model.piece, found.task, *found.goalAfter, found.cavity, options, stages);
}

Result run(const TriangleMesh& model, const Options& options, const Progress& progress) {
  const Stopwatch total;
  const ThreadTeam team;
  ProgressBar bar(progress);
  const Preparation prepared = prepare(model, options, bar);
  const Foundation foundation = coarsen(prepared, options, bar);
  const Search found = search(prepared, foundation, options, bar);
  Result result = deliver(prepared, foundation, found, options, bar);
  result.report = report(prepared, foundation, found, options);
  result.report.add("seconds_total", total.seconds());
  bar.show(100, "Done");
  return result;
}

} // namespace

Result optimizeMassProperties(const TriangleMesh& model, const Options& options,
                              const Progress& progress) {
  try {
    return run(model, options, progress);
  } catch (const std::logic_error& failure) {
    // Of CGAL, whose words do not say what to do.
    throw std::runtime_error(std::string("This mesh is too uneven to be calculated with: use "
                                         "Remeshing > Isotropic Explicit Remeshing, then run "
                                         "again. (") +
                             failure.what() + ")");
  }
}

} // namespace massprops
