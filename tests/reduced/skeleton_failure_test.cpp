// Where the mean curvature flow fails, its bound stops it and the filter goes on without it.
#include "core/goals/spin.h"
#include "core/model/posed_model.h"
#include "core/pipeline.h"
#include "core/reduced/arena_allocator.h"
#include "core/reduced/cavity_search.h"
#include "core/reduced/skeleton.h"
#include "judge/checks.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <new>
#include <stdexcept>

namespace massprops::testing {
namespace {

/// So little memory that the flow ends at its bound; a megabyte is always there.
constexpr std::size_t kHardlyAny = 1;

TEST(SkeletonFailure, EndsHalfWayThroughTheBody) {
  const TriangleMesh mesh = scaled(sphere(20), 0.25); // 4002 vertices
  const Skeleton skeleton = meanCurvatureSkeleton(mesh.vertices, mesh.faces, kHardlyAny);
  EXPECT_EQ(skeleton.failedComponents, 1);
  ASSERT_EQ(skeleton.points.rows(), mesh.vertices.rows());
  // Half of the chord along a normal of a sphere ends in its centre; vertex normals are not exact.
  EXPECT_LT(skeleton.points.rowwise().norm().maxCoeff(), 0.01);
}

TEST(SkeletonFailure, ConcernsOneComponentOnly) {
  const TriangleMesh large = scaled(sphere(20), 0.25);
  const TriangleMesh small =
      transformed(sphere(4), 0.1 * Mat3::Identity(), {0.5, 0, 0}); // needs less than a megabyte
  const TriangleMesh both = joined(large, small);
  const Skeleton skeleton = meanCurvatureSkeleton(both.vertices, both.faces, kHardlyAny);
  EXPECT_EQ(skeleton.failedComponents, 1);
  EXPECT_TRUE(skeleton.points.allFinite());
  EXPECT_EQ(meanCurvatureSkeleton(both.vertices, both.faces).failedComponents, 0);
}

TEST(SkeletonFailure, IsNoLackOfTheSystemsMemory) {
  // More than any system has: half of all addresses.
  const TriangleMesh mesh = scaled(sphere(4), 0.25);
  const auto n = static_cast<std::size_t>(mesh.vertices.rows());
  const std::size_t tooMuch = std::numeric_limits<std::size_t>::max() / 2 / n;
  EXPECT_THROW(meanCurvatureSkeleton(mesh.vertices, mesh.faces, tooMuch), std::bad_alloc);
}

TEST(Arena, SaysWhetherItIsUsedUpOrWasNeverThere) {
  EXPECT_THROW(arenaAllocate(16), std::logic_error);
  const ArenaScope scope(0);
  std::size_t nodes = 0;
  const auto fill = [&] {
    for (;; ++nodes) arenaAllocate(4096);
  };
  EXPECT_THROW(fill(), ArenaUsedUp);
  EXPECT_EQ(nodes, 256U); // a megabyte is always there
}

TEST(SkeletonFailure, IsRepeatedBitForBit) {
  const TriangleMesh mesh = scaled(blob(20), 0.25);
  const Points first = meanCurvatureSkeleton(mesh.vertices, mesh.faces, kHardlyAny).points;
  EXPECT_EQ(meanCurvatureSkeleton(mesh.vertices, mesh.faces, kHardlyAny).points, first);
}

TEST(SkeletonFailure, EndsOnASheetOfAlmostNoThickness) {
  // Fuzzing found it: Voronoi poles of points that are all but in a plane are no numbers, and rays
  // from them were shot for ever.
  const TriangleMesh sheet =
      transformed(torus(1.0, 0.4, 10, 6), Vec3(1e-9, 1, 1).asDiagonal() * Mat3::Identity());
  Options options;
  options.goal = GoalKind::Spin;
  const PosedModel posed = makePosedModel(makeSolid(sheet), options);
  EXPECT_TRUE(meanCurvatureSkeleton(posed.vertices, posed.faces).points.allFinite());
}

TEST(SkeletonFailure, StillGivesACavityThatKeepsTheWall) {
  Options options;
  options.goal = GoalKind::Spin;
  const TriangleMesh model = leaningTop(0.1, 16); // 2562 vertices
  const PosedModel posed = makePosedModel(makeSolid(model), options);
  const Skeleton skeleton = meanCurvatureSkeleton(posed.vertices, posed.faces, kHardlyAny);
  const TriangleTree surface(posed.vertices, posed.faces);
  ASSERT_EQ(skeleton.failedComponents, 1);

  const SparseMatrix L = cotanLaplacian(posed.vertices, posed.faces);
  const Vector area = vertexLumpedMass(posed.vertices, posed.faces);
  const Vector mass = area / area.sum();
  const HarmonicBasis basis = harmonicBasis(posed.vertices, posed.faces, L, mass, 20);
  const OffsetField field =
      offsetField(posed.vertices, posed.faces, smoothedOverSurface(skeleton.points, L, area, 0.02));
  const Moments solid = moments(posed.vertices, posed.faces);
  const std::unique_ptr<Goal> goal = makeSpinGoal(solid, options.weights);
  CavityTask task{surface, *goal, {}, options.weights};
  task.model.surface =
      std::make_shared<MovingSurface>(MovingSurface{posed.vertices, posed.faces, mass, basis});
  task.model.field = field;
  task.model.solidMoments = solid;
  task.inputMoments = solid;
  task.wall = posed.wall;
  task.model.inner =
      keepingWall(posed.vertices, surface, field,
                  innerBounds(field, posed.wall, options.innerUpperBound), posed.wall);
  task.deliverable = [](const Points& points) { return points; };
  const CavityResult cavity = searchCavity(task, {});
  ASSERT_EQ(cavity.status, CavityStatus::Found);

  const TriangleMesh outer{posed.vertices, posed.faces};
  const TriangleMesh inner{cavity.inner, cavity.cavity.faces};
  EXPECT_EQ(intersectingPairs(inner), 0U);
  EXPECT_EQ(intersectingPairs(inner, outer), 0U);
  EXPECT_GE(leastDistance(inner, outer), posed.wall);
}

} // namespace
} // namespace massprops::testing
