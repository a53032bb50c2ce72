#include "core/reduced/cavity_search.h"

#include "core/base/parallel.h"
#include "core/base/stopwatch.h"
#include "core/base/triangle.h"
#include "core/mesh/lipschitz.h"
#include "core/mesh/vertex_adjacency.h"
#include "core/query/triangle_tree.h"
#include "core/reduced/coarse_to_fine.h"

#include <algorithm>
#include <atomic>
#include <cmath>

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
constexpr double kFeasibility = 1e-6;
/// Of what a cavity could gain over the solid; below, another start is not worth its time.
constexpr double kFarGap = 0.05;
/// How far the cavity retreats from a cap that folds, in walls.
constexpr double kRetreat = 0.25;

/// Marks the vertices that paths of this length reach from v.
void markWithin(const CavityTask& task, const VertexAdjacency& neighbours, int v, double length,
                std::vector<char>& solid) {
  std::vector<int> stack{v};
  const auto isNear = [&](int w) {
    return (task.vertices.row(w) - task.vertices.row(v)).squaredNorm() < length * length;
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
    // Does going deeper lead away from the nearest point of the outer surface?
    const Vec3 y = result.inner.row(v).transpose();
    const auto nearest =
        task.surface.faces().row(result.inspection.nearestFace[static_cast<std::size_t>(v)]);
    const Vec3 a = result.outer.row(nearest[0]).transpose();
    const Vec3 b = result.outer.row(nearest[1]).transpose();
    const Vec3 c = result.outer.row(nearest[2]).transpose();
    const Vec3 weights = nearestWeights(y, a, b, c);
    const Vec3 away = (y - (weights[0] * a + weights[1] * b + weights[2] * c)).normalized();
    const double missing = kBeyondWall * task.wall - result.inspection.wall[v];
    const double gain = -away.dot(task.field.directions.row(v).transpose());
    int& failures = thinRounds[static_cast<std::size_t>(v)];
    const double step = std::ldexp(kOverstep * missing / std::max(std::abs(gain), kLeastGain),
                                   std::min(failures++, kMostDoublings));
    if (gain > 0.0) {
      bounds.lower[v] = std::max(bounds.lower[v], result.innerOffsets[v] + step);
    } else {
      bounds.upper[v] = std::min(bounds.upper[v], result.innerOffsets[v] - step);
    }
  }
  bounds.lower = lipschitzAbove(task.vertices, neighbours, bounds.lower, kBoundSlope);
  bounds.upper = lipschitzBelow(task.vertices, neighbours, bounds.upper, kBoundSlope);
}

/// Holds the outer surface back where it folds; without patience it stays where it was.
void calmOuter(const CavityTask& task, const CavityResult& result,
               const VertexAdjacency& neighbours, bool patient, OffsetBounds& bounds) {
  for (const int v : result.inspection.outerCrossing) {
    bounds.upper[v] = std::min(bounds.upper[v], patient ? kShrink * result.outerOffsets[v] : 0.0);
  }
  bounds.upper = lipschitzBelow(task.vertices, neighbours, bounds.upper, kBoundSlope);
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
      const Vec3 inwards = -task.field.directions.row(v).transpose();
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
  return task.outer.has_value() && task.inputMoments == task.solidMoments;
}

/// Coefficients whose surface comes near to the limit's cavity.
Vector towardsLimit(const CavityTask& task, const OffsetModel& model, const Vector& outerStart) {
  const Vector offsets = offsetsTowards(*task.limit, task.vertices, task.field.directions,
                                        model.inner.lower, model.inner.upper);
  return coefficientsFor(model, boundMapInverse(model.inner, offsets), outerStart);
}

/// Whether a second start may pay: the goal is missed, or a good part of what is possible.
bool isFarFromLimit(const CavityTask& task, const MinimizeResult& best) {
  if (!task.limit) return false;
  const double solid = momentObjective(task.goal, task.weights, task.solidMoments, 1.0);
  return best.violation > std::max(kFeasibility, task.limit->violation) ||
         best.objective - task.limit->objective > kFarGap * (solid - task.limit->objective);
}

bool isBetter(const MinimizeResult& a, const MinimizeResult& b) {
  if (std::max(a.violation, b.violation) > kFeasibility) return a.violation < b.violation;
  return a.objective < b.objective;
}

/// The positions that a cavity's faces refer to.
Points cavityPositions(const CavityTask& task, const Points& inner) {
  return task.open != nullptr ? stacked(inner, task.vertices) : inner;
}

Faces offsetFaces(const CavityTask& task, const Faces& cavity) {
  return task.open != nullptr ? withoutStrips(cavity, task.vertices.rows()) : cavity;
}

