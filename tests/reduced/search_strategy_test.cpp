// Which searches follow each other, and that none of their work is lost.
#include "core/reduced/search_strategy.h"

#include "core/goals/registry.h"
#include "core/model/posed_model.h"
#include "core/reduced/harmonics.h"
#include "core/reduced/skeleton.h"

#include "shapes.h"

#include <gtest/gtest.h>

#include <memory>

namespace massprops::testing {
namespace {

/// A lump that is to become as light as possible.
struct Lump {
  Options options;
  TriangleMesh mesh = blob(5);
  PosedModel posed;
  std::unique_ptr<TriangleTree> surface;
  std::unique_ptr<Goal> goal;
  std::shared_ptr<MovingSurface> moving = std::make_shared<MovingSurface>();
  Points axis;
  Moments solid;

  Lump() {
    options.goal = GoalKind::Mass;
    posed = makePosedModel(makeSolid(mesh), options);
    surface = std::make_unique<TriangleTree>(posed.vertices, posed.faces);
    goal = makeGoal(options, posed, posed.vertices);
    const SparseMatrix L = cotanLaplacian(posed.vertices, posed.faces);
    const Vector area = vertexLumpedMass(posed.vertices, posed.faces);
    moving->vertices = posed.vertices;
    moving->faces = posed.faces;
    moving->mass = area / area.sum();
    moving->basis = harmonicBasis(posed.vertices, posed.faces, L, moving->mass, 12);
    axis = smoothedOverSurface(meanCurvatureSkeleton(posed.vertices, posed.faces).points, L, area,
                               0.02);
    solid = moments(posed.vertices, posed.faces);
  }

  CavityTask task(double clearance) const {
    CavityTask result{*surface, *goal, {}, options.weights};
    result.model.surface = moving;
    result.model.field = offsetField(posed.vertices, posed.faces, axis, clearance);
    result.model.solidMoments = solid;
    result.model.inner = keepingWall(posed.vertices, *surface, result.model.field,
                                     innerBounds(result.model.field, posed.wall, 0.9), posed.wall);
    result.inputMoments = solid;
    result.wall = posed.wall;
    result.deliverable = [](const Points& points) { return points; };
    return result;
  }
};

/// Lighter than nothing: half of what is possible stays out of reach.
OptimalBound beyondReach() {
  OptimalBound bound;
  bound.objective = -1.0;
  return bound;
}

TEST(SearchStrategy, CountsTheWorkOfASearchThatIsThrownAway) {
  const Lump lump;
  CavityTask task = lump.task(kSlantedClearance);
  task.bound = beyondReach();
  // An input that weighs next to nothing: whatever cavity is found, the search without the bound
  // follows, and the solid stays better.
  task.inputMoments *= 1e-3;
  CavityTask plain = task;
  plain.bound.reset();
  const CavityResult first = searchCavity(task, {});
  const CavityResult second = searchCavity(plain, {});
  const CavityResult best =
      bestCavity(task, [&]() -> CavityTask { return lump.task(kSteepClearance); }, {});
  EXPECT_EQ(best.status, CavityStatus::NoGain);
  EXPECT_GE(best.effort.evaluations, first.effort.evaluations + second.effort.evaluations);
  EXPECT_GE(best.effort.rounds, first.effort.rounds + second.effort.rounds);
}

TEST(SearchStrategy, TriesSteeperDirectionsFarFromTheBoundAndCountsBoth) {
  const Lump lump;
  CavityTask task = lump.task(kSlantedClearance);
  task.bound = beyondReach();
  const auto steeper = [&] {
    CavityTask steep = lump.task(kSteepClearance);
    steep.bound = task.bound;
    return steep;
  };
  const CavityResult slanted = searchCavity(task, {});
  const CavityResult steep = searchCavity(steeper(), {});
  const CavityResult best = bestCavity(task, steeper, {});
  ASSERT_EQ(best.status, CavityStatus::Found);
  EXPECT_EQ(best.effort.evaluations, slanted.effort.evaluations + steep.effort.evaluations);
  EXPECT_EQ(best.effort.rounds, slanted.effort.rounds + steep.effort.rounds);
}

TEST(SearchStrategy, GoesOnWhileItLooksForALargerWall) {
  const Lump lump;
  CavityTask task = lump.task(kSlantedClearance);
  task.wall = 10.0 * lump.posed.wall;
  double last = 0.0;
  int calls = 0;
  const double wall = largestWall(
      task,
      [&](double w) {
        return keepingWall(lump.posed.vertices, *lump.surface, task.model.field,
                           innerBounds(task.model.field, w, 0.9), w);
      },
      [&](double share) {
        EXPECT_GT(share, last);
        EXPECT_LE(share, 1.0);
        last = share;
        ++calls;
      });
  EXPECT_GT(wall, 0.0);
  EXPECT_LT(wall, task.wall);
  EXPECT_GT(calls, 2);
}

} // namespace
} // namespace massprops::testing
