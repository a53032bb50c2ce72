#include "core/reduced/cavity_search.h"

#include "core/base/stopwatch.h"
#include "core/mesh/lipschitz.h"
#include "core/mesh/vertex_adjacency.h"
#include "core/query/triangle_tree.h"
#include "core/reduced/closing_in.h"
#include "core/reduced/hollow_body.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace massprops {
namespace {

/// Of optimisation and inspection; few models take more than a handful.
constexpr int kMostRounds = 24;
/// From this round on what fails becomes solid at once.
constexpr int kPatience = 8;
/// Rounds that may fill narrow parts: each can lay bare a few more.
constexpr int kTrims = 3;
/// The outer surface starts near where it was: it is to look the same.
constexpr double kOuterStart = 0.1;
/// Ends of the cavity go on moving where the objective hardly changes any more.
constexpr int kMostEvaluations = 600;
constexpr double kObjectiveTolerance = 1e-6;
/// Rounds in which a goal that depends on the outer surface follows its motion; then that rests,
/// and the cavity is fitted to it.
constexpr int kFollowing = 3;

const Points& movingVertices(const CavityTask& task) {
  return task.model.surface->vertices;
}

const Faces& movingFaces(const CavityTask& task) {
  return task.model.surface->faces;
}

/// That a cavity's faces refer to.
Eigen::Index positionCount(const CavityTask& task) {
  return (task.open != nullptr ? 2 : 1) * movingVertices(task).rows();
}

void addMarks(std::vector<char>& solid, const std::vector<char>& more) {
  for (std::size_t v = 0; v < more.size(); ++v) solid[v] = solid[v] != 0 || more[v] != 0 ? 1 : 0;
}

/// Keeps u ≥ l at solid vertices, whose offsets no longer matter.
void keepOrdered(OffsetBounds& bounds) {
  bounds.lower = bounds.lower.cwiseMin(bounds.upper);
}

/// Existing cavities would be filled without a new one.
bool mayMoveOuterAlone(const CavityTask& task) {
  return task.model.outer.has_value() && task.inputMoments == task.model.solidMoments;
}

/// The positions that a cavity's faces refer to.
Points cavityPositions(const CavityTask& task, const Points& inner) {
  return task.open != nullptr ? stacked(inner, movingVertices(task)) : inner;
}

Faces offsetFaces(const CavityTask& task, const Faces& cavity) {
  return task.open != nullptr ? withoutStrips(cavity, movingVertices(task).rows()) : cavity;
}

/// Whether an opening of the surface would be closed by material.
bool closesOpening(const CavityTask& task, const std::vector<char>& solid) {
  return task.open != nullptr &&
         std::any_of(task.open->rim.begin(), task.open->rim.end(),
                     [&](int v) { return solid[static_cast<std::size_t>(v)] != 0; });
}

Inspection inspectResult(const CavityTask& task, const CavityResult& result,
                         ClearanceQuery& clearance) {
  const Faces& cavity = result.cavity.faces;
  if (task.open != nullptr)
    return inspectShell(result.inner, cavity, task.surface, task.wall, task.stored);
  if (task.model.outer) {
    const TriangleTree moved(result.outer, task.surface.faces(), TriangleTree::Order::Spatial);
    Inspection inspection = inspect(result.inner, cavity, moved, task.wall, nullptr, task.stored);
    inspection.outerCrossing = outerCrossings(moved, task.stored);
    return inspection;
  }
  return inspect(result.inner, cavity, task.surface, task.wall, &clearance, task.stored);
}

/// One search from the middle of the bounds to a cavity that passes inspection, in rounds.
class CavitySearch {
public:
  CavitySearch(const CavityTask& task, const std::function<void(double)>& progress);

  CavityResult run();

private:
  void beginRound(int round);
  bool closeCavity();
  void optimize();
  void placeAndInspect();
  CavityResult withStatus();

