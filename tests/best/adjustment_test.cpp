// A contour moves until the body of its triangles keeps the goal's constraints.
#include "core/best/adjustment.h"

#include "core/base/tolerances.h"
#include "core/base/triangle.h"
#include "core/contour/cavity_surface.h"
#include "core/query/self_intersection.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <optional>
#include <utility>
#include <vector>

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

const Vec3 kNormal(0.6, 0.0, 0.8);

/// A ball's cavity, whole or cut off by a plane, on the walls.
struct HollowBall {
  TriangleMesh outer = sphere(24);
  TriangleTree tree{outer.vertices, outer.faces};
  FeasibleSet set{tree, 0.08, 0.08};
  Moments solid = moments(outer.vertices, outer.faces);
  double edge = edgeFor(set);
  Contour contour;

  explicit HollowBall(bool isCut) {
    Moments plane = Moments::Zero();
    plane[0] = -0.1;
    plane.segment<3>(1) = kNormal;
    std::optional<QuadricCut> cut;
    if (isCut) cut = QuadricCut{LayeredQuadric::ofOneLayer(plane)};
    const FeasibleRegion region = feasibleRegion(set, edge);
    contour = dualContour(BorderLattice(set, region, cut));
    const std::vector<char> all(static_cast<std::size_t>(contour.mesh.vertices.rows()), 1);
    // A little farther than need be, for chords.
    moveOntoWalls(tree, (1.0 + 5e-4) * set.wall, edge, all, contour);
    ClearanceQuery clearance(tree);
    keepWall(clearance, set.wall, contour.mesh.faces, contour.mesh.vertices);
  }

  Moments bodyOf(const TriangleMesh& cavity) const {
    return solid - moments(cavity.vertices, cavity.faces);
  }

  CavityTask task(const Goal& goal) const {
    CavityTask result{tree, goal, {}};
    result.model.solidMoments = solid;
    result.model.fillings = {{}};
    result.wall = set.wall;
    return result;
  }
};

double farthestMove(const Contour& a, const Contour& b) {
  return (a.mesh.vertices - b.mesh.vertices).rowwise().norm().maxCoeff();
}

TEST(Adjustment, MovesTheCutUntilTheConstraintsHold) {
  const HollowBall ball(true);
  // A little more hollow at the cut, which is 0.1 off the middle, and leaning a little.
  Moments wanted = ball.bodyOf(ball.contour.mesh);
  wanted[0] -= 2e-3;
  wanted.segment<3>(1) -= 2e-3 * 0.1 * kNormal;
  wanted[2] += 3e-4;
  const WantedGoal goal(wanted);
  Contour contour = ball.contour;
  EXPECT_GT(adjustOnTriangles(ball.task(goal), 0.5 * ball.edge, contour), 0);
  EXPECT_LE(largestViolation(goal, ball.bodyOf(contour.mesh)), kFeasibility);
  EXPECT_TRUE(selfIntersectingFaces(contour.mesh.vertices, contour.mesh.faces).empty());
  const double farthest = farthestMove(contour, ball.contour);
  EXPECT_GT(farthest, 0.0);
  EXPECT_LT(farthest, ball.edge);
  for (Eigen::Index v = 0; v < contour.mesh.vertices.rows(); ++v) {
    if (contour.on[static_cast<std::size_t>(v)] == On::Cut) continue;
    EXPECT_EQ(contour.mesh.vertices.row(v), ball.contour.mesh.vertices.row(v));
  }
}

TEST(Adjustment, LeavesWhatKeepsTheConstraintsWhereItIs) {
  const HollowBall ball(true);
  const WantedGoal goal(ball.bodyOf(ball.contour.mesh));
  Contour contour = ball.contour;
  EXPECT_EQ(adjustOnTriangles(ball.task(goal), 0.5 * ball.edge, contour), 0);
  EXPECT_EQ(contour.mesh.vertices, ball.contour.mesh.vertices);
}

TEST(Adjustment, MovesNothingWhereTheConstraintsDoNotCount) {
  const HollowBall ball(true);
  const WantedGoal goal(ball.solid);
  CavityTask task = ball.task(goal);
  task.weights.constraints = 0.0;
  Contour contour = ball.contour;
  adjustOnTriangles(task, 0.5 * ball.edge, contour);
  EXPECT_EQ(contour.mesh.vertices, ball.contour.mesh.vertices);
}

TEST(Adjustment, MovesWhatIsBehindTheWallsInwardsWhereNothingIsCutOff) {
  const HollowBall ball(false);
  const TriangleMesh& before = ball.contour.mesh;
  // A little to the side, and as much heavier as that takes.
  Moments wanted = ball.bodyOf(before);
  wanted[0] += 1e-3 * ball.edge * surfaceArea(before.vertices, before.faces);
  wanted[1] += 5e-6;
  const WantedGoal goal(wanted);
  Contour contour = ball.contour;
  EXPECT_GT(adjustOnTriangles(ball.task(goal), 0.5 * ball.edge, contour), 0);
  EXPECT_LE(largestViolation(goal, ball.bodyOf(contour.mesh)), kFeasibility);
  // Nothing comes nearer but by what chords are nearer than their ends.
  EXPECT_GE(ClearanceQuery(ball.tree).measure(contour.mesh.vertices, before.faces, 0.2).least,
            (1.0 - 1e-4) * ball.set.wall);
  EXPECT_LT(farthestMove(contour, ball.contour), 0.1 * ball.edge);
}

TEST(Adjustment, MovesNothingWhereTheConstraintsAreOutOfReach) {
  const HollowBall ball(false);
  Moments wanted = ball.bodyOf(ball.contour.mesh);
  wanted[1] += 0.1;
  const WantedGoal goal(wanted);
  Contour contour = ball.contour;
  adjustOnTriangles(ball.task(goal), 0.1 * ball.edge, contour);
  EXPECT_EQ(contour.mesh.vertices, ball.contour.mesh.vertices);
}

} // namespace
} // namespace massprops::testing
