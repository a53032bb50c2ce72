// Objectives, constraints and verdicts of the goals on bodies whose behaviour is known, and their
// derivatives.
#include "core/goals/goals.h"

#include "shapes.h"
#include "translated_moments.h"

#include <gtest/gtest.h>

#include <cmath>

namespace massprops::testing {
namespace {

const Weights kPublished;

Moments momentsOf(const TriangleMesh& mesh) {
  return moments(mesh.vertices, mesh.faces);
}

ContactArea square(double side) {
  const double h = side / 2;
  return {{{-h, -h}, {h, -h}, {h, h}, {-h, h}}, {}};
}

ContactArea ellipse(double rx, double ry) {
  return {{}, Vec2(rx, ry)};
}

/// A body of mass `m` with its centre at `c` and the inertia of a ball.
Moments bodyAt(const Vec3& c, double m = 1.0) {
  const TriangleMesh ball = sphere(4);
  const Moments unit = momentsOf(ball) / momentsOf(ball)[0];
  return m * translated(unit, c);
}

double number(const Report& report, const std::string& key) {
  return std::get<double>(report.at(key));
}

bool truth(const Report& report, const std::string& key) {
  return std::get<bool>(report.at(key));
}

Report described(const Goal& goal, const Moments& m) {
  Report report;
  goal.describe(m, "after", report);
  return report;
}

/// All values of the goal in one vector: objective, equalities, inequalities.
Vector allValues(const Goal& goal, const Moments& m) {
  const Vector e = goal.equalities(m).values;
  const Vector g = goal.inequalities(m).values;
  Vector all(1 + e.size() + g.size());
  all << goal.objective(m).value, e, g;
  return all;
}

Matrix allGradients(const Goal& goal, const Moments& m) {
  const MomentGradients e = goal.equalities(m).gradients;
  const MomentGradients g = goal.inequalities(m).gradients;
  Matrix all(1 + e.rows() + g.rows(), 10);
  all.row(0) = goal.objective(m).gradient;
  if (e.rows() > 0) all.middleRows(1, e.rows()) = e;
  if (g.rows() > 0) all.bottomRows(g.rows()) = g;
  return all;
}

void expectGradientsMatch(const Goal& goal, const Moments& m) {
  const Matrix gradients = allGradients(goal, m);
  // Smooth functions of order one: truncation h² = 1e-10, rounding 1e-16/h = 1e-11; both times the
  // third derivatives and values, some tens for the quotient of moments.
  const double h = 1e-5;
  for (int k = 0; k < 10; ++k) {
    Moments step = Moments::Zero();
    step[k] = h;
    const Vector difference = (allValues(goal, m + step) - allValues(goal, m - step)) / (2 * h);
    for (Eigen::Index r = 0; r < difference.size(); ++r) {
      EXPECT_NEAR(gradients(r, k), difference[r], 1e-6 * (1 + std::abs(difference[r])))
          << "value " << r << ", moment " << k;
    }
  }
}

TEST(StandGoal, HasTheGradientsOfItsValues) {
  const Moments m = momentsOf(transformed(blob(5), someRotation(), {0.2, -0.1, 0.7}));
  for (const ContactArea& area : {square(0.5), ellipse(0.3, 0.2)}) {
    expectGradientsMatch(*makeStandGoal(area, kPublished, 1.0), m);
  }
}

TEST(StandGoal, IsTheHeightAndTheSquaredDistanceFromTheContactCentre) {
  const auto goal = makeStandGoal(square(1.0), kPublished, 1.0);
  EXPECT_NEAR(goal->objective(bodyAt({0.2, -0.3, 0.6})).value, 0.04 + 0.09 + 0.6, 1e-12);
  EXPECT_NEAR(goal->objective(bodyAt({0.2, -0.3, 0.6}, 7.0)).value, 0.04 + 0.09 + 0.6, 1e-12);
}

TEST(StandGoal, ScalesItsObjectiveWithTheWeightOfTheCentreOfMass) {
  Weights triple;
  triple.centerOfMass = 3.0;
  const Moments m = bodyAt({0.2, -0.3, 0.6});
  EXPECT_NEAR(makeStandGoal(square(1.0), triple, 1.0)->objective(m).value,
              3 * makeStandGoal(square(1.0), kPublished, 1.0)->objective(m).value, 1e-12);
}

TEST(StandGoal, IsReachedExactlyAboveTheContactArea) {
  for (const ContactArea& area : {square(1.0), ellipse(0.5, 0.5)}) {
    const auto goal = makeStandGoal(area, kPublished, 1.0);
    for (const double x : {0.0, 0.3, 0.49}) EXPECT_TRUE(goal->isReached(bodyAt({x, 0, 0.6})));
    for (const double x : {0.51, 2.0}) EXPECT_FALSE(goal->isReached(bodyAt({x, 0, 0.6})));
  }
}

TEST(StandGoal, HasConstraintsThatImplyStandingWithAMargin) {
  // Whatever satisfies the constraints stands; what is beyond the area violates them.
  Random random(17);
  for (const ContactArea& area : {square(0.8), ellipse(0.5, 0.25)}) {
    const auto goal = makeStandGoal(area, kPublished, 1.0);
    int feasible = 0;
    for (int trial = 0; trial < 300; ++trial) {
      const Moments m = bodyAt({0.6 * random(), 0.6 * random(), 0.5 + 0.4 * random()});
      const bool holds = goal->inequalities(m).values.maxCoeff() <= 0.0;
      feasible += holds ? 1 : 0;
      if (holds) {
        EXPECT_GT(number(described(*goal, m), "tip_angle_after"), 0.0);
      }
      if (!goal->isReached(m)) {
        EXPECT_GT(goal->inequalities(m).values.maxCoeff(), 0.0);
      }
    }
    EXPECT_GT(feasible, 20); // else nothing was tested
    EXPECT_LT(feasible, 280);
  }
}

TEST(StandGoal, NeedsTheCentreOfMassAboveTheGround) {
  const auto goal = makeStandGoal(square(1.0), kPublished, 1.0);
  EXPECT_GT(goal->inequalities(bodyAt({0, 0, -0.1})).values.maxCoeff(), 0.0);
  EXPECT_LE(goal->inequalities(bodyAt({0, 0, 0.1})).values.maxCoeff(), 0.0);
}

TEST(StandGoal, ReportsTheTippingAngle) {
  const auto goal = makeStandGoal(square(1.0), kPublished, 1.0);
  const Report stands = described(*goal, bodyAt({0, 0, 0.5}));
  EXPECT_NEAR(number(stands, "tip_angle_after"), 45.0, 1e-9);
  EXPECT_TRUE(truth(stands, "stands_after"));
  const Report falls = described(*goal, bodyAt({1.0, 0, 0.5}));
  EXPECT_NEAR(number(falls, "tip_angle_after"), -45.0, 1e-9);
  EXPECT_FALSE(truth(falls, "stands_after"));
}

TEST(StandGoal, KeepsManyCornersOfARoundFoot) {
  // 1000 corners on a circle: the constraint polygon is inscribed, so it is never too generous.
  ContactArea round;
  for (int i = 0; i < 1000; ++i) {
    const double t = 2 * std::acos(-1.0) * i / 1000;
    round.polygon.emplace_back(0.3 * std::cos(t), 0.3 * std::sin(t));
  }
  const auto goal = makeStandGoal(round, kPublished, 1.0);
  EXPECT_LT(goal->inequalities(bodyAt({0, 0, 0.5})).values.size(), 100);
  for (int i = 0; i < 64; ++i) {
    const double t = 0.1 * i;
    const Vec3 outside(0.301 * std::cos(t), 0.301 * std::sin(t), 0.5);
    const Vec3 inside(0.2 * std::cos(t), 0.2 * std::sin(t), 0.5);
    EXPECT_GT(goal->inequalities(bodyAt(outside)).values.maxCoeff(), 0.0);
    EXPECT_LE(goal->inequalities(bodyAt(inside)).values.maxCoeff(), 0.0);
  }
}

std::unique_ptr<Goal> spinGoal(const Moments& solid, const Weights& weights = kPublished) {
  return makeSpinGoal(solid, weights, 1.0);
}

/// A box of the given size that stands on the pivot, its centre above it.
Moments standingBox(const Vec3& size) {
  return momentsOf(transformed(box(size, 1), Mat3::Identity(), {0, 0, size.z() / 2 + 0.1}));
}

TEST(SpinGoal, HasTheGradientsOfItsValues) {
  const Moments solid = momentsOf(transformed(blob(5), someRotation(), {0.2, -0.1, 0.7}));
  const TriangleMesh cavity = transformed(blob(4), 0.6 * rotation({1, 1, 0}, 0.4), {0.1, 0.1, 0.6});
  expectGradientsMatch(*spinGoal(solid), solid - momentsOf(cavity));
}

TEST(SpinGoal, HasADerivativeWhereTheHorizontalMomentsAreEqual) {
  // I_xx = I_yy, I_xy = 0: the eigenvalues themselves have a kink there.
  // Density 20 makes the moments of order one, as the step of the differences expects.
  const Moments disc = 20 * standingBox({1.0, 1.0, 0.2});
  expectGradientsMatch(*spinGoal(disc), disc);
}

TEST(SpinGoal, IsTheStaticMomentAndTheSumOfSquaredRatios) {
  const Vec3 s(1.0, 0.8, 0.3);
  const Moments m = standingBox(s);
  const double a = s.x() * s.x() + s.z() * s.z(); // of I_yy, all without m/12
  const double b = s.y() * s.y() + s.z() * s.z();
  const double c = s.x() * s.x() + s.y() * s.y();
  const double height = s.z() / 2 + 0.1;
  EXPECT_NEAR(spinGoal(m)->objective(m).value, height + (a * a + b * b) / (c * c), 1e-12);
  // Half the mass in the same shape: half the static moment, the same ratios.
  EXPECT_NEAR(spinGoal(m)->objective(0.5 * m).value, height / 2 + (a * a + b * b) / (c * c), 1e-12);
}

TEST(SpinGoal, HasIndependentWeightsForCentreAndInertia) {
  Weights onlyCentre;
  onlyCentre.inertia = 0.0;
  Weights onlyInertia;
  onlyInertia.centerOfMass = 0.0;
  const Moments m = standingBox({1.0, 0.8, 0.3});
  EXPECT_NEAR(spinGoal(m, onlyCentre)->objective(m).value, 0.25, 1e-12);
  EXPECT_NEAR(spinGoal(m, onlyCentre)->objective(m).value +
                  spinGoal(m, onlyInertia)->objective(m).value,
              spinGoal(m)->objective(m).value, 1e-12);
}

TEST(SpinGoal, DoesNotChangeWhenTheBodyIsTurnedAboutItsAxis) {
  const Moments m = standingBox({1.0, 0.6, 0.3});
  const TriangleMesh turned =
      transformed(transformed(box({1.0, 0.6, 0.3}, 1), Mat3::Identity(), {0, 0, 0.25}),
                  rotation(Vec3::UnitZ(), 0.7));
  EXPECT_NEAR(spinGoal(m)->objective(momentsOf(turned)).value, spinGoal(m)->objective(m).value,
              1e-12);
  EXPECT_LT(largestViolation(*spinGoal(m), momentsOf(turned)), 1e-12);
}

TEST(SpinGoal, InertiaTermIsNeverBelowOneHalf) {
  // For a principal axis I_zz ≤ I_a + I_b, so I_a² + I_b² ≥ I_zz²/2; a flat disc comes near.
  Weights onlyInertia;
  onlyInertia.centerOfMass = 0.0;
  Random random(23);
  for (int trial = 0; trial < 50; ++trial) {
    const Vec3 size = (random.vector().array() + 1.05).matrix();
    const Moments m = standingBox(size);
    EXPECT_GE(spinGoal(m, onlyInertia)->objective(m).value, 0.5);
  }
  const Moments flat = standingBox({1, 1, 0.001});
  EXPECT_NEAR(spinGoal(flat, onlyInertia)->objective(flat).value, 0.5, 1e-5);
}

TEST(SpinGoal, HasNoViolationExactlyWhenTheAxisIsPrincipalAndCarriesTheCentre) {
  const Moments upright = standingBox({1.0, 0.8, 0.3});
  EXPECT_LT(largestViolation(*spinGoal(upright), upright), 1e-12);
  // Off the axis, and leaning about a horizontal axis through its own centre.
  EXPECT_NEAR(largestViolation(*spinGoal(upright), translated(upright, {0.07, 0, 0})), 0.07, 1e-12);
  const TriangleMesh leaning =
      transformed(transformed(box({1.0, 0.8, 0.3}, 1), rotation({1, 0, 0}, 0.3)), Mat3::Identity(),
                  {0, 0, 0.5});
  EXPECT_GT(largestViolation(*spinGoal(upright), momentsOf(leaning)), 1e-3);
}

TEST(SpinGoal, ReportsOffsetTiltAndRatios) {
  const Vec3 s(1.0, 0.8, 0.3);
  const TriangleMesh leaning = transformed(transformed(box(s, 1), rotation({1, 0, 0}, 0.2)),
                                           Mat3::Identity(), {0.03, -0.04, 0.5});
  const Moments solid = momentsOf(leaning);
  const Report report = described(*makeSpinGoal(solid, kPublished, 200.0), solid);
  EXPECT_NEAR(number(report, "axis_offset_after"), 0.05 * 200.0, 1e-9);
  EXPECT_NEAR(number(report, "axis_tilt_after"), 0.2 * 180 / std::acos(-1.0), 1e-9);

  const Moments upright = standingBox(s);
  const Report straight = described(*spinGoal(upright), upright);
  const double axial = s.x() * s.x() + s.y() * s.y();
  EXPECT_NEAR(number(straight, "moment_ratio_a_after"), axial / (s.x() * s.x() + s.z() * s.z()),
              1e-9);
  EXPECT_NEAR(number(straight, "moment_ratio_b_after"), axial / (s.y() * s.y() + s.z() * s.z()),
              1e-9);
}

TEST(SpinGoal, IsReachedAboutTheLargestAndTheSmallestMomentButNotTheMiddleOne) {
  for (const auto& [size, spins] : std::vector<std::pair<Vec3, bool>>{
           {{1.0, 0.8, 0.3}, true}, {{0.3, 0.4, 1.0}, true}, {{1.0, 0.3, 0.6}, false}}) {
    const Moments m = standingBox(size);
    EXPECT_EQ(spinGoal(m)->isReached(m), spins) << size.transpose();
  }
}

TEST(SpinGoal, IsNotReachedOffTheAxis) {
  const Moments m = translated(standingBox({1.0, 0.8, 0.3}), {0.01, 0, 0});
  EXPECT_FALSE(spinGoal(m)->isReached(m));
}

TEST(SpinGoal, TurnsAboutThePivot) {
  const Moments m = standingBox({1.0, 0.8, 0.3});
  const Vec3 pivot(0.2, -0.1, 0.05);
  const auto goal = makeSpinGoal(m, kPublished, 1.0, pivot);
  EXPECT_NEAR(goal->objective(m).value, spinGoal(m)->objective(m).value - 0.05, 1e-12);
  EXPECT_LT(largestViolation(*goal, translated(m, {0.2, -0.1, 0})), 1e-12);
  EXPECT_FALSE(goal->isReached(m));
  EXPECT_TRUE(goal->isReached(translated(m, {0.2, -0.1, 0})));
  expectGradientsMatch(*goal, 20 * m);
}

TEST(YoYoGoal, HasTheGradientsOfItsValues) {
  const Moments solid = momentsOf(transformed(blob(5), someRotation(), {0.2, -0.1, 0.7}));
  expectGradientsMatch(*makeYoYoGoal(solid, kPublished, 1.0, {0.1, 0.2, 0.5}), solid);
}

TEST(YoYoGoal, IsReachedWithTheCentreInTheMiddleOfTheAxleOnly) {
  const Moments m = standingBox({1.0, 0.9, 0.4}); // its middle at 0.3
  const auto goal = makeYoYoGoal(m, kPublished, 100.0, {0, 0, 0.3});
  EXPECT_TRUE(goal->isReached(m));
  EXPECT_LT(largestViolation(*goal, m), 1e-12);
  const Moments high = translated(m, {0, 0, 0.02});
  EXPECT_FALSE(goal->isReached(high));
  EXPECT_NEAR(largestViolation(*goal, high), 0.02, 1e-12);
  EXPECT_NEAR(number(described(*goal, high), "middle_offset_after"), 2.0, 1e-9);
  EXPECT_TRUE(truth(described(*goal, high), "spins_after"));
  EXPECT_NEAR(goal->objective(high).value, goal->objective(m).value, 1e-12); // no height in it
}

TEST(StandEmptyAndFilledGoal, HasTheGradientsOfItsValues) {
  const Moments outer = momentsOf(transformed(blob(5), someRotation(), {0.2, -0.1, 0.9}));
  const Moments cavity = momentsOf(transformed(blob(4), 0.6 * Mat3::Identity(), {0.3, 0, 0.8}));
  for (const double filling : {0.5, 1.0, 3.0}) { // lighter and heavier than the material
    expectGradientsMatch(*makeStandEmptyAndFilledGoal(square(0.3), outer, filling, kPublished, 1.0),
                         outer - cavity);
  }
}

TEST(StandEmptyAndFilledGoal, IsTheSumOfStandOverBothBodies) {
  const Moments outer = momentsOf(transformed(box({1, 1, 2}, 1), Mat3::Identity(), {0, 0, 1}));
  const Moments cavity =
      momentsOf(transformed(box({0.5, 0.6, 0.7}, 1), Mat3::Identity(), {0.2, 0, 1.5}));
  const auto stand = makeStandGoal(square(1.0), kPublished, 1.0);
  const double filling = 0.7;
  const auto goal = makeStandEmptyAndFilledGoal(square(1.0), outer, filling, kPublished, 1.0);
  const Moments empty = outer - cavity;
  const Moments full = outer - cavity + filling * cavity;
  EXPECT_NEAR(goal->objective(empty).value,
              stand->objective(empty).value + stand->objective(full).value, 1e-12);
  const Report report = described(*goal, empty);
  EXPECT_NEAR(number(report, "tip_angle_filled_after"),
              number(described(*stand, full), "tip_angle_after"), 1e-9);
  EXPECT_NEAR(number(report, "tip_angle_empty_after"),
              number(described(*stand, empty), "tip_angle_after"), 1e-9);
}

TEST(StandEmptyAndFilledGoal, NeedsBothStates) {
  // Empty the centre is above the foot; the filling pulls it over.
  const Moments outer = bodyAt({0.4, 0, 1.0}, 1.0);
  const Moments empty = bodyAt({0.1, 0, 1.0}, 0.5);
  EXPECT_TRUE(makeStandGoal(square(0.5), kPublished, 1.0)->isReached(empty));
  const auto goal = makeStandEmptyAndFilledGoal(square(0.5), outer, 1.0, kPublished, 1.0);
  EXPECT_FALSE(goal->isReached(empty));
  EXPECT_NE(goal->worstViolation(empty).find("filled"), std::string::npos);
}

TEST(RollUprightGoal, CountsTheRestingFaces) {
  // A tumbler with its centre of mass above and below the centre of its round foot.
  const TriangleMesh tumbler = transformed(capsule(0.3, 0.3, 160), Mat3::Identity(), {0, 0, 0.45});
  const auto goal = makeRollUprightGoal({}, tumbler.vertices, kPublished, 1.0);
  EXPECT_TRUE(goal->isReached(bodyAt({0, 0, 0.2})));
  EXPECT_FALSE(goal->isReached(bodyAt({0, 0, 0.45})));
  EXPECT_EQ(std::get<int>(described(*goal, bodyAt({0, 0, 0.2})).at("resting_faces_after")), 1);
  expectGradientsMatch(*goal, bodyAt({0.01, 0.02, 0.2}));
}

TEST(FloatGoal, HasTheGradientsOfItsValues) {
  const TriangleMesh hull = transformed(blob(5), someRotation(), {0.2, -0.1, 1.2});
  for (const double level : {0.3, 1.0}) {
    expectGradientsMatch(*makeFloatGoal(hull.vertices, hull.faces, level, 0.8, kPublished, 1.0),
                         0.5 * momentsOf(hull));
  }
}

/// A box of 1 × 0.8 × 0.5 on the ground.
TriangleMesh groundedBox() {
  return transformed(box({1, 0.8, 0.5}, 3), Mat3::Identity(), {0, 0, 0.25});
}

TEST(FloatGoal, HoldsForABoxOfTheRightDensity) {
  // A homogeneous box of density s floats at the share s of its height; BM = b²/(12 sh).
  const TriangleMesh b = groundedBox();
  for (const double s : {0.3, 0.6}) {
    const auto goal = makeFloatGoal(b.vertices, b.faces, s, 1.0, kPublished, 100.0);
    const Moments m = s * momentsOf(b);
    EXPECT_LT(largestViolation(*goal, m), 1e-12);
    EXPECT_TRUE(goal->isReached(m));
    const Report report = described(*goal, m);
    EXPECT_NEAR(number(report, "draught_after"), 50 * s, 1e-9);
    EXPECT_NEAR(number(report, "heel_angle_after"), 0, 1e-6);
    EXPECT_NEAR(number(report, "metacentric_height_after"),
                100 * (0.64 / (12 * s * 0.5) - 0.25 * (1 - s)), 1e-7);
    EXPECT_NEAR(number(report, "metacentric_height_long_after"),
                100 * (1 / (12 * s * 0.5) - 0.25 * (1 - s)), 1e-7);
    EXPECT_NEAR(number(report, "reserve_buoyancy_after"), 1 - s, 1e-12);
    // Heavier, aside, or top-heavy beyond the metacentre it fails.
    EXPECT_NEAR(goal->equalities(1.1 * m).values[0], 0.1 * s, 1e-12);
    EXPECT_FALSE(goal->isReached(1.1 * m));
    EXPECT_FALSE(goal->isReached(translated(m, {0.05, 0, 0})));
    EXPECT_GT(goal->inequalities(translated(m, {0, 0, 0.5})).values[0], 0.0);
    EXPECT_FALSE(goal->isReached(translated(m, {0, 0, 0.5})));
  }
}

TEST(FloatGoal, UnderWaterNeedsNeutralWeightAndALowCentre) {
  const TriangleMesh ball = transformed(sphere(8), Mat3::Identity(), {0, 0, 1});
  const auto goal = makeFloatGoal(ball.vertices, ball.faces, 1.0, 0.8, kPublished, 1.0);
  const double neutral = 0.8 * momentsOf(ball)[0];
  const double middle = momentsOf(ball)[3] / momentsOf(ball)[0];
  EXPECT_TRUE(goal->isReached(bodyAt({0, 0, middle - 0.1}, neutral)));
  EXPECT_LT(largestViolation(*goal, bodyAt({0, 0, middle - 0.1}, neutral)), 1e-9);
  EXPECT_FALSE(goal->isReached(bodyAt({0, 0, middle + 0.1}, neutral)));
  EXPECT_GT(largestViolation(*goal, bodyAt({0, 0, middle + 0.1}, neutral)), 0.05);
  EXPECT_FALSE(goal->isReached(bodyAt({0, 0, middle - 0.1}, 1.01 * neutral)));
  EXPECT_FALSE(goal->isReached(bodyAt({0, 0, middle - 0.1}, 0.99 * neutral)));
}

TEST(HangGoal, HasTheGradientsOfItsValues) {
  const Moments m = momentsOf(transformed(blob(5), someRotation(), {0.2, -0.1, 0.7}));
  expectGradientsMatch(*makeHangGoal({0.1, 0.2, 2.0}, kPublished, 1.0), m);
}

TEST(HangGoal, FindsTheAngleOfAnLShape) {
  // Two bars of 1 × 1 and 3 × 1 cells, hung from the corner: c = (1.25, 0.75) of the L whose cells
  // are (0,0), (1,0), (2,0), (0,1); from the top left corner (0, 2) it hangs off by
  // atan(1.25 / (2 − 0.75)) = 45°.
  const TriangleMesh cells = polycube({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 1}}, 2);
  const Moments m = translated(momentsOf(cells), {0, -0.5, 0});
  const auto goal = makeHangGoal({0, 0, 2}, kPublished, 10.0);
  const Report report = described(*goal, m);
  EXPECT_NEAR(number(report, "hanging_angle_after"), 45.0, 1e-9);
  EXPECT_NEAR(number(report, "hanging_depth_after"), 12.5, 1e-9);
  EXPECT_FALSE(goal->isReached(m));
  EXPECT_NEAR(largestViolation(*goal, m), 1.25, 1e-12);
  const auto above = makeHangGoal({1.25, 0, 2}, kPublished, 10.0);
  EXPECT_TRUE(above->isReached(m));
  EXPECT_LT(largestViolation(*above, m), 1e-12);
}

TEST(HangGoal, IsNotReachedWithTheCentreAboveThePoint) {
  const auto goal = makeHangGoal({0, 0, 0.5}, kPublished, 1.0);
  EXPECT_FALSE(goal->isReached(bodyAt({0, 0, 0.6})));
  EXPECT_NEAR(number(described(*goal, bodyAt({0, 0, 0.6})), "hanging_angle_after"), 180, 1e-6);
  EXPECT_GT(largestViolation(*goal, bodyAt({0, 0, 0.6})), 0.1);
}

TEST(MassGoal, HasTheGradientsOfItsValues) {
  const Moments m = momentsOf(blob(5));
  expectGradientsMatch(*makeMassGoal(m[0], 0.4 * m[0], kPublished, 1.0), m);
  expectGradientsMatch(*makeMassGoal(m[0], std::nullopt, kPublished, 1.0), m);
}

TEST(MassGoal, MeasuresInGrams) {
  const auto goal = makeMassGoal(2.0, 1.0, kPublished, 30.0);
  EXPECT_NEAR(goal->objective(bodyAt({0, 0, 0}, 1.5)).value, 0.0625, 1e-12);
  EXPECT_NEAR(number(described(*goal, bodyAt({0, 0, 0}, 1.5)), "mass_error_after"), 15.0, 1e-9);
  EXPECT_FALSE(goal->isReached(bodyAt({0, 0, 0}, 1.5)));
  EXPECT_TRUE(goal->isReached(bodyAt({0, 0, 0}, 1.0)));
  EXPECT_NE(goal->worstViolation(bodyAt({0, 0, 0}, 1.5)).find("15 g too large"), std::string::npos);
}

TEST(MassGoal, WithoutATargetPrefersTheLighterBody) {
  const auto goal = makeMassGoal(2.0, std::nullopt, kPublished, 1.0);
  EXPECT_EQ(largestViolation(*goal, bodyAt({0, 0, 0}, 1.5)), 0.0);
  EXPECT_LT(goal->objective(bodyAt({0, 0, 0}, 0.5)).value,
            goal->objective(bodyAt({0, 0, 0}, 1.5)).value);
}

} // namespace
} // namespace massprops::testing