  const CavityTask& task_;
  const std::function<void(double)>& progress_;
  const VertexAdjacency neighbours_;
  const Faces& cavityFaces_; ///< when nothing is solid
  const VertexCorners corners_;
  OffsetModel model_;
  SearchLimits limits_; ///< as the rounds close them in
  Vector coefficients_;
  OffsetSurfaces surfaces_; ///< that the coefficients stand for
  MinimizeOptions solver_;
  std::unique_ptr<Goal> movedGoal_;
  const Goal* goal_;
  std::shared_ptr<ClearanceQuery> clearance_;
  CavityResult result_;
};

CavitySearch::CavitySearch(const CavityTask& task, const std::function<void(double)>& progress)
    : task_(task), progress_(progress),
      neighbours_(vertexAdjacency(movingVertices(task).rows(), movingFaces(task))),
      cavityFaces_(task.open != nullptr ? task.open->cavity : movingFaces(task)),
      corners_(vertexCorners(positionCount(task), cavityFaces_)),
      model_(task.model), limits_{task.model.inner,
                                  task.model.outer,
                                  tooThin(task.model.field, task.model.inner),
                                  {}},
      goal_(&task.goal), clearance_(std::make_shared<ClearanceQuery>(task.surface)) {
  limits_.thinRounds.resize(limits_.solid.size());
  limits_.solid.resize(static_cast<std::size_t>(positionCount(task)), 0);
  limits_.inner.lower = lipschitzAbove(movingVertices(task), neighbours_,
                                       limits_.inner.lower.cwiseMin(limits_.inner.upper));
  solver_.maxEvaluations = kMostEvaluations;
  solver_.objectiveTolerance = kObjectiveTolerance;
  Vector outerStart;
  if (limits_.outer)
    outerStart = limits_.outer->lower + kOuterStart * (limits_.outer->upper - limits_.outer->lower);
  coefficients_ =
      coefficientsFor(model_, 0.5 * (limits_.inner.lower + limits_.inner.upper), outerStart);
  result_.outer = task.surface.vertices();
}

CavityResult CavitySearch::run() {
  for (int round = 0; round < kMostRounds; ++round) {
    result_.effort.rounds = round + 1;
    const Stopwatch optimization;
    beginRound(round);
    if (!closeCavity()) {
      result_.stopReason = "no room for a cavity at an opening";
      return std::move(result_);
    }
    optimize();
    const bool isTrimmed =
        round < kTrims && fillNarrowParts(task_, surfaces_, model_.inner,
                                          offsetFaces(task_, result_.cavity.faces), limits_.solid);
    result_.effort.secondsOptimization += optimization.seconds();
    if (isTrimmed) continue;

    const Stopwatch inspection;
    placeAndInspect();
    result_.effort.secondsInspection += inspection.seconds();
    if (progress_) progress_(1.0 - 1.0 / (2.0 + round));
    const bool follows = task_.goalFor && round < kFollowing;
    if (result_.inspection.isClean() && !follows) return withStatus();
    closeIn(task_, result_, neighbours_, round < kPatience, limits_);
  }
  result_.stopReason = "no cavity passes inspection";
  return std::move(result_);
}

/// The bounds of this round, and what has no room between them; the goal for the outer surface as
/// it has become.
void CavitySearch::beginRound(int round) {
  addMarks(limits_.solid, tooThin(task_.model.field, limits_.inner));
  model_.inner = limits_.inner;
  keepOrdered(model_.inner);
  model_.outer = limits_.outer;
  if (!task_.goalFor) return;
  const OffsetSurfaces present = offsetSurfaces(model_, coefficients_);
  if (round == kFollowing) {
    limits_.outer->lower = limits_.outer->upper = present.outerOffsets;
    model_.outer = limits_.outer;
  }
  movedGoal_ = task_.goalFor(task_.deliverable(present.outer));
  goal_ = movedGoal_.get();
}

/// Closes the cavity where it ends. False where an opening would be closed by material.
bool CavitySearch::closeCavity() {
  // The caps of a cavity that did not fold will do where it ends as it did.
  if (limits_.solid != result_.cavity.solid || !result_.inspection.crossing.empty()) {
    result_.cavity =
        cavitySurface(cavityPositions(task_, offsetSurfaces(model_, coefficients_).inner),
                      cavityFaces_, corners_, limits_.solid);
    limits_.solid = result_.cavity.solid;
  }
  model_.innerFaces = result_.cavity.faces;
  return !closesOpening(task_, limits_.solid);
}

void CavitySearch::optimize() {
  MinimizeResult best =
      minimize([&](const Vector& x) { return evaluate(model_, *goal_, task_.weights, x); },
               coefficients_, solver_);
  solver_.objectiveScale = best.objectiveScale;
  coefficients_ = std::move(best.x);
  result_.effort.evaluations += best.evaluations;
  result_.stopReason = std::move(best.stopReason);
  surfaces_ = offsetSurfaces(model_, coefficients_);
}

void CavitySearch::placeAndInspect() {
  result_.inner = cavityPositions(task_, task_.deliverable(surfaces_.inner));
  if (model_.outer) result_.outer = task_.deliverable(surfaces_.outer);
  result_.innerOffsets = std::move(surfaces_.innerOffsets);
  result_.outerOffsets = std::move(surfaces_.outerOffsets);
  result_.inspection = inspectResult(task_, result_, *clearance_);
}

/// Of clean surfaces: a moved outer surface may serve the goal alone.
CavityResult CavitySearch::withStatus() {
  const bool hasCavity = result_.inspection.components > 0;
  if (hasCavity || mayMoveOuterAlone(task_)) result_.status = CavityStatus::Found;
  if (!model_.outer && task_.open == nullptr) result_.clearance = std::move(clearance_);
  return std::move(result_);
}

} // namespace

Moments outerMoments(const CavityTask& task, const CavityResult& result) {
  const Moments outer =
      task.model.outer ? moments(result.outer, movingFaces(task)) : task.model.solidMoments;
  return outer + task.model.attached;
}

SearchEffort& SearchEffort::operator+=(const SearchEffort& other) {
  evaluations += other.evaluations;
  rounds += other.rounds;
  secondsOptimization += other.secondsOptimization;
  secondsInspection += other.secondsInspection;
  return *this;
}

CavityResult searchCavity(CavityTask& task, const std::function<void(double)>& progress) {
  Fillings& fillings = task.model.fillings;
  if (task.bound && task.bound->binding.size() > fillings.size()) fillings = task.bound->binding;
  CavityResult result = CavitySearch(task, progress).run();
  if (isUseless(task, result)) result.status = CavityStatus::NoGain;
  return result;
}

} // namespace massprops
