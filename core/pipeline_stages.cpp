#include "core/pipeline_stages.h"

#include "core/answer/host_rounding.h"
#include "core/base/parallel.h"
#include "core/base/tolerances.h"
#include "core/best/best_cavity.h"
#include "core/contour/inscribed_ball.h"
#include "core/goals/objective.h"
#include "core/goals/registry.h"
#include "core/model/frame.h"
#include "core/optimum/foot_depth.h"
#include "core/overhang/printable_bound.h"
#include "core/reduced/hollow_body.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <new>
#include <string>
#include <utility>

namespace massprops {
namespace {

bool moves(const Options& options) {
  return options.outerUpperBound > 0.0;
}

/// Crossings that nobody has looked for yet.
void requireNoCrossings(const Preparation& model) {
  PreparedBody& body = model.body;
  if (body.isFreeOfCrossings) return;
  requireNoCrossings(model.solid, model.surface, roundOff(model.posed.frame));
  body.isFreeOfCrossings = true;
}

/// The outer surface, and how far from these triangles the body stays solid; null: only as far as
/// the wall asks for.
std::unique_ptr<const TriangleTree>
surfaceKeepingOut(const TriangleTree* keptSolid, const PreparedBody& body, const Options& options) {
  const PosedModel& posed = body.posed;
  const double depth = solidDepthOf(posed, options);
  if (keptSolid == nullptr || depth <= posed.wall) return nullptr;
  auto surface = std::make_unique<TriangleTree>(body.surface);
  surface->keepOut(*keptSolid, depth - posed.wall);
  return surface;
}

/// How far offsets along the field may go for a wall to be kept.
OffsetBounds boundsKeeping(double wall, const Preparation& model, const MovingSurface& moving,
                           const OffsetField& field, const Options& options) {
  const auto bounds = moving.isCopy ? innerBoundsOfCopy : innerBounds;
  return keepingWall(moving.vertices, model.surface, field,
                     bounds(field, wall, options.innerUpperBound), wall);
}

/// The outer surface's own bounds; it keeps the point that the body hangs from.
OffsetBounds boundsOfOuter(const Preparation& model, const OffsetField& field,
                           const Options& options) {
  const PosedModel& posed = model.posed;
  OffsetBounds bounds =
      outerBounds(posed.vertices, field, options.outerLowerBound / posed.frame.length,
                  options.outerUpperBound / posed.frame.length);
  if (options.goal != GoalKind::Hang || posed.pivot) return bounds;
  const double top = posed.vertices.col(2).maxCoeff();
  for (Eigen::Index v = 0; v < posed.vertices.rows(); ++v) {
    if (posed.vertices(v, 2) >= top - kContactHeight) bounds.lower[v] = bounds.upper[v] = 0.0;
  }
  return bounds;
}

Points representable(const Options& options, const Points& points) {
  return options.representable ? options.representable(points) : points;
}

/// What is asked of a cavity, however it is found.
CavityTask taskOf(const Goal& goal, const Preparation& model, const Foundation& foundation,
                  const Options& options) {
  const PosedModel& posed = model.posed;
  CavityTask task{model.surface, goal, {}, options.weights};
  task.model.surface = foundation.coarse->moving;
  task.model.fillings = fillingsSeenBy(options);
  task.model.solidMoments = model.solidMoments;
  task.model.isOpen = posed.open.has_value();
  if (posed.open) task.open = &*posed.open;
  task.inputMoments = model.solidMoments + moments(posed.cavities.vertices, posed.cavities.faces);
  task.wall = posed.wall;
  if (foundation.possible) task.bound = foundation.possible->bound;
  task.stored = [&](const Points& working) {
    return representable(options, toModel(posed.frame, working));
  };
  task.deliverable = [&, stored = task.stored](const Points& working) {
    return toWorking(posed.frame, stored(working));
  };
  return task;
}

/// The search for an offset surface.
CavityTask offsetTask(const Goal& goal, const Preparation& model, const Foundation& foundation,
                      const Options& options) {
  const PosedModel& posed = model.posed;
  const MovingSurface& moving = *foundation.coarse->moving;
  const Points& axis = foundation.coarse->axis;
  OffsetField field =
      posed.open
          ? offsetField(moving.vertices, posed.open->skin,
                        levelAtRim(moving.vertices, moving.faces, posed.isLid, *posed.open, axis))
          : offsetField(moving.vertices, moving.faces, axis);
  CavityTask task = taskOf(goal, model, foundation, options);
  task.model.inner = boundsKeeping(posed.wall, model, moving, field, options);
  if (moves(options)) task.model.outer = boundsOfOuter(model, field, options);
  task.model.field = std::move(field);
  const bool followsOuter =
      options.goal == GoalKind::Float || options.goal == GoalKind::RollUpright;
  if (moves(options) && followsOuter) {
    task.goalFor = [&](const Points& outer) { return makeGoal(options, posed, outer); };
  }
  return task;
}

bool keepsConstraints(const CavityTask& task, const CavityResult& cavity) {
  return cavity.status == CavityStatus::Found && hollowBody(task, cavity).violation <= kFeasibility;
}

/// The best offset surface. One search: for what the goal wants instead where its constraints are
/// out of reach, else for the goal, or for it without constraints that the best body keeps by
/// itself; where it does not, a second one with them.
Search searchOffsets(const Preparation& model, const Foundation& foundation, const Options& options,
                     ProgressBar& bar) {
  bar.show(model.schedule.directions, "Offset directions");
  Search result{offsetTask(*model.goal, model, foundation, options), {}};
  bar.show(model.schedule.search, "Optimization");
  const auto searchFor = [&](CavityTask& task) {
    CavityResult found =
        searchCavity(task, bar.within(model.schedule.search, Schedule::kEnd, "Optimization"));
    found.effort += result.cavity.effort;
    return found;
  };
  const bool isOutOfReach = foundation.possible && !foundation.possible->bound.isReachable();
  const std::unique_ptr<Goal> other =
      isOutOfReach ? model.goal->insteadOfConstraints() : model.goal->relaxed();
  // A solid body that keeps them already wants nothing instead.
  if (other && !(isOutOfReach && inputBody(result.task).violation <= kFeasibility)) {
    CavityTask task = offsetTask(*other, model, foundation, options);
    if (isOutOfReach) {
      task.bound.reset(); // of another objective
      task.weights = insteadOfConstraints(task.weights);
    }
    result.cavity = searchFor(task);
    if (isUseless(result.task, result.cavity)) result.cavity.status = CavityStatus::NoGain;
    if (isOutOfReach || keepsConstraints(result.task, result.cavity)) return result;
  }
  result.cavity = searchFor(result.task);
  return result;
}

void judge(const Preparation& model, const Options& options, Search& found) {
  const bool isFound = found.cavity.status == CavityStatus::Found;
  const TriangleMesh cavity{found.cavity.inner, found.cavity.cavity.faces};
  const bool isHollow = isFound && cavity.faces.rows() > 0;
  found.verdictAfter =
      makeVerdict(options, model.posed, isFound ? found.cavity.outer : model.posed.vertices,
                  isHollow ? &cavity : nullptr);
}

/// With the levels of contents that the bound's quadric was found for.
void takeLevels(const OptimalBound& bound, Search& found) {
  Fillings& fillings = found.task.model.fillings;
  if (bound.binding.size() > fillings.size()) fillings = bound.binding;
}

/// Of an answer that serves the goal.
void findPrintMargins(const Preparation& model, Search& found) {
  // Two perimeters, as slicers print them by default with a nozzle of 0.4 mm.
  constexpr double kPerimeters = 0.9;
  if (model.posed.open || !keepsConstraints(found.task, found.cavity) ||
      !found.verdictAfter->isReached(hollowBody(found.task, found.cavity).mass)) {
    return;
  }
  const Stopwatch time;
  found.margins = printMargins(found.task, found.cavity, *found.verdictAfter,
                               kPerimeters / model.posed.frame.length);
  found.secondsMargins = time.seconds();
}

/// Where not even the bound's body does what the goal asks for: all the proofs that takes, or none.
void proveOutOfReach(const Preparation& model, const Fillings& fillings, Search& found) {
  const std::optional<OptimalBound>& bound = found.task.bound;
  if (!bound || (bound->isReachable() && !bound->outOfReach)) return;
  const Stopwatch time;
  if (bound->outOfReach) {
    found.certificates = certificates(*bound->outOfReach, model.solidMoments, fillings.front(),
                                      model.surface, model.posed.wall);
  } else {
    const std::vector<LinearConditions> conditions = model.goal->conditions();
    for (std::size_t i = 0; i < conditions.size(); ++i) {
      std::optional<Certificate> proof =
          certificate(conditions[i], model.goal->wantedLevel(), bound->levels[i],
                      model.solidMoments, fillings, model.surface, model.posed.wall);
      if (!proof) {
        found.certificates.clear();
        break;
      }
      found.certificates.push_back(*std::move(proof));
    }
  }
  found.secondsCertificate = time.seconds();
}

/// What is left of what is possible.
double gapOf(const Search& found) {
  const bool isFound = found.cavity.status == CavityStatus::Found;
  const Body before = inputBody(found.task);
  return gapToBound(*found.task.bound, before,
                    isFound ? hollowBody(found.task, found.cavity) : before);
}

/// In smaller cubes, where those of the region leave too much: what is left goes with the square of
/// their edge. Once.
void searchFiner(const Preparation& model, const Possible& possible, const Options& options,
                 Search& found) {
  constexpr double kEnough = 0.015; // of what is possible is left
  constexpr double kWanted = 0.008;
  constexpr double kFinest = 0.35;     // of the edge
  constexpr double kMost = 150000.0;   // cubes on the border
  constexpr double kHardlyFiner = 0.9; // is not worth it
  const double gap = gapOf(found);
  if (gap <= kEnough) return;
  const Room& room = *possible.room;
  const double edge = room.region.edge;
  const auto border = static_cast<double>(room.region.border.size());
  const double finer =
      edge * std::max({std::sqrt(kWanted / gap), kFinest, std::sqrt(border / kMost)});
  if (finer > kHardlyFiner * edge) return;
  const FeasibleRegion region = feasibleRegion(room.set, finer);
  const AdmissibleCells reached = admissibleCells(region, Admissible::Reached, kCells);
  CavityTask task = found.task;
  task.bound = withBodyWithin(reached, *found.task.bound, *model.goal, options.weights,
                              model.solidMoments, possible.states);
  CavityResult cavity = bestPossibleCavity(task, room.set, region);
  cavity.effort += found.cavity.effort;
  if (!servesBetter(task, cavity, found.cavity)) return;
  found.cavity = std::move(cavity);
  found.task.bound = std::move(task.bound);
}

/// What lies behind the walls on one side of the best quadric.
Search searchBest(const Preparation& model, const Foundation& foundation, const Options& options,
                  ProgressBar& bar) {
  bar.show(Schedule::kBest, "Best possible cavity");
  Search result{taskOf(*model.goal, model, foundation, options), {}};
  if (!foundation.possible) {
    result.cavity.shape = CavityShape::BestPossible;
    result.cavity.stopReason = "the wall leaves no room";
    return result;
  }
  const Possible& possible = *foundation.possible;
  const Room& room = *possible.room;
  takeLevels(possible.bound, result);
  if (options.overhangAngle > 0.0) {
    result.cavity = carriedCavity(model, possible, options, result.task);
    return result;
  }
  std::optional<CavityResult> walled =
      uniformlyWalledCavity(result.task, room.set, room.cells, room.region.edge);
  if (walled) {
    result.cavity = *std::move(walled);
    return result;
  }
  result.cavity = bestPossibleCavity(result.task, room.set, room.region);
  searchFiner(model, possible, options, result);
  return result;
}

/// Behind the wall of a surface. `rounding`: the step between positions that can be delivered, a
/// length; `cubes`: how large, of those that a cavity is found with.
Room roomBehind(const TriangleTree& surface, double wall, double rounding, double cubes) {
  constexpr double kSteps = 10.0;      // of rounding, that do not fold the triangles of a cube
  constexpr double kRoundedOff = 1e-5; // of the wall
  const FeasibleSet set{surface, (1.0 + kRoundedOff) * wall, wall};
  const double edge = cubes * edgeFor(set);
  FeasibleRegion region = feasibleRegion(set, std::max(edge, kSteps * rounding));
  AdmissibleCells cells = admissibleCells(region, Admissible::BehindWalls, kCells);
  AdmissibleCells reached = admissibleCells(region, Admissible::Reached, kCells);
  return {set, std::move(region), std::move(cells), std::move(reached)};
}

/// Kept for who asks for the same wall again.
std::shared_ptr<const Room> roomOf(const Preparation& model, const Options& options) {
  const double wall = model.posed.wall;
  const double rounding =
      roundingStep(options.representable, model.solid.vertices()) / model.posed.frame.length;
  constexpr double kCarrying = 0.7; // what carries a ceiling is narrow
  constexpr double kOfCells = 1.5;  // where no contour is made: 0.2 % of the limit
  const double cubes = !isBestPossible(options, false) ? kOfCells
                       : options.overhangAngle > 0.0   ? kCarrying
                                                       : 1.0;
  const auto make = [&] { return roomBehind(model.surface, wall, rounding, cubes); };
  if (model.ownSurface) return std::make_shared<const Room>(make());
  return model.body.room.get({wall, rounding, cubes}, make);
}

/// Empty: the wall leaves no room.
std::optional<Possible> possibleWithin(const Preparation& model, const Options& options) {
  std::shared_ptr<const Room> room = roomOf(model, options);
  const AdmissibleCells& cells = room->cells;
  const AdmissibleCells& reached = room->reached;
  if (cells.rows() == 0) return std::nullopt;
  Fillings states = fillingsSeenBy(options);
  if (states.size() > 1) {
    const double density = states.back().density;
    for (const double height : layerHeights(room->region, kCells))
      states.push_back({density, height});
  }
  const Goal& goal = *model.goal;
  const Weights& weights = options.weights;
  OptimalBound bound = optimalBound(goal, weights, model.solidMoments, states, cells);
  if (reached.rows() != cells.rows() || reached.col(0).sum() < cells.col(0).sum())
    bound = withBodyWithin(reached, std::move(bound), goal, weights, model.solidMoments, states);
  return Possible{std::move(room), std::move(bound), std::move(states)};
}

/// A thinner wall, behind which a ball as wide as it fits; 0 when none was found.
double largestWallOf(const PosedModel& posed, const TriangleTree& surface) {
  constexpr double kNearly = 0.95;  // cubes do not see what just fits
  const bool isWhole = !posed.open; // openings have lids for a ball
  const auto radius = [&](const TriangleTree& closed) {
    return largestInscribedBall(closed, posed.wall).radius;
  };
  const double wall =
      kNearly * wallWithRoomFor(isWhole ? radius(surface)
                                        : radius(TriangleTree(posed.vertices, posed.faces)));
  // Where it is no thinner than the wanted one there is a room smaller than the cubes.
  return wall < posed.wall ? wall : 0.0;
}

} // namespace

bool isBestPossible(const Options& options, bool isOpen) {
  if (options.cavityShape != CavityShape::Automatic)
    return options.cavityShape == CavityShape::BestPossible;
  return !isOpen && !moves(options);
}

double solidDepthOf(const PosedModel& posed, const Options& options) {
  constexpr double kWalls = 4.0;
  return options.solidDepth ? *options.solidDepth / posed.frame.length + roundOff(posed.frame)
                            : kWalls * posed.wall;
}

Preparation::Preparation(PreparedBody& preparedBody, const Options& options, const Stopwatch& time)
    : body(preparedBody), solid(*body.solid), posed(body.posed),
      solidMoments(body.solidMoments), keptSolid{toWorking(posed.frame, options.keptSolid.vertices),
                                                 options.keptSolid.faces},
      keptSolidTree(keptSolid.faces.rows() > 0
                        ? std::make_unique<const TriangleTree>(keptSolid.vertices, keptSolid.faces)
                        : nullptr),
      ownSurface(surfaceKeepingOut(keptSolidTree.get(), body, options)),
      surface(ownSurface ? *ownSurface : body.surface),
      goal(makeGoal(options, posed, posed.vertices)), seconds(time.seconds()) {}

Preparation prepare(PreparedModel& model, const std::optional<double>& footDepth,
                    const Options& options, ProgressBar& bar) {
  bar.show(0, "Checking the model");
  const Stopwatch time;
  return {model.body(options, footDepth, [&] { bar.show(0, "Mending the model"); }), options, time};
}

Foundation coarsen(const Preparation& model, const Options& options, ProgressBar& bar,
                   Resolution resolution) {
  Foundation result;
  const auto checkCrossings = [&] {
    const Stopwatch time;
    requireNoCrossings(model);
    result.secondsCrossings = time.seconds();
  };
  const auto findBound = [&] {
    if (moves(options) || model.posed.open) return;
    const Stopwatch time;
    std::optional<Possible> possible = possibleWithin(model, options);
    if (possible) result.possible.emplace(*std::move(possible));
    result.secondsBound = time.seconds();
  };
  const auto coarsenModel = [&] {
    bar.show(model.schedule.copy, "Coarse copies");
    const bool isCoarse = resolution == Resolution::Coarse;
    const bool mayCopy = isCoarse && !moves(options) && !model.posed.open;
    const CoarseningOptions wanted{options.basisSize, mayCopy, isCoarse,
                                   options.weights.smoothness > 0.0};
    const CopyKey key(wanted.basisSize, wanted.mayCopy, wanted.isCarrierCoarse, wanted.isSmooth);
    result.coarse = model.body.copies.get(key, [&] {
      return coarsen(
          model.posed, wanted,
          [&] { bar.show(model.schedule.skeleton, "Mean curvature skeleton and harmonic basis"); },
          checkCrossings);
    });
  };
  try {
    if (isBestPossible(options, model.posed.open.has_value())) {
      Coarsening nothing;
      nothing.moving = std::make_shared<const MovingSurface>();
      result.coarse = std::make_shared<const Coarsening>(std::move(nothing));
      bar.show(Schedule::kLimit, "Best of all cavities");
      inParallel(findBound, checkCrossings);
      return result;
    }
    // The bound needs no copies: both cores work.
    inParallel(findBound, coarsenModel);
  } catch (const InvalidInput&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    // A stage that fails may do so for crossings that nobody has looked for yet.
    requireNoCrossings(model);
    throw;
  }
  return result;
}

std::optional<double> depthOfBetterFoot(const Preparation& model, const Foundation& foundation,
                                        const Options& options) {
  if (!model.body.lowest || moves(options) || model.posed.open) return {};
  if (foundation.possible && isAmple(reserveOf(foundation.possible->bound))) return {};
  AdmissibleCells cells(0, 10);
  Fillings states = fillingsSeenBy(options);
  if (foundation.possible) {
    cells = foundation.possible->room->cells;
    states = foundation.possible->states;
  }
  return betterFootDepth(*model.body.lowest, model.posed, cells, states, options);
}

Search search(const Preparation& model, const Foundation& foundation, const Options& options,
              ProgressBar& bar) {
  const bool isOpen = model.posed.open.has_value();
  Search result = isBestPossible(options, isOpen) ? searchBest(model, foundation, options, bar)
                                                  : searchOffsets(model, foundation, options, bar);
  result.shapeReason = options.cavityShape != CavityShape::Automatic ? "as asked for"
                       : isOpen                                      ? "the surface is open"
                       : moves(options)                              ? "the outer surface moves"
                                        : "the surface is closed and stays";
  result.verdictBefore = makeVerdict(options, model.posed, model.posed.vertices);
  judge(model, options, result);
  const bool isHollow =
      result.cavity.status == CavityStatus::Found && result.cavity.inspection.components > 0;
  if (options.drainHoles > 0 && isHollow) {
    bar.show(Schedule::kEnd, "Drain holes");
    drain(model, options, result);
  }
  if (result.task.bound && result.cavity.status == CavityStatus::Found)
    raiseTo(result.task, hollowBody(result.task, result.cavity), *result.task.bound);
  bar.show(Schedule::kJudged, "Margins and proofs");
  findPrintMargins(model, result);
  if (foundation.possible) proveOutOfReach(model, foundation.possible->states, result);
  if (result.cavity.status != CavityStatus::NoRoom) return result;

  const Stopwatch time;
  result.largestWall = largestWallOf(model.posed, model.surface);
  result.secondsLargestWall = time.seconds();
  return result;
}

} // namespace massprops
