// Drain holes through the whole filter: what it promises of them, measured on the delivered
// triangles.
#include "core/drill/drainage.h"
#include "core/drill/pools.h"
#include "core/mesh/components.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/signed_volume.h"
#include "core/pipeline.h"
#include "core/query/self_intersection.h"

#include "samples.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace massprops::testing {
namespace {

double number(const Result& result, const std::string& key) {
  return std::get<double>(result.report.at(key));
}
bool truth(const Result& result, const std::string& key) {
  return std::get<bool>(result.report.at(key));
}
int integer(const Result& result, const std::string& key) {
  return std::get<int>(result.report.at(key));
}
std::string text(const Result& result, const std::string& key) {
  return std::get<std::string>(result.report.at(key));
}

Options floatsWithHoles(GoalKind goal, int holes) {
  Options options;
  options.goal = goal;
  options.drainHoles = holes;
  options.representable = [](const Points& p) { return Points(p.cast<float>().cast<double>()); };
  return options;
}

Eigen::Index eulerOf(const TriangleMesh& mesh) {
  return mesh.vertices.rows() - mesh.faces.rows() / 2;
}

void expectSound(const TriangleMesh& mesh) {
  const EdgeCounts edges = countEdges(mesh.vertices.rows(), mesh.faces);
  EXPECT_EQ(edges.boundary + edges.nonManifold + edges.incoherent, 0U);
  EXPECT_TRUE(selfIntersectingFaces(mesh.vertices, mesh.faces).empty());
}

double gramsOf(const TriangleMesh& mesh) {
  return 1.24 * signedVolume(mesh.vertices, mesh.faces) / 1000.0;
}

/// One body, and holes as handles, whose weights are those of the report.
void expectDrilled(const TriangleMesh& outer, const Result& result) {
  ASSERT_TRUE(result.drilled && result.plugs);
  const int holes = integer(result, "drain_holes");
  expectSound(*result.drilled);
  expectSound(*result.plugs);
  EXPECT_EQ(eulerOf(*result.drilled), eulerOf(outer) + eulerOf(result.inner) - 2 * holes);
  EXPECT_EQ(eulerOf(*result.plugs), 2 * holes);
  EXPECT_EQ(componentMeshes(result.drilled->vertices, result.drilled->faces).size(),
            componentMeshes(outer.vertices, outer.faces).size());
  const double open = gramsOf(*result.drilled);
  EXPECT_NEAR(number(result, "mass_open"), open, 1e-7 * open);
  EXPECT_NEAR(number(result, "mass_after"), open + gramsOf(*result.plugs), 1e-7 * open);
}

TEST(PipelineDraining, KeepsEveryGoalOfTheSamplesWithPlugsAndWithout) {
  const std::vector<std::pair<std::string, GoalKind>> samples{
      {"tilted_ellipsoid_top", GoalKind::Spin},
      {"uneven_yo_yo", GoalKind::YoYo},
      {"bath_duck", GoalKind::Float},
      {"hanging_fish", GoalKind::Hang}};
  for (const auto& [name, goal] : samples) {
    SCOPED_TRACE(name);
    const TriangleMesh model = sampleMesh(name);
    const Result result = optimizeMassProperties(model, floatsWithHoles(goal, 2));
    EXPECT_TRUE(truth(result, "solved")) << text(result, "message");
    EXPECT_LE(number(result, "max_constraint_violation"), 1e-6);
    EXPECT_GE(integer(result, "drain_holes"), 2);
    // The keel of the duck's cavity is too narrow for a drill.
    EXPECT_LT(number(result, "trapped_volume"),
              -0.01 * signedVolume(result.inner.vertices, result.inner.faces));
    expectDrilled(model, result);
  }
}

TEST(PipelineDraining, OpensOffTheGroundAndSaysWhatStays) {
  const TriangleMesh model = sampleMesh("toy_dinosaur");
  Options options = floatsWithHoles(GoalKind::Stand, 2);
  options.innerLowerBound = 1.5;
  const Result result = optimizeMassProperties(model, options);
  EXPECT_TRUE(truth(result, "solved"));
  expectDrilled(model, result);
  const double ground = model.vertices.col(2).minCoeff();
  // Holes are where the body is not the model's: its new vertices lie above the ground.
  const TriangleMesh& body = *result.drilled;
  const TriangleTree surface(model.vertices, model.faces);
  for (Eigen::Index v = 0; v < body.vertices.rows(); ++v) {
    const Vec3 p = body.vertices.row(v).transpose();
    if (p.z() > ground + 1e-2) continue;
    EXPECT_EQ((model.vertices.rowwise() - p.transpose()).rowwise().squaredNorm().minCoeff(), 0.0);
  }
  EXPECT_GE(number(result, "trapped_volume"), number(result, "largest_pool"));
  EXPECT_TRUE(truth(result, "stands_open"));
}

TEST(PipelineDraining, IsTheSameEveryTime) {
  const TriangleMesh model = sampleMesh("tilted_ellipsoid_top");
  const Options options = floatsWithHoles(GoalKind::Spin, 1);
  const Result once = optimizeMassProperties(model, options);
  const Result again = optimizeMassProperties(model, options);
  ASSERT_TRUE(once.drilled && again.drilled);
  EXPECT_EQ(once.drilled->vertices, again.drilled->vertices);
  EXPECT_EQ(once.drilled->faces, again.drilled->faces);
  EXPECT_EQ(once.plugs->vertices, again.plugs->vertices);
  EXPECT_EQ(once.inner.vertices, again.inner.vertices);
}

TEST(PipelineDraining, WorksOnAnOuterSurfaceThatMoves) {
  const TriangleMesh model = scaled(blob(12), 30);
  Options options = floatsWithHoles(GoalKind::Mass, 1);
  options.outerUpperBound = 1.0;
  const Result result = optimizeMassProperties(model, options);
  ASSERT_TRUE(result.outer);
  expectDrilled(*result.outer, result);
}

TEST(PipelineDraining, FillsWhatIsTooSmallForAHole) {
  // Two balls: a large one, and one whose cavity is narrower than the drill.
  const TriangleMesh model =
      joined(scaled(sphere(16), 20), shifted(scaled(sphere(8), 4), {0, 30, 0}));
  Options options = floatsWithHoles(GoalKind::Mass, 1);
  options.innerLowerBound = 1.5;
  options.drainDiameter = 5.5;
  options.cavityShape = CavityShape::BestPossible;
  const Result result = optimizeMassProperties(model, options);
  EXPECT_EQ(integer(result, "cavity_components"), 1);
  EXPECT_EQ(integer(result, "filled_cavities"), 1);
  expectDrilled(model, result);
}

TEST(PipelineDraining, SaysSoWhereThereIsNoPlaceForADrill) {
  const TriangleMesh model = scaled(sphere(16), 5);
  Options options = floatsWithHoles(GoalKind::Mass, 1);
  options.innerLowerBound = 1.5;
  options.drainDiameter = 8.0;
  options.cavityShape = CavityShape::BestPossible;
  const Result result = optimizeMassProperties(model, options);
  EXPECT_FALSE(truth(result, "solved"));
  EXPECT_FALSE(result.drilled.has_value());
  EXPECT_GT(result.inner.faces.rows(), 0);
  EXPECT_NE(text(result, "message").find("drain_diameter"), std::string::npos);
}

TEST(PipelineDraining, RefusesWhatDoesNotGoTogether) {
  const TriangleMesh model = scaled(sphere(8), 20);
  Options filled = floatsWithHoles(GoalKind::Mass, 1);
  filled.fillDensity = 1.0;
  EXPECT_THROW(optimizeMassProperties(model, filled), InvalidInput);
  TriangleMesh cup = model;
  cup.faces.conservativeResize(cup.faces.rows() - 40, 3);
  Options open = floatsWithHoles(GoalKind::Mass, 1);
  open.openSurface = true;
  EXPECT_THROW(optimizeMassProperties(cup, open), InvalidInput);
}

} // namespace
} // namespace massprops::testing
