// What a search takes from its task, and what it says of the result.
#include "core/reduced/cavity_search.h"

#include "core/goals/registry.h"
#include "core/model/posed_model.h"
#include "core/reduced/harmonics.h"
#include "core/reduced/hollow_body.h"
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

  CavityTask task() const {
    CavityTask result{*surface, *goal, {}, options.weights};
    result.model.surface = moving;
    result.model.field = offsetField(posed.vertices, posed.faces, axis);
    result.model.solidMoments = solid;
    result.model.inner = keepingWall(posed.vertices, *surface, result.model.field,
                                     innerBounds(result.model.field, posed.wall, 0.9), posed.wall);
    result.inputMoments = solid;
    result.wall = posed.wall;
    result.deliverable = [](const Points& points) { return points; };
    return result;
  }
};

TEST(CavitySearch, SaysWhereTheSolidBodyServesTheGoalAtLeastAsWell) {
  const Lump lump;
  CavityTask task = lump.task();
  const CavityResult found = searchCavity(task, {});
  ASSERT_EQ(found.status, CavityStatus::Found);
  EXPECT_LT(hollowBody(task, found).volume, 0.9 * task.inputMoments[0]);
  // An input that weighs next to nothing.
  task.inputMoments *= 1e-3;
  EXPECT_EQ(searchCavity(task, {}).status, CavityStatus::NoGain);
}

TEST(CavitySearch, TakesTheLevelsOfContentsThatTheBoundRestsOn) {
  const Lump lump;
  CavityTask task = lump.task();
  task.model.fillings = {{}, {0.5}};
  task.bound.emplace();
  task.bound->binding = {{}, {0.5}, {0.5, 0.1}};
  searchCavity(task, {});
  ASSERT_EQ(task.model.fillings.size(), 3U);
  EXPECT_EQ(task.model.fillings.back().level, 0.1);
}

} // namespace
} // namespace massprops::testing
