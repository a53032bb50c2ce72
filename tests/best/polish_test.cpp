// The cut moves until the triangles keep the goal's constraints.
#include "core/best/polish.h"

#include "core/base/triangle.h"
#include "core/contour/cavity_contour.h"
#include "core/pipeline.h"
#include "core/query/self_intersection.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <utility>

namespace massprops::testing {
namespace {

/// Mass and first moments that are wanted.
class WantedGoal final : public Goal {
public:
  explicit WantedGoal(Moments wanted) : wanted_(std::move(wanted)) {}

  GoalValue objective(const Moments& /*massMoments*/) const override { return {}; }
  GoalConstraints equalities(const Moments& massMoments) const override {
    GoalConstraints h{Vector(4), MomentGradients::Zero(4, 10)};
    h.values = (massMoments - wanted_).head<4>();
    h.gradients.leftCols<4>().setIdentity();
    return h;
  }
  GoalConstraints inequalities(const Moments& /*massMoments*/) const override {
    return {Vector(0), MomentGradients(0, 10)};
  }
  bool usesInertia() const override { return false; }

private:
  Moments wanted_;
};

TEST(Polish, MovesTheCutUntilTheConstraintsHold) {
  const TriangleMesh outer = sphere(24);
  const TriangleTree tree(outer.vertices, outer.faces);
  const double wall = 0.08;
  Moments plane = Moments::Zero();
  const Vec3 normal(0.6, 0.0, 0.8);
  plane[0] = -0.1;
  plane.segment<3>(1) = normal;
  const LayeredQuadric quadric = LayeredQuadric::ofOneLayer(plane);
  const auto found = cavityContour(
      openedSet(tree, wall, edgeOfCubes(surfaceArea(outer.vertices, outer.faces), 15000)), quadric);
  ASSERT_TRUE(found);
  const Moments solid = moments(outer.vertices, outer.faces);
  const auto bodyOf = [&](const TriangleMesh& cavity) {
    return Moments(solid - moments(cavity.vertices, cavity.faces));
  };
  // A little more hollow at the cut, which is 0.1 off the middle, and leaning a little.
  Moments wanted = bodyOf(found->contour.mesh);
  wanted[0] -= 2e-3;
  wanted.segment<3>(1) -= 2e-3 * 0.1 * normal;
  wanted[2] += 3e-4;
  const WantedGoal goal(wanted);
  CavityTask task{tree, goal, {}};
  task.model.solidMoments = solid;
  task.model.fillings = {{}};
  task.wall = wall;
  for (const Moving moving : {Moving::CutAlone, Moving::CutAndCreases}) {
    Contour contour = found->contour;
    EXPECT_GT(polish(task, quadric, moving, found->edge, {}, found->contour, contour.mesh.vertices)
                  .evaluations,
              0);
    const Vector left = goal.equalities(bodyOf(contour.mesh)).values;
    // Creases go as far as triangles stay sound.
    EXPECT_LT(left.cwiseAbs().maxCoeff(), moving == Moving::CutAlone ? 1e-5 : 1e-4);
    EXPECT_TRUE(selfIntersectingFaces(contour.mesh.vertices, contour.mesh.faces).empty());
    const double farthest =
        (contour.mesh.vertices - found->contour.mesh.vertices).rowwise().norm().maxCoeff();
    EXPECT_GT(farthest, 0.0);
    EXPECT_LT(farthest, found->edge);
  }
}

TEST(Polish, LeavesWhatIsHeldWhereItIs) {
  const TriangleMesh outer = sphere(16);
  const TriangleTree tree(outer.vertices, outer.faces);
  const Moments plane = (Moments() << -0.1, 0, 0, 1, 0, 0, 0, 0, 0, 0).finished();
  const LayeredQuadric quadric = LayeredQuadric::ofOneLayer(plane);
  const auto found = cavityContour(openedSet(tree, 0.08, 0.06), quadric);
  ASSERT_TRUE(found);
  Moments wanted = moments(outer.vertices, outer.faces) -
                   moments(found->contour.mesh.vertices, found->contour.mesh.faces);
  wanted[0] -= 2e-3;
  const WantedGoal goal(wanted);
  CavityTask task{tree, goal, {}};
  task.model.solidMoments = moments(outer.vertices, outer.faces);
  task.model.fillings = {{}};
  task.wall = 0.08;
  std::vector<char> held(static_cast<std::size_t>(found->contour.mesh.vertices.rows()), 0);
  for (std::size_t v = 0; v < held.size(); v += 2) held[v] = 1;
  Contour contour = found->contour;
  EXPECT_GT(polish(task, quadric, Moving::CutAlone, found->edge, held, found->contour,
                   contour.mesh.vertices)
                .evaluations,
            0);
  int moved = 0;
  for (Eigen::Index v = 0; v < contour.mesh.vertices.rows(); ++v) {
    const bool stays = contour.mesh.vertices.row(v) == found->contour.mesh.vertices.row(v);
    EXPECT_TRUE(stays || held[static_cast<std::size_t>(v)] == 0);
    moved += static_cast<int>(!stays);
  }
  EXPECT_GT(moved, 20);
}

// A round foot of 115 sides: as many directions to fall in, all nearly as easy.
TEST(Polish, FindsAWayWhereVeryManyConditionsAreAllButActive) {
  constexpr double kFoot = 30.0;
  constexpr double kHeight = 5.0;
  constexpr double kHub = 8.0;
  constexpr double kBeside = 0.3; // the hub
  std::vector<Vec2> profile = {
      {0.0, kHeight + kHub}, {kHub / 2, kHeight + kHub}, {kHub, kHeight + kHub}};
  constexpr int kRings = 5;
  for (int i = 0; i <= kRings; ++i)
    profile.emplace_back(kHub + (kFoot - kHub) * i / kRings, kHeight);
  for (int i = kRings; i > 0; --i) profile.emplace_back(kFoot * i / kRings, 0.0);
  profile.emplace_back(0.0, 0.0);
  TriangleMesh disc = revolved(profile, 115);
  for (auto vertex : disc.vertices.rowwise()) {
    if (vertex.z() > kHeight) vertex.x() += kBeside;
  }
  Options options;
  options.cavityShape = CavityShape::BestPossible;
  const Report report = optimizeMassProperties(disc, options).report;
  EXPECT_LE(std::get<double>(report.at("gap_to_limit")), 0.01);
}

TEST(Polish, KeepsConstraintsWhereNothingIsCutOff) {
  const TriangleMesh outer = sphere(24);
  const TriangleTree tree(outer.vertices, outer.faces);
  const double wall = 0.08;
  const auto found = cavityContour(
      openedSet(tree, wall, edgeOfCubes(surfaceArea(outer.vertices, outer.faces), 15000)), {});
  ASSERT_TRUE(found);
  const Faces& faces = found->contour.mesh.faces;
  const Points& before = found->contour.mesh.vertices;
  const Moments solid = moments(outer.vertices, outer.faces);
  const auto bodyOf = [&](const Points& vertices) {
    return Moments(solid - moments(vertices, faces));
  };
  // A little to the side, and as much heavier as that takes.
  Moments wanted = bodyOf(before);
  wanted[0] += 1e-3 * found->edge * surfaceArea(before, faces);
  wanted[1] += 5e-6;
  const WantedGoal goal(wanted);
  CavityTask task{tree, goal, {}};
  task.model.fillings = {{}};
  task.model.solidMoments = solid;
  task.wall = wall;
  Points vertices = before;
  ASSERT_TRUE(withdrawFromWalls(task, found->edge, {}, found->contour, vertices));
  EXPECT_LT((bodyOf(vertices) - wanted).head<4>().cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_GE(ClearanceQuery(tree).measure(vertices, faces, 0.2).least, wall);
  EXPECT_LT((vertices - before).rowwise().norm().maxCoeff(), 0.1 * found->edge);
  // So much is not to be had within a tenth of an edge.
  Moments far = wanted;
  far[1] += 0.1;
  const WantedGoal farGoal(far);
  CavityTask farTask{tree, farGoal, task.model};
  farTask.wall = wall;
  EXPECT_FALSE(withdrawFromWalls(farTask, found->edge, {}, found->contour, vertices));
}

} // namespace
} // namespace massprops::testing