/// Whether an opening of the surface would be closed by material.
bool closesOpening(const CavityTask& task, const std::vector<char>& solid) {
  return task.open != nullptr &&
         std::any_of(task.open->rim.begin(), task.open->rim.end(),
                     [&](int v) { return solid[static_cast<std::size_t>(v)] != 0; });
}

Inspection inspectResult(const CavityTask& task, const CavityResult& result, LookFirst first,
                         ClearanceMemory& memory) {
  const Faces& cavity = result.cavity.faces;
  if (task.open != nullptr) return inspectShell(result.inner, cavity, task.surface, task.wall);
  if (task.outer) {
    const TriangleTree moved(result.outer, task.surface.faces(), TriangleTree::Order::Spatial);
    return inspect(result.inner, cavity, moved, task.wall, true, first);
  }
  return inspect(result.inner, cavity, task.surface, task.wall, false, first, &memory);
}

/// `freedom`: how much of the range between least and greatest offset may be used, 0…1; at 0 there
/// is nothing to optimise, and the cavity is as large as the wall allows.
CavityResult searchWithin(const CavityTask& task, double freedom,
                          const std::function<void(double)>& progress) {
  const VertexAdjacency neighbours = vertexAdjacency(task.vertices.rows(), task.faces);
  OffsetBounds bounds = task.inner;
  std::vector<char> solid = tooThin(task.field, bounds);
  if (task.open != nullptr) solid.resize(2 * solid.size(), 0);
  const Faces& cavityFaces = task.open != nullptr ? task.open->cavity : task.faces;
  bounds.lower =
      lipschitzAbove(task.vertices, neighbours, bounds.lower.cwiseMin(bounds.upper), kBoundSlope);

  OffsetModel model{
      task.vertices, task.faces, task.field.directions, task.basis,       task.L, task.mass, bounds,
      task.outer,    {},         task.fillDensity,      task.solidMoments};
  model.interpolation = task.interpolation;
  model.isOpen = task.open != nullptr;
  const VertexCorners corners = vertexCorners(static_cast<Eigen::Index>(solid.size()), cavityFaces);
  const Vector middle = 0.5 * (bounds.lower + bounds.upper);
  const Vector outerStart =
      task.outer ? Vector(task.outer->lower + kOuterStart * (task.outer->upper - task.outer->lower))
                 : Vector();
  Vector coefficients = coefficientsFor(model, middle, outerStart);
  std::vector<int> thinRounds(static_cast<std::size_t>(task.vertices.rows()), 0);

  // Later rounds start near their minima.
  const bool mayStartCoarse = task.proxy != nullptr && !task.outer && task.open == nullptr &&
                              task.weights.smoothness == 0.0;
  MinimizeOptions solver;
  CavityResult result;
  result.outer = task.surface.vertices();
  struct Attempt {
    MinimizeResult best;
    std::vector<char> solid;
  };
  std::optional<Attempt> withUnwanted;
  bool fillUnwanted = freedom > 0.0;
  bool mayTrim = true;
  LookFirst first = LookFirst::ForAll;
  ClearanceMemory memory;
  std::unique_ptr<Goal> movedGoal;
  const Goal* goal = &task.goal;
  for (int round = 0; round < kMostRounds; ++round) {
    result.rounds = round + 1;
    addMarks(solid, tooThin(task.field, bounds));
    model.inner = bounds;
    keepOrdered(model.inner);
    model.inner.upper = model.inner.lower + freedom * (model.inner.upper - model.inner.lower);

    if (task.goalFor) {
      const OffsetSurfaces present = offsetSurfaces(model, coefficients);
      if (round == kFollowing) model.outer->lower = model.outer->upper = present.outerOffsets;
      movedGoal = task.goalFor(task.deliverable(present.outer));
      goal = movedGoal.get();
    }

    const Stopwatch optimization;
    // The caps of a cavity that did not fold will do where it ends as it did.
    if (solid != result.cavity.solid || !result.inspection.crossing.empty()) {
      result.cavity =
          cavitySurface(cavityPositions(task, offsetSurfaces(model, coefficients).inner),
                        cavityFaces, corners, solid);
      solid = result.cavity.solid;
    }
    if (closesOpening(task, solid)) {
      result.stopReason = "no room for a cavity at an opening";
      return result;
    }
    model.innerFaces = result.cavity.faces;
    if (freedom > 0.0) {
      const auto minimized = [&](const Vector& start) {
        if (round == 0 && mayStartCoarse) {
          return minimizeCoarseToFine(model, *task.proxy, *goal, task.weights, start, solver);
        }
        return minimize([&](const Vector& x) { return evaluate(model, *goal, task.weights, x); },
                        start, solver);
      };
      MinimizeResult best = minimized(coefficients);
      if (round == 0 && isFarFromLimit(task, best)) {
        MinimizeResult other = minimized(towardsLimit(task, model, outerStart));
        result.evaluations += other.evaluations;
        if (isBetter(other, best)) std::swap(best, other);
      }
      solver.objectiveScale = best.objectiveScale;
      coefficients = best.x;
      result.evaluations += best.evaluations;
      result.stopReason = best.stopReason;
      if (withUnwanted && isBetter(withUnwanted->best, best)) {
        // The goal needs those parts.
        solid = std::move(withUnwanted->solid);
        coefficients = withUnwanted->best.x;
        withUnwanted.reset();
        fillUnwanted = false;
        result.secondsOptimization += optimization.seconds();
        continue;
      }
      if (fillUnwanted) withUnwanted = Attempt{std::move(best), solid};
    } else {
      result.stopReason = "least offsets";
    }
    OffsetSurfaces surfaces = offsetSurfaces(model, coefficients);
    if (round < kTrims && mayTrim) {
      const Eigen::Index vertices = result.cavity.faces.rows() / 2;
      const Eigen::Index filled = fillNarrowParts(
          task, surfaces, model.inner, offsetFaces(task, result.cavity.faces), fillUnwanted, solid);
      mayTrim = static_cast<double>(filled) > kWorthTrimming * static_cast<double>(vertices);
      if (filled > 0) {
        result.secondsOptimization += optimization.seconds();
        continue;
      }
    }
    withUnwanted.reset();
    fillUnwanted = false;
    result.secondsOptimization += optimization.seconds();

    const Stopwatch inspection;
    result.inner = cavityPositions(task, task.deliverable(surfaces.inner));
    if (task.outer) result.outer = task.deliverable(surfaces.outer);
    result.innerOffsets = std::move(surfaces.innerOffsets);
    result.outerOffsets = std::move(surfaces.outerOffsets);
    result.inspection = inspectResult(task, result, first, memory);
    // What was all that was wrong mostly is all that is wrong next time.
    const bool isWithoutFolds =
        result.inspection.crossing.empty() && result.inspection.outerCrossing.empty();
    first = isWithoutFolds                   ? LookFirst::ForThinWalls
            : result.inspection.thin.empty() ? LookFirst::ForFolds
                                             : LookFirst::ForAll;
    result.secondsInspection += inspection.seconds();
    if (progress) progress(1.0 - 1.0 / (2.0 + round));
    if (result.inspection.isClean()) {
      if (task.goalFor && round < kFollowing) continue;
      // A moved outer surface may serve the goal alone.
      const bool cavity = result.inspection.components > 0;
      if (cavity || mayMoveOuterAlone(task)) result.status = CavityStatus::Found;
      return result;
    }
    tighten(task, result, neighbours, bounds, solid, thinRounds, round < kPatience);
    if (model.outer) calmOuter(task, result, neighbours, round < kPatience, *model.outer);
  }
  result.stopReason = "no cavity passes inspection";
  return result;
}

} // namespace

