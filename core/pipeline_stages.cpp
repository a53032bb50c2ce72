#include "core/pipeline_stages.h"

#include "core/answer/delivery.h"
#include "core/answer/hollowing_report.h"
#include "core/answer/host_rounding.h"
#include "core/answer/skeleton_marks.h"
#include "core/base/angles.h"
#include "core/base/option_pairs.h"
#include "core/base/parallel.h"
#include "core/base/tolerances.h"
#include "core/best/best_cavity.h"
#include "core/best/rounded_ends.h"
#include "core/goals/objective.h"
#include "core/goals/registry.h"
#include "core/mesh/components.h"
#include "core/model/frame.h"
#include "core/model/mending.h"
#include "core/optimum/foot_depth.h"
#include "core/overhang/ceiling.h"
#include "core/overhang/printable_bound.h"
#include "core/overhang/supporting_fill.h"
#include "core/print/print_project.h"
#include "core/print/whole_file.h"
#include "core/reduced/hollow_body.h"
#include "core/reduced/search_strategy.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <filesystem>
#include <functional>
#include <new>
#include <string>
#include <utility>

namespace massprops {
namespace {

bool moves(const Options& options) {
  return options.outerUpperBound > 0.0;
}

/// The checked model, and what it stands on.
Footing stand(Solid solid, const Options& options, const std::optional<double>& depth) {
  requireSensible(options, solid.diagonal());
  requireEnoughFunctions(options);
  return onFoot(std::move(solid), options, depth);
}

PosedModel pose(const Footing& footing, const Options& options) {
  PosedModel result = makePosedModel(footing.solid, options, footing.foot);
  requireCompatible(options, result.open.has_value());
  return result;
}

/// Crossings that nobody has looked for yet.
void requireNoCrossings(const Preparation& model) {
  requireNoCrossings(model.solid, model.surface, roundOff(model.posed.frame));
}

/// The outer surface, and how far from these triangles the body stays solid.
TriangleTree surfaceOf(const PosedModel& posed, const TriangleTree* keptSolid,
                       const Options& options) {
  TriangleTree surface(posed.vertices, posed.open ? posed.open->skin : posed.faces,
                       TriangleTree::Order::Spatial);
  if (keptSolid == nullptr) return surface;
  const double depth = solidDepthOf(posed, options);
  if (depth > posed.wall) surface.keepOut(*keptSolid, depth - posed.wall);
  return surface;
}

/// Least distances of the cavity, the strips of an open surface apart.
double leastDistance(const PosedModel& posed, const CavityResult& cavity,
                     const TriangleTree& other) {
  const Eigen::Index n = cavity.inner.rows();
  const Faces& faces = cavity.cavity.faces;
  return ClearanceQuery(other)
      .measure(cavity.inner, posed.open ? withoutStrips(faces, n / 2) : faces, 0.0)
      .least;
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
  task.model.surface = foundation.coarse.moving;
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
  const MovingSurface& moving = *foundation.coarse.moving;
  const Points& axis = foundation.coarse.axis;
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

/// Whether the outer surface is moved inwards to find a cavity.
bool movesInwards(const Preparation& model, const Options& options) {
  const bool isWanted = options.overhangAngle > 0.0
                            ? options.cavityShape == CavityShape::Offset
                            : options.cavityShape != CavityShape::BestPossible;
  return isWanted || moves(options) || model.posed.open;
}

/// From this share of what is possible on it is worth looking for more.
constexpr double kFar = 0.02;

/// The best offset surface.
Search searchOffsets(const Preparation& model, const Foundation& foundation, const Options& options,
                     ProgressBar& bar) {
  bar.show(model.schedule.directions, "Offset directions");
  const auto taskFor = [&](const Goal& goal) {
    return offsetTask(goal, model, foundation, options);
  };
  const auto searchFor = [&](CavityTask& task) {
    return bestCavity(task, bar.within(model.schedule.search, Schedule::kEnd, "Optimization"));
  };
  Search result{taskFor(*model.goal), {}};
  bar.show(model.schedule.search, "Optimization");
  const std::unique_ptr<Goal> instead = model.goal->insteadOfConstraints();
  const bool isOutOfReach = foundation.possible && !foundation.possible->bound.isReachable();
  const std::unique_ptr<Goal> relaxed = isOutOfReach ? nullptr : model.goal->relaxed();
  if (relaxed) {
    CavityTask task = taskFor(*relaxed);
    result.cavity = searchFor(task);
  }
  const bool isDone = relaxed && keepsConstraints(result.task, result.cavity);
  if (!isDone && !(instead && isOutOfReach)) {
    CavityResult found = searchFor(result.task);
    found.effort += result.cavity.effort;
    result.cavity = std::move(found);
  }
  // A solid body that keeps them already wants nothing instead.
  const bool isSolidEnough = inputBody(result.task).violation <= kFeasibility;
  if (instead && !isSolidEnough &&
      (isOutOfReach || !keepsConstraints(result.task, result.cavity))) {
    CavityTask task = taskFor(*instead);
    task.bound.reset(); // of another objective
    task.weights = insteadOfConstraints(task.weights);
    CavityResult other = searchFor(task);
    other.effort += result.cavity.effort;
    if (isUseless(result.task, other)) other.status = CavityStatus::NoGain;
    if (!servesBetter(result.task, result.cavity, other)) result.cavity = std::move(other);
  }
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

Fillings statesOfLimit(const TriangleTree& surface, double edge, Fillings states) {
  if (states.size() < 2) return states;
  const double density = states.back().density;
  for (const double height : layerHeights(surface, edge)) states.push_back({density, height});
  return states;
}

/// Working frame.
OverhangWishes overhangWishes(const PosedModel& posed, const Options& options) {
  constexpr double kMore = 5.0; // degrees
  OverhangWishes wishes;
  wishes.toPrint = rotationToUp(buildAxisOf(options)) * posed.frame.rotation.transpose();
  wishes.leastAngle = options.overhangAngle / kDegrees;
  wishes.angle = (options.overhangAngle + kMore) / kDegrees;
  wishes.bridge = kBridge / posed.frame.length;
  wishes.tipDepth = kTipDepth / posed.frame.length;
  return wishes;
}

/// Empty: the wall leaves no room. `solid`: moments of the body within the surface.
std::optional<Possible> possibleWithin(const TriangleTree& surface, double wall, const Goal& goal,
                                       const Moments& solid, const Options& options) {
  const RegionParts behindWalls = resolvedParts(surface, wall);
  const AdmissibleCells cells = cellsOf(behindWalls);
  if (cells.rows() == 0) return std::nullopt;
  const Weights& weights = options.weights;
  Fillings states = statesOfLimit(surface, behindWalls.edge, fillingsSeenBy(options));
  OptimalBound bound = optimalBound(goal, weights, solid, states, cells);
  Deliverable deliverable = deliverableSet(surface, wall, behindWalls, cells);
  if (deliverable.cells.col(0).sum() < cells.col(0).sum())
    bound = withBodyWithin(deliverable.cells, std::move(bound), goal, weights, solid, states);
  Possible result{cells, std::move(bound), std::move(deliverable.set), std::move(states)};
  return result;
}

/// Why the best possible cavity is worth looking for; empty: it is not.
std::string reasonForBestPossible(const Options& options, const OptimalBound& bound,
                                  const Search& found) {
  if (options.cavityShape == CavityShape::BestPossible) return "as asked for";
  if (options.overhangAngle > 0.0) {
    return "no offset surface is looked for where ceilings are to carry themselves";
  }
  const auto percent = [](double share) { return toString(std::round(1000.0 * share) / 10.0); };
  if (found.cavity.status == CavityStatus::NoRoom) return "the offset surface has no room";
  const bool isFound = found.cavity.status == CavityStatus::Found;
  const Body before = inputBody(found.task);
  const Body after = isFound ? hollowBody(found.task, found.cavity) : before;
  const double gap = gapToBound(bound, before, after);
  const auto isSolved = [&](const Verdict& verdict, const Moments& mass, double violation) {
    return violation <= kFeasibility && verdict.isReached(mass);
  };
  const bool isMissed = gap > 0.0 && !isSolved(*found.verdictAfter, after.mass, after.violation);
  std::string missed = "the offset surface misses the goal";
  if (isMissed && isSolved(*found.verdictBefore, bound.massMoments, bound.violation)) return missed;
  // With a weight on smoothness it is far by intention.
  if (options.weights.smoothness == 0.0) {
    if (gap > kFar) return "the offset surface leaves " + percent(gap) + " % of what is possible";
    if (found.cavity.pleatedEnds > 0) return "ends of the offset surface are not smooth";
  }
  return isMissed ? missed : "";
}

/// A body whose outer surface has moved, as one that rests.
struct Moved {
  std::unique_ptr<const Goal> own; ///< null: the goal does not depend on the outer surface
  TriangleTree surface;
  Moments solidMoments;

  Moved(const Preparation& model, const CavityTask& search, const Points& outer)
      : own(search.goalFor ? search.goalFor(outer) : nullptr),
        surface(outer, model.posed.faces, TriangleTree::Order::Spatial),
        solidMoments(moments(outer, model.posed.faces)) {}

  const Goal& goal(const CavityTask& search) const { return own ? *own : search.goal; }

  CavityTask task(const CavityTask& search, const Possible& possible) const {
    CavityTask task{surface, goal(search), {}, search.weights};
    task.model.surface = search.model.surface;
    task.model.fillings = search.model.fillings;
    task.model.solidMoments = solidMoments;
    task.inputMoments = search.inputMoments;
    task.wall = search.wall;
    task.bound = possible.bound;
    task.deliverable = search.deliverable;
    task.stored = search.stored;
    return task;
  }
};

/// What is possible within the outer surface as a search left it.
class Room {
public:
  Room(const Preparation& model, const Foundation& foundation, const Options& options,
       const Search& found)
      : model_(model), foundation_(foundation) {
    if (!moves(options)) return;
    const bool hasMoved = found.cavity.status == CavityStatus::Found;
    moved_.emplace(model, found.task, hasMoved ? found.cavity.outer : model.posed.vertices);
    std::optional<Possible> possible = possibleWithin(
        moved_->surface, model.posed.wall, moved_->goal(found.task), moved_->solidMoments, options);
    if (possible) possible_.emplace(*std::move(possible));
  }

  /// Null: it is not known.
  const Possible* possible() const {
    const std::optional<Possible>& known = moved_ ? possible_ : foundation_.possible;
    return known ? &*known : nullptr;
  }
  const TriangleTree& surface() const { return moved_ ? moved_->surface : model_.surface; }
  /// The search's, as one whose outer surface rests. \pre what is possible is known
  CavityTask task(const CavityTask& search) const {
    return moved_ ? moved_->task(search, *possible()) : search;
  }

private:
  const Preparation& model_;
  const Foundation& foundation_;
  std::optional<Moved> moved_;
  std::optional<Possible> possible_; ///< within what moved
};

/// Looked for once.
const Room& roomFor(std::optional<Room>& known, const Preparation& model,
                    const Foundation& foundation, const Options& options, const Search& found) {
  if (!known) known.emplace(model, foundation, options, found);
  return *known;
}

/// In the worst of the states that the verdict goes by and no quadric knows; empty: there are none.
std::optional<double> worstMeasure(const Search& found) {
  const bool isFound = found.cavity.status == CavityStatus::Found;
  return found.verdictAfter->worstMeasure(
      (isFound ? hollowBody(found.task, found.cavity) : inputBody(found.task)).mass);
}

/// With the levels of contents that the bound's quadric was found for.
void takeLevels(const OptimalBound& bound, Search& found) {
  Fillings& fillings = found.task.model.fillings;
  if (bound.binding.size() > fillings.size()) fillings = bound.binding;
}

/// The best that was found of those whose ceilings carry themselves; where its triangles hang down
/// nevertheless, with columns below. `within`: null, or a closed outward surface that it does not
/// leave.
CavityResult carriedCavity(const Preparation& model, const Possible& possible,
                           const Options& options, const TriangleMesh* within, CavityTask task) {
  const RegionParts behindWalls = resolvedParts(model.surface, model.posed.wall);
  const OverhangWishes wishes = overhangWishes(model.posed, options);
  const PrintableTask printing{*model.goal,     options.weights, model.solidMoments,
                               possible.states, behindWalls,     wishes,
                               within};
  const auto tipsOf = [&](const CavityResult& cavity) {
    return ceilingOf({cavity.inner, cavity.cavity.faces}, wishes.toPrint, wishes.leastAngle,
                     wishes.tipDepth)
        .tips;
  };
  constexpr int kRounds = 4;
  CavityResult best;
  std::size_t fewest = 0;
  SearchEffort effort;
  const Stopwatch time;
  std::optional<Printable> found = printable(printing, possible.deliverable, possible.bound);
  for (int round = 0; round < kRounds; ++round) {
    task.bound = found->bound;
    const Cubes cubes = round == 0 ? Cubes::AsFineAsItTakes : Cubes::OfTheSet;
    CavityResult cavity = bestPossibleCavity(task, found->set, cubes);
    effort += cavity.effort;
    const bool isFound = cavity.status == CavityStatus::Found;
    const std::vector<Vec3> tips = isFound ? tipsOf(cavity) : std::vector<Vec3>{};
    if (round == 0 || (isFound && tips.size() < fewest)) {
      best = std::move(cavity);
      fewest = tips.size();
    }
    if (tips.empty() || !found->filled || round + 1 == kRounds) break;
    found.emplace(withColumns(printing, *found, tips));
    found->set.edge = best.edge;
  }
  effort.secondsOptimization = time.seconds() - effort.secondsInspection;
  best.effort = effort;
  return best;
}

/// What of an offset surface's cavity is left when its ceilings carry themselves.
void carryCeilings(const Preparation& model, const Foundation& foundation, const Options& options,
                   ProgressBar& bar, Search& found) {
  if (found.cavity.status != CavityStatus::Found || found.cavity.cavity.faces.rows() == 0) return;
  if (!foundation.possible) return;
  bar.show(Schedule::kEnd, "Ceilings that carry themselves");
  takeLevels(foundation.possible->bound, found);
  const TriangleMesh offsets = submesh(found.cavity.inner, found.cavity.cavity.faces).mesh;
  CavityResult cavity = carriedCavity(model, *foundation.possible, options, &offsets, found.task);
  cavity.shape = CavityShape::Offset;
  cavity.effort += found.cavity.effort;
  found.cavity = std::move(cavity);
  judge(model, options, found);
}

/// Takes it where it is asked for or serves better: within the outer surface as it has become. What
/// serves less, if both are there and it might serve more with round ends.
std::optional<CavityResult> considerBestPossible(const Preparation& model,
                                                 const Foundation& foundation,
                                                 const Options& options, ProgressBar& bar,
                                                 std::optional<Room>& known, Search& found) {
  found.shapeReason = "as asked for";
  if (options.cavityShape == CavityShape::Offset) return {};
  if (model.posed.open) {
    found.shapeReason = "the best possible cavity needs a closed surface";
    return {};
  }
  const bool hasMoved = moves(options) && found.cavity.status == CavityStatus::Found;
  const Room& room = roomFor(known, model, foundation, options, found);
  const Possible* possible = room.possible();
  if (possible == nullptr) {
    found.shapeReason = "what is possible is not known";
    return {};
  }
  found.shapeReason = "it comes near to what is possible";
  const std::string reason = reasonForBestPossible(options, possible->bound, found);
  if (reason.empty()) return {};
  bar.show(Schedule::kEnd, "Best possible cavity");
  takeLevels(possible->bound, found);
  CavityResult best;
  if (options.overhangAngle > 0.0 && !moves(options)) {
    best = carriedCavity(model, *possible, options, nullptr, found.task);
  } else {
    best = bestPossibleCavity(room.task(found.task), possible->deliverable);
    if (moves(options)) {
      best.outer = room.surface().vertices();
      best.outerOffsets = found.cavity.outerOffsets;
    }
  }
  best.effort += found.cavity.effort;
  if ((movesInwards(model, options) || hasMoved) && !servesBetter(found.task, best, found.cavity)) {
    found.shapeReason = "the best possible cavity's triangles serve no better";
    // It sees room where no offset surface has any.
    if (found.cavity.status == CavityStatus::NoRoom && best.status == CavityStatus::NoGain) {
      found.cavity = std::move(best);
      return {};
    }
    if (worstMeasure(found)) return {};
    return best;
  }
  const std::optional<double> worst = worstMeasure(found);
  CavityResult offsets = std::exchange(found.cavity, std::move(best));
  judge(model, options, found);
  found.shapeReason = reason;
  if (options.cavityShape == CavityShape::BestPossible) return {};
  if (!worst) return offsets;
  if (worstMeasure(found) >= worst) return {};
  found.cavity = std::move(offsets);
  judge(model, options, found);
  found.shapeReason = "the best possible cavity serves less while its rooms are filled";
  return {};
}

/// Where ends of an offset surface are not smooth.
void roundEnds(const Preparation& model, const Foundation& foundation, const Options& options,
               ProgressBar& bar, std::optional<Room>& known, Search& found) {
  const CavityResult& cavity = found.cavity;
  const bool isThere = cavity.status == CavityStatus::Found ||
                       (cavity.status == CavityStatus::NoGain && !moves(options));
  if (!isThere || cavity.shape != CavityShape::Offset || cavity.pleatedEnds == 0) return;
  // A quadric knows nothing of how smooth offsets are.
  if (options.weights.smoothness > 0.0) return;
  bar.show(Schedule::kEnd, "Round ends");
  const Room& room = roomFor(known, model, foundation, options, found);
  if (room.possible() == nullptr) return;
  const Possible& possible = *room.possible();
  takeLevels(possible.bound, found);
  const RegionParts behindWalls = resolvedParts(room.surface(), model.posed.wall);
  found.cavity = withRoundedEnds(
      room.task(found.task), {possible.deliverable, behindWalls, possible.states}, found.cavity);
  judge(model, options, found);
}

/// Ends are round only after one of the shapes was taken: the other one takes its place if it
/// serves more then.
void reconsider(const Preparation& model, const Foundation& foundation, const Options& options,
                ProgressBar& bar, std::optional<Room>& known, CavityResult other, Search& found) {
  const bool isOffset = other.shape == CavityShape::Offset;
  const std::string reason = std::exchange(
      found.shapeReason, isOffset ? "with round ends it serves more than the best possible cavity"
                                  : "with smooth ends the offset surface serves less");
  CavityResult taken = std::exchange(found.cavity, std::move(other));
  found.cavity.effort = taken.effort;
  roundEnds(model, foundation, options, bar, known, found);
  if (servesBetter(found.task, found.cavity, taken)) {
    judge(model, options, found);
    return;
  }
  taken.effort = found.cavity.effort;
  found.cavity = std::move(taken);
  found.shapeReason = reason;
  judge(model, options, found);
}

Search bestOfShapes(const Preparation& model, const Foundation& foundation, const Options& options,
                    ProgressBar& bar) {
  Search result = movesInwards(model, options)
                      ? searchOffsets(model, foundation, options, bar)
                      : Search{taskOf(*model.goal, model, foundation, options), {}};
  result.verdictBefore = makeVerdict(options, model.posed, model.posed.vertices);
  judge(model, options, result);
  std::optional<Room> known;
  std::optional<CavityResult> other =
      considerBestPossible(model, foundation, options, bar, known, result);
  roundEnds(model, foundation, options, bar, known, result);
  if (other && !moves(options))
    reconsider(model, foundation, options, bar, known, *std::move(other), result);
  if (options.cavityShape == CavityShape::Offset && options.overhangAngle > 0.0)
    carryCeilings(model, foundation, options, bar, result);
  return result;
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

/// That any of the shapes asked for leaves room behind; 0 when none was found.
double largestWallOf(const Preparation& model, const Foundation& foundation, const Options& options,
                     const CavityTask& task, const std::function<void(double)>& progress) {
  double wall = 0.0;
  if (options.cavityShape != CavityShape::Offset && !model.posed.open)
    wall = largestWallForBestPossible(task, progress);
  if (!movesInwards(model, options)) return wall;
  const auto boundsFor = [&](double some) {
    return boundsKeeping(some, model, *foundation.coarse.moving, task.model.field, options);
  };
  return std::max(wall, largestWall(task, boundsFor, progress));
}

} // namespace

double solidDepthOf(const PosedModel& posed, const Options& options) {
  constexpr double kWalls = 4.0;
  return options.solidDepth ? *options.solidDepth / posed.frame.length + roundOff(posed.frame)
                            : kWalls * posed.wall;
}

Preparation::Preparation(const TriangleMesh& model, const Options& options, Resolution resolution,
                         const Known& known)
    : footing(stand(known.mended
                        ? *known.mended
                        : makeSolid(model, options.openSurface, rotationToUp(options.upAxis)),
                    options, known.footDepth)),
      solid(footing.solid),
      posed(pose(footing, options)), keptSolid{toWorking(posed.frame, options.keptSolid.vertices),
                                               options.keptSolid.faces},
      keptSolidTree(keptSolid.faces.rows() > 0
                        ? std::make_unique<const TriangleTree>(keptSolid.vertices, keptSolid.faces)
                        : nullptr),
      surface(surfaceOf(posed, keptSolidTree.get(), options)),
      solidMoments(moments(posed.vertices, posed.faces)),
      goal(makeGoal(options, posed, posed.vertices)),
      mayCopy(resolution == Resolution::Coarse && !moves(options) && !posed.open),
      isCarrierCoarse(resolution == Resolution::Coarse) {}

Preparation prepare(const TriangleMesh& model, const Options& options, ProgressBar& bar,
                    Resolution resolution, const Known& known) {
  bar.show(0, "Checking the model");
  return {model, options, resolution, known};
}

/// In single precision where that is far finer than what mending merges: so the same file becomes
/// the same solid whatever the host stores.
Points roundedForMending(const Points& points, bool inFloats, const Options& options) {
  return representable(options, inFloats ? Points(points.cast<float>().cast<double>()) : points);
}

Solid mend(const TriangleMesh& model, const Options& options, ProgressBar& bar) {
  bar.show(0, "Mending the model");
  MendingTask task;
  const bool isWallGiven = options.innerLowerBound && *options.innerLowerBound > 0.0;
  task.wall = isWallGiven ? *options.innerLowerBound : kDefaultWall * diagonalOf(model.vertices);
  task.rotation = rotationToUp(options.upAxis);
  task.keepsOpenings = options.openSurface;
  const bool inFloats = isFloatFineFor(model.vertices);
  task.representable = [&](const Points& points) {
    return roundedForMending(points, inFloats, options);
  };
  std::optional<Solid> solid = mended({task.representable(model.vertices), model.faces}, task);
  if (!solid) throw DefectiveSurface("The surface cannot be mended.");
  return *std::move(solid);
}

Foundation coarsen(const Preparation& model, const Options& options, ProgressBar& bar) {
  Foundation result;
  const auto checkCrossings = [&] {
    const Stopwatch time;
    requireNoCrossings(model);
    result.secondsCrossings = time.seconds();
  };
  const auto findBound = [&] {
    if (moves(options) || model.posed.open) return;
    const Stopwatch time;
    std::optional<Possible> possible =
        possibleWithin(model.surface, model.posed.wall, *model.goal, model.solidMoments, options);
    if (possible) result.possible.emplace(std::move(*possible));
    result.secondsBound = time.seconds();
  };
  const auto coarsenModel = [&] {
    bar.show(model.schedule.copy, "Coarse copies");
    const CoarseningOptions wanted{options.basisSize, model.mayCopy, model.isCarrierCoarse,
                                   options.weights.smoothness > 0.0};
    result.coarse = coarsen(
        model.posed, wanted,
        [&] { bar.show(model.schedule.skeleton, "Mean curvature skeleton and harmonic basis"); },
        checkCrossings);
  };
  try {
    if (!movesInwards(model, options)) {
      result.coarse.moving = std::make_shared<const MovingSurface>();
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
  if (!model.footing.lowest || moves(options) || model.posed.open) return {};
  if (foundation.possible && isAmple(reserveOf(foundation.possible->bound))) return {};
  AdmissibleCells cells(0, 10);
  Fillings states = fillingsSeenBy(options);
  if (foundation.possible) {
    cells = foundation.possible->cells;
    states = foundation.possible->states;
  }
  return betterFootDepth(*model.footing.lowest, model.posed, cells, states, options);
}

Search search(const Preparation& model, const Foundation& foundation, const Options& options,
              ProgressBar& bar) {
  Search result = bestOfShapes(model, foundation, options, bar);
  const bool isHollow =
      result.cavity.status == CavityStatus::Found && result.cavity.inspection.components > 0;
  if (options.drainHoles > 0 && isHollow) {
    bar.show(Schedule::kEnd, "Drain holes");
    drain(model, options, result);
  }
  if (result.task.bound && result.cavity.status == CavityStatus::Found)
    raiseTo(result.task, hollowBody(result.task, result.cavity), *result.task.bound);
  findPrintMargins(model, result);
  if (foundation.possible) proveOutOfReach(model, foundation.possible->states, result);
  if (result.cavity.status != CavityStatus::NoRoom) return result;

  const Stopwatch time;
  constexpr int kFound = 99; // before the report
  const auto progress = bar.within(Schedule::kEnd, kFound, "Largest wall that leaves room");
  result.largestWall = largestWallOf(model, foundation, options, result.task, progress);
  result.secondsLargestWall = time.seconds();
  return result;
}

Result deliver(const Preparation& model, const Foundation& foundation, const Search& found,
               const Options& options, ProgressBar& bar) {
  constexpr int kFound = 96;
  bar.show(kFound, "Report");
  Result result;
  Delivery delivery =
      deliver(model.solid, model.posed, found.task, found.cavity, foundation.coarse.vertexOf,
              [&](const Points& points) { return representable(options, points); });
  result.inner = std::move(delivery.inner);
  result.innerWall = std::move(delivery.innerWall);
  result.outer = std::move(delivery.outer);
  if (found.drainage && !found.drainage->holes.empty()) {
    result.drilled = found.drainage->drilled.body;
    result.plugs = assembled(found.drainage->drilled.plugs);
  }
  return result;
}

Report report(const Preparation& model, const Foundation& foundation, const Search& found,
              const Options& options) {
  const Coarsening& coarse = foundation.coarse;
  Stages stages;
  stages.repairs = model.solid.repairs();
  if (found.cavity.status != CavityStatus::Found) stages.repairs.replacedCavities = 0; // they stay
  if (model.keptSolidTree && found.cavity.status == CavityStatus::Found) {
    const TriangleTree surface(model.posed.vertices, model.surface.faces(),
                               TriangleTree::Order::Spatial);
    stages.leastWall = leastDistance(model.posed, found.cavity, surface);
    stages.solidDepth = leastDistance(model.posed, found.cavity, *model.keptSolidTree);
  }
  if (options.overhangAngle > 0.0 && found.cavity.status == CavityStatus::Found) {
    const OverhangWishes wishes = overhangWishes(model.posed, options);
    stages.ceiling = ceilingOf({found.cavity.inner, found.cavity.cavity.faces}, wishes.toPrint,
                               wishes.leastAngle, wishes.tipDepth);
  }
  stages.skeletonFailures = coarse.skeleton.failedComponents;
  stages.largestWall = found.largestWall;
  stages.rounding = roundingStep(options.representable, model.solid.vertices());
  stages.shapeReason = found.shapeReason;
  stages.secondsCheck = model.seconds + foundation.secondsCrossings;
  stages.secondsCopy = coarse.secondsCopy;
  stages.secondsSkeleton = coarse.secondsSkeleton;
  stages.secondsBasis = coarse.secondsBasis;
  stages.secondsLimit = foundation.secondsBound;
  stages.secondsLargestWall = found.secondsLargestWall;
  stages.drainage = found.drainage ? &*found.drainage : nullptr;
  stages.margins = found.margins;
  stages.secondsMargins = found.secondsMargins;
  stages.certificates = found.certificates;
  stages.secondsCertificate = found.secondsCertificate;
  return hollowingReport(model.posed, found.task, {*found.verdictBefore, *found.verdictAfter},
                         found.cavity, options, stages);
}

void print(const Preparation& model, const Search& found, const Options& options, ProgressBar& bar,
           Result& result) {
  bar.show(98, "Project for the slicer");
  const Solid& solid = model.solid;
  const bool isFound = found.cavity.status == CavityStatus::Found;
  PrintJob job;
  job.isOpen = model.posed.open.has_value();
  job.wall = model.posed.wall * model.posed.frame.length;
  job.outer =
      isFound && result.outer ? *result.outer : submesh(solid.vertices(), solid.skin()).mesh;
  job.cavity = isFound ? result.inner : solid.cavities();
  const std::string name = std::filesystem::u8path(options.printFile).stem().u8string();
  const PrintProject project = printProject(job, options, name);
  describe(project, result.report);
  writeWhole(options.printFile,
             [&](const std::string& path) { writeArchive(path, filesOf(project, result.report)); });
}

void draw(const Preparation& model, const Foundation& foundation, const Search& found,
          const Options& options, ProgressBar& bar, Result& result) {
  if (found.cavity.status != CavityStatus::Found) return;
  bar.show(97, "Picture of the answer");
  PictureResult drawn = pictureOf(model.posed, found.task, *found.verdictAfter, found.cavity);
  result.picture = std::move(drawn.picture);
  if (!result.picture) {
    result.report.add("picture", drawn.failure);
    return;
  }
  if (!movesInwards(model, options)) return;
  const Coarsening& coarse = foundation.coarse;
  ColouredMesh& skeleton = result.picture->skeleton;
  skeleton = skeletonMarks(coarse.moving->carrier.mesh, coarse.skeleton);
  skeleton.mesh.vertices = toModel(model.posed.frame, skeleton.mesh.vertices);
}

} // namespace massprops
