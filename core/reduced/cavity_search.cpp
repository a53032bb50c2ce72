#include "core/reduced/cavity_search.h"

#include "core/base/parallel.h"
#include "core/base/stopwatch.h"
#include "core/base/tolerances.h"
#include "core/base/triangle.h"
#include "core/mesh/lipschitz.h"
#include "core/mesh/signed_volume.h"
#include "core/mesh/vertex_adjacency.h"
#include "core/query/triangle_tree.h"
#include "core/reduced/coarse_to_fine.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <vector>

namespace massprops {
namespace {

constexpr int kMostRounds = 30;
/// From this round on what fails becomes solid at once.
constexpr int kPatience = 10;
/// Rounds that may fill narrow parts: each can lay bare a few more.
constexpr int kTrims = 3;
/// Filling less than this share of the cavity's vertices is not worth another such round.
constexpr double kWorthTrimming = 0.01;
/// A step that was seen to clear most folds in one to three rounds.
constexpr double kShrink = 0.6;
/// The outer surface starts near where it was: it is to look the same.
constexpr double kOuterStart = 0.1;
/// Rounds in which a goal that depends on the outer surface follows its motion; then that rests,
/// and the cavity is fitted to it.
constexpr int kFollowing = 3;
constexpr double kBoundSlope = 1.0;
/// Correcting a missing wall by a little more needs fewer rounds; by twice as much each time that
/// the same vertex fails, for its offset may lead along the surface.
constexpr double kOverstep = 1.1;
constexpr int kMostDoublings = 6;
/// An offset beyond this share of its range is as good as the greatest; where the cavity is
/// narrower than so many walls there, it is a thread that the goal does without.
constexpr double kUnwanted = 0.75;
constexpr double kUnwantedWidth = 3.0;
constexpr double kLeastGain = 0.6;
/// Of what a cavity could gain over the solid; below, another start is not worth its time.
constexpr double kFarGap = 0.05;
/// How far the cavity retreats from a cap that folds, in walls.
constexpr double kRetreat = 0.25;

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

/// Marks the vertices that paths of this length reach from v.
void markWithin(const CavityTask& task, const VertexAdjacency& neighbours, int v, double length,
                std::vector<char>& solid) {
  std::vector<int> stack{v};
  const auto isNear = [&](int w) {
    return (movingVertices(task).row(w) - movingVertices(task).row(v)).squaredNorm() <
           length * length;
  };
  while (!stack.empty()) {
    const int u = stack.back();
    stack.pop_back();
    if (solid[static_cast<std::size_t>(u)] != 0) continue;
    solid[static_cast<std::size_t>(u)] = 1;
    for (const int w : neighbours[static_cast<std::size_t>(u)]) {
      if (isNear(w)) stack.push_back(w);
    }
  }
}

/// Of what the cavity keeps the wall from, to one of its vertices that is too near.
Vec3 nearestPoint(const CavityTask& task, const CavityResult& result, int v) {
  const Vec3 y = result.inner.row(v).transpose();
  const int face = result.inspection.nearestFace[static_cast<std::size_t>(v)];
  const auto corners = task.surface.faces().row(face);
  const Vec3 a = result.outer.row(corners[0]).transpose();
  const Vec3 b = result.outer.row(corners[1]).transpose();
  const Vec3 c = result.outer.row(corners[2]).transpose();
  const Vec3 weights = nearestWeights(y, a, b, c);
  const Vec3 onFace = weights[0] * a + weights[1] * b + weights[2] * c;
  return task.surface.clearance(y, {(y - onFace).squaredNorm(), face, onFace}).point;
}

/// Moves the bounds so that what the inspection found cannot happen again in the same way.
/// `thinRounds`: how often each vertex had too thin a wall.
void tighten(const CavityTask& task, const CavityResult& result, const VertexAdjacency& neighbours,
             OffsetBounds& bounds, std::vector<char>& solid, std::vector<int>& thinRounds,
             bool patient) {
  const auto mark = [&](int v) {
    solid[static_cast<std::size_t>(v)] = 1;
    for (const int w : neighbours[static_cast<std::size_t>(v)]) {
      solid[static_cast<std::size_t>(w)] = 1;
    }
  };
  if (!patient) {
    for (const int v : result.inspection.crossing) mark(v);
    for (const int v : result.inspection.thin) mark(v);
    return;
  }
  for (const int v : result.inspection.crossing) {
    bounds.upper[v] = std::min(bounds.upper[v], kShrink * result.innerOffsets[v]);
  }
  for (const int v : result.inspection.crossing) {
    const IndexRange around = neighbours[static_cast<std::size_t>(v)];
    const bool atCap = std::any_of(around.begin(), around.end(), [&](int w) {
      return result.cavity.solid[static_cast<std::size_t>(w)] != 0;
    });
    // Where a cap folds the cavity ends a little earlier, by as much on fine meshes as on coarse
    // ones.
    if (atCap) markWithin(task, neighbours, v, kRetreat * task.wall, solid);
  }
  for (const int v : result.inspection.thin) {
    // Does going deeper lead away from the nearest point?
    const Vec3 y = result.inner.row(v).transpose();
    const Vec3 away = (y - nearestPoint(task, result, v)).normalized();
    const double missing = kBeyondWall * task.wall - result.inspection.wall[v];
    const double gain = -away.dot(task.model.field.directions.row(v).transpose());
    int& failures = thinRounds[static_cast<std::size_t>(v)];
    const double step = std::ldexp(kOverstep * missing / std::max(std::abs(gain), kLeastGain),
                                   std::min(failures++, kMostDoublings));
    if (gain > 0.0) {
      bounds.lower[v] = std::max(bounds.lower[v], result.innerOffsets[v] + step);
    } else {
      bounds.upper[v] = std::min(bounds.upper[v], result.innerOffsets[v] - step);
    }
  }
  bounds.lower = lipschitzAbove(movingVertices(task), neighbours, bounds.lower, kBoundSlope);
  bounds.upper = lipschitzBelow(movingVertices(task), neighbours, bounds.upper, kBoundSlope);
}

/// Holds the outer surface back where it folds; without patience it stays where it was.
void calmOuter(const CavityTask& task, const CavityResult& result,
               const VertexAdjacency& neighbours, bool patient, OffsetBounds& bounds) {
  for (const int v : result.inspection.outerCrossing) {
    bounds.upper[v] = std::min(bounds.upper[v], patient ? kShrink * result.outerOffsets[v] : 0.0);
  }
  bounds.upper = lipschitzBelow(movingVertices(task), neighbours, bounds.upper, kBoundSlope);
  bounds.lower = bounds.lower.cwiseMin(bounds.upper);
}

/// Marks vertices where the cavity is narrower than the wall: such a channel serves no goal, cannot
/// be printed, and is where the surface folds first. `fillUnwanted`: a wider one, too, that the
/// optimisation would rather close, its offsets being near the greatest. Returns how many there
/// were.
/// `faces`: of the cavity, without an open surface's strips and lids.
Eigen::Index fillNarrowParts(const CavityTask& task, const OffsetSurfaces& surfaces,
                             const OffsetBounds& bounds, const Faces& faces, bool fillUnwanted,
                             std::vector<char>& solid) {
  const Points& inner = surfaces.inner;
  if (faces.rows() == 0) return 0;
  const TriangleTree tree(inner, faces, TriangleTree::Order::Any,
                          TriangleTree::Queries::NoDistances);
  constexpr Eigen::Index kChunk = 1024;
  std::atomic<Eigen::Index> filled = 0;
  forChunks(inner.rows(), kChunk, [&](const Chunk& chunk) {
    for (Eigen::Index v = chunk.begin; v < chunk.end; ++v) {
      char& mark = solid[static_cast<std::size_t>(v)];
      if (mark != 0) continue;
      const double share =
          (surfaces.innerOffsets[v] - bounds.lower[v]) / (bounds.upper[v] - bounds.lower[v]);
      const bool isUnwanted = fillUnwanted && share > kUnwanted;
      const double width = (isUnwanted ? kUnwantedWidth : 1.0) * task.wall;
      const Vec3 inwards = -task.model.field.directions.row(v).transpose();
      if (tree.firstHit(inner.row(v).transpose(), inwards, width) >= width) continue;
      mark = 1;
      ++filled;
    }
  });
  return filled;
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

/// Coefficients whose surface comes near to the bound's cavity.
Vector towardsBound(const CavityTask& task, const OffsetModel& model, const Vector& outerStart) {
  const Vector offsets =
      offsetsTowards(*task.bound, movingVertices(task), task.model.field.directions,
                     model.inner.lower, model.inner.upper);
  return coefficientsFor(model, boundMapInverse(model.inner, offsets), outerStart);
}

/// Whether a second start may pay: the goal is missed, or a good part of what is possible.
bool isFarFromBound(const CavityTask& task, const MinimizeResult& best) {
  if (!task.bound) return false;
  const std::vector<Moments> states(task.model.fillings.size(), task.model.solidMoments);
  const double solid = momentObjective(task.goal, task.weights, states, 1.0);
  if (best.violation > std::max(kFeasibility, task.bound->violation)) return true;
  // The bound knows nothing of smoothness.
  return task.weights.smoothness == 0.0 &&
         best.objective - task.bound->objective > kFarGap * (solid - task.bound->objective);
}

bool isBetter(const MinimizeResult& a, const MinimizeResult& b) {
  if (std::max(a.violation, b.violation) > kFeasibility) return a.violation < b.violation;
  return a.objective < b.objective;
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

Inspection inspectResult(const CavityTask& task, const CavityResult& result, LookFirst first,
                         ClearanceQuery& clearance) {
  const Faces& cavity = result.cavity.faces;
  if (task.open != nullptr)
    return inspectShell(result.inner, cavity, task.surface, task.wall, task.stored);
  if (task.model.outer) {
    const TriangleTree moved(result.outer, task.surface.faces(), TriangleTree::Order::Spatial);
    return inspect(result.inner, cavity, moved, task.wall, true, first, nullptr, task.stored);
  }
  return inspect(result.inner, cavity, task.surface, task.wall, false, first, &clearance,
                 task.stored);
}

/// One search from the middle of the bounds to a cavity that passes inspection, in rounds.
class CavitySearch {
public:
  /// `freedom`: how much of the range between least and greatest offset may be used, 0…1; at 0
  /// there is nothing to optimise, and the cavity is as large as the wall allows.
  CavitySearch(const CavityTask& task, double freedom, const std::function<void(double)>& progress);

  CavityResult run();
  double deepestVolume();

private:
  /// How a round goes on.
  enum class Next { Inspect, AnotherRound, GiveUp };

  void closeIn();
  void followOuterSurface(int round);
  Next findOffsets(int round);
  bool closeCavity();
  void optimize(int round);
  MinimizeResult minimizeFrom(const Vector& start, int round) const;
  bool fillNarrow(int round);
  void placeAndInspect();
  bool isAnswer(int round);

  const CavityTask& task_;
  const double freedom_;
  const std::function<void(double)>& progress_;
  const VertexAdjacency neighbours_;
  const Faces& cavityFaces_; ///< when nothing is solid
  const VertexCorners corners_;
  OffsetModel model_;
  OffsetBounds bounds_; ///< as the rounds close them in; past each other where there is no room
  std::vector<char> solid_;
  std::vector<int> thinRounds_; ///< how often each vertex had too thin a wall
  Vector outerStart_;
  Vector coefficients_;
  OffsetSurfaces surfaces_; ///< that the coefficients stand for
  MinimizeOptions solver_;
  std::unique_ptr<Goal> movedGoal_;
  const Goal* goal_;

  bool fillUnwanted_;
  bool mayTrim_ = true;
  LookFirst first_ = LookFirst::ForAll;
  std::shared_ptr<ClearanceQuery> clearance_;
  CavityResult result_;
};

CavitySearch::CavitySearch(const CavityTask& task, double freedom,
                           const std::function<void(double)>& progress)
    : task_(task), freedom_(freedom), progress_(progress),
      neighbours_(vertexAdjacency(movingVertices(task).rows(), movingFaces(task))),
      cavityFaces_(task.open != nullptr ? task.open->cavity : movingFaces(task)),
      corners_(vertexCorners(positionCount(task), cavityFaces_)), model_(task.model),
      bounds_(task.model.inner), solid_(tooThin(task.model.field, bounds_)),
      thinRounds_(solid_.size(), 0), goal_(&task.goal), fillUnwanted_(freedom > 0.0),
      clearance_(std::make_shared<ClearanceQuery>(task.surface)) {
  solid_.resize(static_cast<std::size_t>(positionCount(task)), 0);
  bounds_.lower = lipschitzAbove(movingVertices(task), neighbours_,
                                 bounds_.lower.cwiseMin(bounds_.upper), kBoundSlope);
  if (model_.outer) {
    outerStart_ = model_.outer->lower + kOuterStart * (model_.outer->upper - model_.outer->lower);
  }
  const Vector middle = 0.5 * (bounds_.lower + bounds_.upper);
  coefficients_ = coefficientsFor(model_, middle, outerStart_);
  result_.outer = task.surface.vertices();
}

double CavitySearch::deepestVolume() {
  closeIn();
  const Points deepest =
      movingVertices(task_) - bounds_.lower.asDiagonal() * task_.model.field.directions;
  return signedVolume(deepest, cavitySurface(deepest, cavityFaces_, corners_, solid_).faces);
}

CavityResult CavitySearch::run() {
  for (int round = 0; round < kMostRounds; ++round) {
    result_.effort.rounds = round + 1;
    closeIn();
    followOuterSurface(round);

    const Stopwatch optimization;
    const Next next = findOffsets(round);
    result_.effort.secondsOptimization += optimization.seconds();
    if (next == Next::GiveUp) return std::move(result_);
    if (next == Next::AnotherRound) continue;

    const Stopwatch inspection;
    placeAndInspect();
    result_.effort.secondsInspection += inspection.seconds();
    if (progress_) progress_(1.0 - 1.0 / (2.0 + round));
    if (result_.inspection.isClean()) {
      if (isAnswer(round)) return std::move(result_);
      continue;
    }
    const bool isPatient = round < kPatience;
    tighten(task_, result_, neighbours_, bounds_, solid_, thinRounds_, isPatient);
    if (model_.outer) calmOuter(task_, result_, neighbours_, isPatient, *model_.outer);
  }
  result_.stopReason = "no cavity passes inspection";
  return std::move(result_);
}

/// The bounds of this round, and what has no room between them.
void CavitySearch::closeIn() {
  addMarks(solid_, tooThin(task_.model.field, bounds_));
  model_.inner = bounds_;
  keepOrdered(model_.inner);
  model_.inner.upper = model_.inner.lower + freedom_ * (model_.inner.upper - model_.inner.lower);
}

void CavitySearch::followOuterSurface(int round) {
  if (!task_.goalFor) return;
  const OffsetSurfaces present = offsetSurfaces(model_, coefficients_);
  if (round == kFollowing) model_.outer->lower = model_.outer->upper = present.outerOffsets;
  movedGoal_ = task_.goalFor(task_.deliverable(present.outer));
  goal_ = movedGoal_.get();
}

CavitySearch::Next CavitySearch::findOffsets(int round) {
  if (!closeCavity()) {
    result_.stopReason = "no room for a cavity at an opening";
    return Next::GiveUp;
  }
  optimize(round);
  surfaces_ = offsetSurfaces(model_, coefficients_);
  if (fillNarrow(round)) return Next::AnotherRound;
  fillUnwanted_ = false;
  return Next::Inspect;
}

/// Closes the cavity where it ends. False where an opening would be closed by material.
bool CavitySearch::closeCavity() {
  // The caps of a cavity that did not fold will do where it ends as it did.
  if (solid_ != result_.cavity.solid || !result_.inspection.crossing.empty()) {
    result_.cavity =
        cavitySurface(cavityPositions(task_, offsetSurfaces(model_, coefficients_).inner),
                      cavityFaces_, corners_, solid_);
    solid_ = result_.cavity.solid;
  }
  model_.innerFaces = result_.cavity.faces;
  return !closesOpening(task_, solid_);
}

void CavitySearch::optimize(int round) {
  if (freedom_ == 0.0) {
    result_.stopReason = "least offsets";
    return;
  }
  MinimizeResult best = minimizeFrom(coefficients_, round);
  if (round == 0 && isFarFromBound(task_, best)) {
    MinimizeResult other = minimizeFrom(towardsBound(task_, model_, outerStart_), round);
    result_.effort.evaluations += other.evaluations;
    if (isBetter(other, best)) std::swap(best, other);
  }
  solver_.objectiveScale = best.objectiveScale;
  coefficients_ = best.x;
  result_.effort.evaluations += best.evaluations;
  result_.stopReason = best.stopReason;
}

MinimizeResult CavitySearch::minimizeFrom(const Vector& start, int round) const {
  // Later rounds start near their minima.
  const bool startsCoarse = round == 0 && !task_.model.surface->interpolation.isIdentity() &&
                            !task_.model.outer && task_.open == nullptr &&
                            task_.weights.smoothness == 0.0;
  if (startsCoarse) return minimizeCoarseToFine(model_, *goal_, task_.weights, start, solver_);
  return minimize([&](const Vector& x) { return evaluate(model_, *goal_, task_.weights, x); },
                  start, solver_);
}

/// Whether parts became solid that call for another round.
bool CavitySearch::fillNarrow(int round) {
  if (round >= kTrims || !mayTrim_) return false;
  const Eigen::Index vertices = result_.cavity.faces.rows() / 2;
  const Eigen::Index filled =
      fillNarrowParts(task_, surfaces_, model_.inner, offsetFaces(task_, result_.cavity.faces),
                      fillUnwanted_, solid_);
  mayTrim_ = static_cast<double>(filled) > kWorthTrimming * static_cast<double>(vertices);
  return filled > 0;
}

void CavitySearch::placeAndInspect() {
  result_.inner = cavityPositions(task_, task_.deliverable(surfaces_.inner));
  if (model_.outer) result_.outer = task_.deliverable(surfaces_.outer);
  result_.innerOffsets = std::move(surfaces_.innerOffsets);
  result_.outerOffsets = std::move(surfaces_.outerOffsets);
  result_.inspection = inspectResult(task_, result_, first_, *clearance_);
  // What was all that was wrong mostly is all that is wrong next time.
  const bool isWithoutFolds =
      result_.inspection.crossing.empty() && result_.inspection.outerCrossing.empty();
  first_ = isWithoutFolds                    ? LookFirst::ForThinWalls
           : result_.inspection.thin.empty() ? LookFirst::ForFolds
                                             : LookFirst::ForAll;
}

/// Whether clean surfaces end the search; their status is set.
bool CavitySearch::isAnswer(int round) {
  if (task_.goalFor && round < kFollowing) return false;
  // A moved outer surface may serve the goal alone.
  const bool hasCavity = result_.inspection.components > 0;
  if (hasCavity || mayMoveOuterAlone(task_)) result_.status = CavityStatus::Found;
  if (!model_.outer && task_.open == nullptr) result_.clearance = std::move(clearance_);
  return true;
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

CavityResult searchCavity(const CavityTask& task, const std::function<void(double)>& progress) {
  // In thin sheets whose triangles are large, what the optimisation bends may fold everywhere.
  CavityResult all;
  std::optional<CavityResult> outerAlone;
  double done = 0.0;
  const std::function<void(double)> reportShare = [&](double share) {
    done = std::max(done, share);
    if (progress) progress(done);
  };
  for (const double freedom : {1.0, 0.3, 0.0}) {
    CavityResult result = CavitySearch(task, freedom, reportShare).run();
    const bool hopeless = result.effort.rounds == 1;
    result.effort += all.effort;
    all = std::move(result);
    const bool found = all.status == CavityStatus::Found;
    if ((found && all.inspection.components > 0) || hopeless) return all;
    if (found && !outerAlone) outerAlone = all;
  }
  if (!outerAlone) return all;
  outerAlone->effort = all.effort;
  return *outerAlone;
}

double greatestVolume(const CavityTask& task) {
  constexpr double kMore = 1.25;
  const std::function<void(double)> silent;
  return kMore * CavitySearch(task, 0.0, silent).deepestVolume();
}

bool leavesRoom(const CavityTask& task) {
  constexpr double kLeastShare = 0.003;
  const std::function<void(double)> silent;
  const CavityResult result = CavitySearch(task, 0.0, silent).run();
  if (result.status != CavityStatus::Found) return false;
  if (task.open != nullptr) return true;
  // Of a crumb that is left here nothing may be left at a slightly thinner wall.
  return signedVolume(result.inner, result.cavity.faces) >
         kLeastShare * signedVolume(movingVertices(task), movingFaces(task));
}

} // namespace massprops