Moments outerMoments(const CavityTask& task, const CavityResult& result) {
  return task.outer ? moments(result.outer, task.faces) : task.solidMoments;
}

void addEffort(const CavityResult& other, CavityResult& result) {
  result.rounds += other.rounds;
  result.evaluations += other.evaluations;
  result.secondsOptimization += other.secondsOptimization;
  result.secondsInspection += other.secondsInspection;
}

CavityResult searchCavity(const CavityTask& task, const std::function<void(double)>& progress) {
  // In thin sheets whose triangles are large, what the optimisation bends may fold everywhere.
  CavityResult all;
  std::optional<CavityResult> outerAlone;
  double done = 0.0;
  const auto tell = [&](double share) {
    done = std::max(done, share);
    if (progress) progress(done);
  };
  for (const double freedom : {1.0, 0.3, 0.0}) {
    CavityResult result = searchWithin(task, freedom, tell);
    const bool hopeless = result.rounds == 1;
    addEffort(all, result);
    all = std::move(result);
    const bool found = all.status == CavityStatus::Found;
    if ((found && all.inspection.components > 0) || hopeless) return all;
    if (found && !outerAlone) outerAlone = all;
  }
  return outerAlone ? *outerAlone : all;
}

bool leavesRoom(const CavityTask& task) {
  return searchWithin(task, 0.0, {}).status == CavityStatus::Found;
}

} // namespace massprops
