// Objectives, constraints and verdicts of the goals on bodies whose behaviour is known, and their
// derivatives.
#include "core/base/angles.h"
#include "core/goals/float.h"
#include "core/goals/hang.h"
#include "core/goals/mass.h"
#include "core/goals/objective.h"
#include "core/goals/published_stand.h"
#include "core/goals/spin.h"
#include "core/goals/stand.h"
#include "core/goals/stand_empty_and_filled.h"
#include "core/goals/yo_yo.h"
#include "core/physics/filling.h"

#include "goals/goal_checks.h"
#include "shapes.h"
#include "translated_moments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace massprops::testing {
namespace {

const Weights kPublished;

TEST(StandGoal, HasTheGradientsOfItsValues) {
  const Moments m = momentsOf(transformed(blob(5), someRotation(), {0.2, -0.1, 0.7}));
  for (const ContactArea& area : {square(0.5), ellipse(0.3, 0.2)}) {
    expectGradientsMatch(*makeStandGoal(area, kPublished), m);
    expectGradientsMatch(*makeStandGoal(area, kPublished, 20.0, 3.0), m);
    expectGradientsMatch(*makePublishedStandGoal(area, 2.0, kPublished), m);
  }
}

TEST(StandGoal, FollowsTheTangentOfTheTippingAngle) {
  // A soft minimum over 76 directions is below the minimum, by log 76 over the sharpness at most.
  Random random(5);
  for (const ContactArea& area : {square(0.8), ellipse(0.5, 0.25)}) {
    const auto goal = makeStandGoal(area, kPublished);
    for (int trial = 0; trial < 100; ++trial) {
      const Moments m = bodyAt({0.6 * random(), 0.6 * random(), 0.5 + 0.4 * random()});
      const double tangent = std::tan(*goal->measure(m) / kDegrees);
      // Between directions 5° apart a corner may be farther, by 1 − cos 2.5° of its distance.
      const Vec3 c = massProperties(m).centerOfMass;
      const double between = 1.2e-3 * (c.head<2>().norm() + 0.6) / c.z();
      EXPECT_LE(-goal->objective(m).value, tangent + between);
      EXPECT_GE(-goal->objective(m).value, tangent - std::log(76.0) / 70.0);
      EXPECT_NEAR(levelReached(goal->conditions()[0], m), tangent, between);
      EXPECT_GE(levelReached(goal->conditions()[0], m), tangent - 1e-12);
    }
  }
}

TEST(StandGoal, AsksForTheLeastMaterialThatStandsAsFarAsWanted) {
  Random random(6);
  for (const ContactArea& area : {square(0.8), ellipse(0.5, 0.25)}) {
    const double wanted = 15.0;
    const auto goal = makeStandGoal(area, kPublished, wanted, 4.0);
    const auto verdict = makeStandVerdict(area, 1.0, wanted);
    int feasible = 0;
    for (int trial = 0; trial < 300; ++trial) {
      const Moments m = bodyAt({0.4 * random(), 0.4 * random(), 0.4 + 0.3 * random()}, 2.0);
      EXPECT_NEAR(goal->objective(m).value, 0.5, 1e-12);
      const bool holds = largestViolation(*goal, m) == 0.0;
      EXPECT_EQ(holds, verdict->isReached(m)) << number(described(*verdict, m), "tip_angle_after");
      feasible += holds ? 1 : 0;
    }
    EXPECT_GT(feasible, 20); // else nothing was tested
    EXPECT_LT(feasible, 280);
  }
}

TEST(StandVerdict, NamesTheWantedAngle) {
  const auto verdict = makeStandVerdict(square(1.0), 1.0, 50.0);
  EXPECT_EQ(verdict->whatIsMissed(bodyAt({0, 0, 0.5})),
            "it tips over at 45\u00b0 instead of 50\u00b0");
}

TEST(PublishedStandGoal, IsTheHeightAndTheSquaredDistanceInMillimetres) {
  const auto goal = makePublishedStandGoal(square(1.0), 10.0, kPublished);
  EXPECT_NEAR(goal->objective(bodyAt({0.2, -0.3, 0.6})).value, 4 + 9 + 6, 1e-12);
  EXPECT_NEAR(goal->objective(bodyAt({0.2, -0.3, 0.6}, 7.0)).value, 4 + 9 + 6, 1e-12);
}

TEST(StandGoal, ScalesItsObjectiveWithTheWeightOfTheCentreOfMass) {
  Weights triple;
  triple.centerOfMass = 3.0;
  const Moments m = bodyAt({0.2, -0.3, 0.6});
  EXPECT_NEAR(makeStandGoal(square(1.0), triple)->objective(m).value,
              3 * makeStandGoal(square(1.0), kPublished)->objective(m).value, 1e-12);
  EXPECT_NEAR(makePublishedStandGoal(square(1.0), 2.0, triple)->objective(m).value,
              3 * makePublishedStandGoal(square(1.0), 2.0, kPublished)->objective(m).value, 1e-12);
}

TEST(StandGoal, IsReachedExactlyAboveTheContactArea) {
  for (const ContactArea& area : {square(1.0), ellipse(0.5, 0.5)}) {
    const auto verdict = makeStandVerdict(area, 1.0);
    for (const double x : {0.0, 0.3, 0.49}) EXPECT_TRUE(verdict->isReached(bodyAt({x, 0, 0.6})));
    for (const double x : {0.51, 2.0}) EXPECT_FALSE(verdict->isReached(bodyAt({x, 0, 0.6})));
  }
}

TEST(PublishedStandGoal, HasConstraintsThatImplyStandingWithAMargin) {
  // Whatever satisfies the constraints stands; what is beyond the area violates them.
  Random random(17);
  for (const ContactArea& area : {square(0.8), ellipse(0.5, 0.25)}) {
    const auto goal = makePublishedStandGoal(area, 1.0, kPublished);
    const auto verdict = makeStandVerdict(area, 1.0);
    int feasible = 0;
    for (int trial = 0; trial < 300; ++trial) {
      const Moments m = bodyAt({0.6 * random(), 0.6 * random(), 0.5 + 0.4 * random()});
      const bool holds = goal->inequalities(m).values.maxCoeff() <= 0.0;
      feasible += holds ? 1 : 0;
      if (holds) {
        EXPECT_GT(number(described(*verdict, m), "tip_angle_after"), 0.0);
      }
      if (!verdict->isReached(m)) {
        EXPECT_GT(goal->inequalities(m).values.maxCoeff(), 0.0);
      }
    }
    EXPECT_GT(feasible, 20); // else nothing was tested
    EXPECT_LT(feasible, 280);
  }
}

TEST(PublishedStandGoal, NeedsTheCentreOfMassAboveTheGround) {
  const auto goal = makePublishedStandGoal(square(1.0), 1.0, kPublished);
  EXPECT_GT(goal->inequalities(bodyAt({0, 0, -0.1})).values.maxCoeff(), 0.0);
  EXPECT_LE(goal->inequalities(bodyAt({0, 0, 0.1})).values.maxCoeff(), 0.0);
}

TEST(StandGoal, ReportsTheTippingAngle) {
  const auto verdict = makeStandVerdict(square(1.0), 1.0);
  const Report stands = described(*verdict, bodyAt({0, 0, 0.5}));
  EXPECT_NEAR(number(stands, "tip_angle_after"), 45.0, 1e-9);
  EXPECT_TRUE(truth(stands, "stands_after"));
  const Report falls = described(*verdict, bodyAt({1.0, 0, 0.5}));
  EXPECT_NEAR(number(falls, "tip_angle_after"), -45.0, 1e-9);
  EXPECT_FALSE(truth(falls, "stands_after"));
}

/// A 100 × 60 foot whose first corner is rounded by an arc of so many segments, as shares of 100.
ContactArea footWithArc(int segments) {
  constexpr double kRadius = 0.4;
  ContactArea foot{{{0.5, -0.3}, {0.5, 0.3}, {-0.5, 0.3}}, {}};
  for (int i = 0; i <= segments; ++i) {
    const double t = kPi * (1.0 + 0.5 * i / segments);
    foot.polygon.emplace_back(-0.5 + kRadius + kRadius * std::cos(t),
                              -0.3 + kRadius + kRadius * std::sin(t));
  }
  return foot;
}

/// By how much the centre of mass is beyond the edges, each moved inwards by a tenth of its
/// distance from the origin; negative within all of them.
double beyondEveryEdge(const ContactArea& area, const Vec2& c) {
  double most = -1.0;
  for (std::size_t i = 0; i < area.polygon.size(); ++i) {
    const Vec2 p = area.polygon[i];
    const Vec2 edge = area.polygon[(i + 1) % area.polygon.size()] - p;
    const Vec2 normal = Vec2(edge.y(), -edge.x()).normalized();
    most = std::max(most, normal.dot(c - 0.9 * p));
  }
  return most;
}

TEST(PublishedStandGoal, HasTheConstraintsOfAllEdgesHoweverManyCornersAFootHas) {
  Random random(29);
  for (const int segments : {20, 60, 200, 2000}) {
    const ContactArea foot = footWithArc(segments);
    const auto goal = makePublishedStandGoal(foot, 1.0, kPublished);
    // The solver's time grows with the constraints; with so few it is that of its evaluations.
    EXPECT_LE(goal->inequalities(bodyAt({0, 0, 0.5})).values.size(), 66) << segments;
    for (int trial = 0; trial < 200; ++trial) {
      const Vec3 c(0.7 * random(), 0.5 * random(), 0.5);
      EXPECT_NEAR(largestViolation(*goal, bodyAt(c)),
                  std::max(0.0, beyondEveryEdge(foot, c.head<2>())), 1e-12)
          << segments << " segments, " << c.transpose();
    }
    expectGradientsMatch(*goal, bodyAt({-0.41, -0.29, 0.5}));
    expectGradientsMatch(*goal, bodyAt({0.1, 0.05, 0.5}));
  }
}

TEST(PublishedStandGoal, KeepsManyCornersOfARoundFoot) {
  ContactArea round;
  for (int i = 0; i < 1000; ++i) {
    const double t = 2 * kPi * i / 1000;
    round.polygon.emplace_back(0.3 * std::cos(t), 0.3 * std::sin(t));
  }
  const auto goal = makePublishedStandGoal(round, 1.0, kPublished);
  for (int i = 0; i < 64; ++i) {
    const double t = 0.1 * i;
    for (const double r : {0.2, 0.3}) {
      // Within the inscribed and the circumscribed circle: 0.27 π²/2e6 apart.
      const double beyond = largestViolation(*goal, bodyAt({r * std::cos(t), r * std::sin(t), 1}));
      EXPECT_NEAR(beyond, std::max(0.0, r - 0.27), 2e-6);
    }
  }
}

TEST(StandVerdict, TellsTheDistanceFromThePolygon) {
  // The square of 20 ends at 10.
  const auto verdict = makeStandVerdict(square(1.0), 20.0);
  const auto told = [&](const Vec3& c) { return verdict->worstViolation(bodyAt(c / 20.0)); };
  EXPECT_NE(told({12, 2, 5}).find("lies 2 outside"), std::string::npos) << told({12, 2, 5});
  // Beyond a corner: 3, 4, 5.
  EXPECT_NE(told({13, -14, 5}).find("lies 5 outside"), std::string::npos) << told({13, -14, 5});
}

TEST(StandVerdict, TellsTheDistanceFromTheEllipse) {
  const auto verdict = makeStandVerdict(ellipse(0.5, 0.25), 20.0);
  const auto told = [&](const Vec3& c) {
    const std::string sentence = verdict->worstViolation(bodyAt(c / 20.0));
    const std::string words = "the centre of mass lies ";
    EXPECT_EQ(sentence.rfind(words, 0), 0U) << sentence;
    return std::stod(sentence.substr(words.size()));
  };
  // Golden sections find the direction to half of 16 digits, the sentence has 9.
  EXPECT_NEAR(told({15, 0, 5}), 5.0, 1e-6);
  EXPECT_NEAR(told({0, -6, 5}), 1.0, 1e-6);
  // From a point along the normal of another one: it is the nearest.
  const double t = 0.7;
  const Vec2 onEllipse(10 * std::cos(t), 5 * std::sin(t));
  const Vec2 normal = Vec2(std::cos(t) / 10, std::sin(t) / 5).normalized();
  const Vec2 c = onEllipse + 3.0 * normal;
  EXPECT_NEAR(told({c.x(), c.y(), 5}), 3.0, 1e-6);
}

std::unique_ptr<Goal> spinGoal(const Moments& solid, const Weights& weights = kPublished) {
  return makeSpinGoal(solid, weights);
}

/// As fast as a machine spins it, lengths in metres: the tests' bodies are of order one.
constexpr double kMetre = 1000.0;
constexpr double kFast = 1e5;

std::unique_ptr<Verdict> spinVerdict(const Moments& solid) {
  return makeSpinVerdict(solid, Vec2::Zero(), kMetre, kFast);
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
  const Moments m = standingBox({1.0, 0.9, 0.1});
  const TriangleMesh turned =
      transformed(transformed(box({1.0, 0.9, 0.1}, 1), Mat3::Identity(), {0, 0, 0.15}),
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
  const Moments upright = standingBox({1.0, 0.8, 0.2});
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
  const Report report = described(*makeSpinVerdict(solid, Vec2::Zero(), 200.0, kFast), solid);
  EXPECT_NEAR(number(report, "axis_offset_after"), 0.05 * 200.0, 1e-9);
  EXPECT_NEAR(number(report, "axis_tilt_after"), 0.2 * 180 / std::acos(-1.0), 1e-9);

  const Moments upright = standingBox(s);
  const Report straight = described(*spinVerdict(upright), upright);
  const double axial = s.x() * s.x() + s.y() * s.y();
  EXPECT_NEAR(number(straight, "moment_ratio_a_after"), axial / (s.x() * s.x() + s.z() * s.z()),
              1e-9);
  EXPECT_NEAR(number(straight, "moment_ratio_b_after"), axial / (s.y() * s.y() + s.z() * s.z()),
              1e-9);
}

/// A box whose centre is `height` above the ground, the tip.
Moments boxOnTip(const Vec3& size, double height) {
  return momentsOf(transformed(box(size, 1), Mat3::Identity(), {0, 0, height}));
}

TEST(SpinGoal, IsReachedAboutTheLargestAndTheSmallestMomentOnTheTipButNotTheMiddleOne) {
  // About the centre the third one has its middle moment upright; on a tip below it is the least.
  struct Case {
    Vec3 size;
    double height;
    bool spins;
  };
  for (const Case& c : {Case{{1.0, 0.8, 0.3}, 0.16, true}, Case{{0.3, 0.4, 1.0}, 0.6, true},
                        Case{{1.0, 0.3, 0.6}, 0.4, true}, Case{{1.0, 0.3, 0.6}, 0.05, false}}) {
    const Moments m = boxOnTip(c.size, c.height);
    EXPECT_EQ(spinVerdict(m)->isReached(m), c.spins) << c.size.transpose();
    EXPECT_EQ(largestViolation(*spinGoal(m), m) < 1e-12, c.spins) << c.size.transpose();
    const Report report = described(*spinVerdict(m), m);
    const bool hasSpeed =
        std::any_of(report.entries.begin(), report.entries.end(),
                    [](const auto& entry) { return entry.first == "sleeping_speed_after"; });
    EXPECT_EQ(hasSpeed, c.spins);
  }
}

TEST(SpinGoal, AsksForAMomentThatIsNotBetweenTheOtherTwoOnTheTip) {
  // (C − A)(C − B)/C² of a box, A and B with the square of the tip's distance; turned about its
  // axis it stays the same.
  const Vec3 s(1.0, 0.3, 0.6);
  const double height = 0.05;
  const double A = (s.y() * s.y() + s.z() * s.z()) / 12 + height * height;
  const double B = (s.x() * s.x() + s.z() * s.z()) / 12 + height * height;
  const double C = (s.x() * s.x() + s.y() * s.y()) / 12;
  const Moments m = boxOnTip(s, height);
  const Moments turned = momentsOf(transformed(transformed(box(s, 1), rotation(Vec3::UnitZ(), 0.7)),
                                               Mat3::Identity(), {0, 0, height}));
  for (const Moments& body : {m, turned}) {
    EXPECT_NEAR(spinGoal(m)->inequalities(body).values[1], 1e-4 - (C - A) * (C - B) / (C * C),
                1e-12);
  }
}

TEST(RelaxedGoals, AskForTheSameButAMomentThatIsNotBetweenTheOtherTwo) {
  const Moments m = boxOnTip({1.0, 0.3, 0.6}, 0.05);
  const auto spin = spinGoal(m);
  const auto yoYo = makeYoYoGoal(m, kPublished, {0, 0, 0.05});
  for (const Goal* goal : {spin.get(), yoYo.get()}) {
    const std::unique_ptr<Goal> relaxed = goal->relaxed();
    ASSERT_TRUE(relaxed);
    EXPECT_EQ(relaxed->objective(m).value, goal->objective(m).value);
    EXPECT_EQ(relaxed->equalities(m).values, goal->equalities(m).values);
    EXPECT_GT(largestViolation(*goal, m), 0.01);
    EXPECT_LT(largestViolation(*relaxed, m), 1e-12);
    expectGradientsMatch(*relaxed, m);
  }
  EXPECT_FALSE(makeStandGoal(square(1.0), kPublished)->relaxed());
}

TEST(SpinGoal, ReportsTheSpeedFromWhichItSleeps) {
  // A disc of 40 × 5 mm, 20 mm above its tip: 2 sqrt(g h (I_a/m + h²))/(I_zz/m).
  const TriangleMesh disc = revolved({{0, 2.5}, {20, 2.5}, {20, -2.5}, {0, -2.5}}, 400);
  const Moments m = momentsOf(transformed(disc, Mat3::Identity(), {0, 0, 20}));
  const double across = 400 / 4.0 + 25 / 12.0 + 400;
  const double expected = 2 * std::sqrt(9806.65 * 20 * across) / 200 * 30 / std::acos(-1.0);
  const auto verdict = [&](double rpm) { return makeSpinVerdict(m, Vec2::Zero(), 1.0, rpm); };
  const double told = number(described(*verdict(1000), m), "sleeping_speed_after");
  EXPECT_NEAR(told, expected, 1e-3 * expected); // a circle of 400 corners
  EXPECT_TRUE(verdict(told + 1)->isReached(m));
  EXPECT_FALSE(verdict(told - 1)->isReached(m));
  EXPECT_EQ(verdict(500)->whatIsMissed(m), "it stays upright only above " +
                                               std::to_string(int(std::ceil(told))) +
                                               " rpm, and a hand gives it 500 (spin_speed)");
  // Four times as large: half the speed.
  const double large =
      number(described(*makeSpinVerdict(m, Vec2::Zero(), 4.0, 1000), m), "sleeping_speed_after");
  EXPECT_NEAR(large, told / 2, 1e-9 * told);
}

TEST(SpinGoal, IsNotReachedOffTheAxis) {
  const Moments m = translated(standingBox({1.0, 0.8, 0.2}), {0.01, 0, 0});
  EXPECT_FALSE(spinVerdict(m)->isReached(m));
}

TEST(SpinGoal, TurnsAboutTheGivenAxis) {
  const Moments m = standingBox({1.0, 0.8, 0.2});
  const Vec2 axis(0.2, -0.1);
  const auto goal = makeSpinGoal(m, kPublished, axis);
  const auto verdict = makeSpinVerdict(m, axis, kMetre, kFast);
  EXPECT_NEAR(goal->objective(m).value, spinGoal(m)->objective(m).value, 1e-12);
  EXPECT_LT(largestViolation(*goal, translated(m, {0.2, -0.1, 0})), 1e-12);
  EXPECT_FALSE(verdict->isReached(m));
  EXPECT_TRUE(verdict->isReached(translated(m, {0.2, -0.1, 0})));
  expectGradientsMatch(*goal, 20 * m);
}

TEST(SpinVerdict, NamesTheConstraintThatIsViolatedMost) {
  const Moments upright = standingBox({1.0, 0.8, 0.3});
  const auto goal = makeSpinGoal(upright, kPublished);
  const auto verdict = makeSpinVerdict(upright, Vec2::Zero(), 100.0, kFast);
  const auto told = [&](const Moments& m) { return verdict->worstViolation(m); };
  EXPECT_EQ(told(translated(upright, {0.03, -0.04, 0})), "the centre of mass lies 5 off the axis");
  const TriangleMesh leaning =
      transformed(transformed(box({1.0, 0.8, 0.3}, 1), rotation({1, 0, 0}, 0.3)), Mat3::Identity(),
                  {0.001, 0, 0.5});
  EXPECT_GT(goal->equalities(momentsOf(leaning)).values.tail<2>().norm(), 0.001);
  EXPECT_EQ(told(momentsOf(leaning)).find("the products of inertia"), 0U);
  // The centre of the box is 0.25 high.
  EXPECT_EQ(told(translated(upright, {0.03, 0.04, -0.45})),
            "the centre of mass lies 20 below the end of the axis on the ground");
}

TEST(YoYoVerdict, NamesTheConstraintThatIsViolatedMost) {
  const Moments m = standingBox({1.0, 0.9, 0.4});
  const auto verdict = makeYoYoVerdict(m, {0, 0, 0.3}, 100.0);
  EXPECT_EQ(verdict->worstViolation(translated(m, {0.03, 0.04, -0.02})),
            "the centre of mass lies 5 off the axis");
  EXPECT_EQ(verdict->worstViolation(translated(m, {0.03, 0.04, -0.35})),
            "the centre of mass lies 35 off the middle of the axle");
}

TEST(YoYoGoal, HasTheGradientsOfItsValues) {
  const Moments solid = momentsOf(transformed(blob(5), someRotation(), {0.2, -0.1, 0.7}));
  expectGradientsMatch(*makeYoYoGoal(solid, kPublished, {0.1, 0.2, 0.5}), solid);
}

TEST(YoYoGoal, IsNotReachedAboutTheMiddleMomentOfTheCentre) {
  const Moments m = boxOnTip({1.0, 0.3, 0.6}, 0.4);
  const auto goal = makeYoYoGoal(m, kPublished, {0, 0, 0.4});
  EXPECT_FALSE(makeYoYoVerdict(m, {0, 0, 0.4}, 1.0)->isReached(m));
  const double A = 0.45;
  const double B = 1.36;
  const double C = 1.09;
  EXPECT_NEAR(largestViolation(*goal, m), 1e-4 + (C - A) * (B - C) / (C * C), 1e-12);
  EXPECT_EQ(makeYoYoVerdict(m, {0, 0, 0.4}, 1.0)->worstViolation(m).rfind("it has its middle", 0),
            0U);
}

TEST(SpinAndYoYoGoal, AskForMoreThanBarelyTheGreatestMoment) {
  const auto isNamed = [](const Verdict& verdict, const Moments& m) {
    return verdict.worstViolation(m).rfind("its moment of inertia about the axis is barely", 0) ==
           0;
  };
  // Of a box of the width 1, the depth y and the height z the moments are as y² + z², 1 + z² and,
  // about the vertical, 1 + y².
  const double z = 0.6;
  for (const auto& [y, isEnough] : {std::pair(0.6002, false), std::pair(0.61, true)}) {
    const Moments m = boxOnTip({1.0, y, z}, 0.3);
    const auto verdict = makeYoYoVerdict(m, {0, 0, 0.3}, 1.0);
    EXPECT_TRUE(verdict->isReached(m));
    const double missing = 1e-4 - (1.0 - z * z) * (y * y - z * z) / ((1.0 + y * y) * (1.0 + y * y));
    EXPECT_EQ(missing <= 0.0, isEnough);
    EXPECT_NEAR(largestViolation(*makeYoYoGoal(m, kPublished, {0, 0, 0.3}), m),
                std::max(0.0, missing), 1e-12);
    EXPECT_EQ(isNamed(*verdict, m), !isEnough);
  }
  // On a tip below the middle by h those across are greater by 12 h².
  const double h = 0.1;
  const double less = 2.0 * h * 2.0 * h + 12.0 * h * h;
  const double excess = 1e-4;
  const Moments m = boxOnTip({1.0, std::sqrt(less + excess), 2.0 * h}, h);
  const double vertical = 1.0 + less + excess;
  EXPECT_NEAR(largestViolation(*spinGoal(m), m),
              1e-4 - (1.0 - less) * excess / (vertical * vertical), 1e-12);
  EXPECT_TRUE(isNamed(*spinVerdict(m), m)) << spinVerdict(m)->worstViolation(m);
}

TEST(YoYoGoal, IsReachedWithTheCentreInTheMiddleOfTheAxleOnly) {
  const Moments m = standingBox({1.0, 0.9, 0.4}); // its middle at 0.3
  const auto goal = makeYoYoGoal(m, kPublished, {0, 0, 0.3});
  const auto verdict = makeYoYoVerdict(m, {0, 0, 0.3}, 100.0);
  EXPECT_TRUE(verdict->isReached(m));
  EXPECT_LT(largestViolation(*goal, m), 1e-12);
  const Moments high = translated(m, {0, 0, 0.02});
  EXPECT_FALSE(verdict->isReached(high));
  EXPECT_NEAR(largestViolation(*goal, high), 0.02, 1e-12);
  EXPECT_NEAR(number(described(*verdict, high), "middle_offset_after"), 2.0, 1e-9);
  EXPECT_TRUE(truth(described(*verdict, high), "spins_after"));
  EXPECT_NEAR(goal->objective(high).value, goal->objective(m).value, 1e-12); // no height in it
}

TEST(StandEmptyAndFilledGoal, IsTheWorstOfAllStates) {
  const TriangleMesh outer = transformed(box({1, 1, 2}, 1), Mat3::Identity(), {0, 0, 1});
  const TriangleMesh cavity = transformed(box({0.5, 0.6, 0.7}, 1), Mat3::Identity(), {0.2, 0, 1.5});
  const auto stand = makeStandGoal(square(1.0), kPublished);
  const double filling = 0.7;
  const std::vector<Moments> states = filledMoments(momentsOf(outer), cavity.vertices, cavity.faces,
                                                    {{}, {filling}, {filling, 1.5}});
  double worst = -std::numeric_limits<double>::infinity();
  double least = std::numeric_limits<double>::infinity();
  for (const Moments& state : states) {
    worst = std::max(worst, stand->objective(state).value);
    least = std::min(least, *stand->measure(state));
  }
  const double objective = momentObjective(*stand, kPublished, states, 1.0);
  EXPECT_GE(objective, worst);
  EXPECT_LE(objective, worst + std::log(3.0) / 70.0);
  EXPECT_EQ(measure(*stand, states), least);
  const auto verdict = makeStandEmptyAndFilledVerdict(square(1.0), momentsOf(outer), filling, 1.0);
  const Report report = described(*verdict, states[0]);
  EXPECT_NEAR(number(report, "tip_angle_empty_after"), *stand->measure(states[0]), 1e-9);
  EXPECT_NEAR(number(report, "tip_angle_filled_after"), *stand->measure(states[1]), 1e-9);
}

TEST(StandEmptyAndFilledGoal, NeedsBothStates) {
  // Empty the centre is above the foot; the filling pulls it over.
  const Moments outer = bodyAt({0.4, 0, 1.0}, 1.0);
  const Moments empty = bodyAt({0.1, 0, 1.0}, 0.5);
  EXPECT_TRUE(makeStandVerdict(square(0.5), 1.0)->isReached(empty));
  const auto verdict = makeStandEmptyAndFilledVerdict(square(0.5), outer, 1.0, 1.0);
  EXPECT_FALSE(verdict->isReached(empty));
  EXPECT_NE(verdict->worstViolation(empty).find("filled"), std::string::npos);
}

TEST(FloatGoal, HasTheGradientsOfItsValues) {
  const TriangleMesh hull = transformed(blob(5), someRotation(), {0.2, -0.1, 1.2});
  for (const double level : {0.3, 1.0}) {
    expectGradientsMatch(*makeFloatGoal(hull.vertices, hull.faces, level, 0.8, kPublished),
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
    const auto goal = makeFloatGoal(b.vertices, b.faces, s, 1.0, kPublished);
    const auto verdict = makeFloatVerdict(b.vertices, b.faces, s, 1.0, 100.0);
    const Moments m = s * momentsOf(b);
    EXPECT_LT(largestViolation(*goal, m), 1e-12);
    EXPECT_TRUE(verdict->isReached(m));
    const Report report = described(*verdict, m);
    EXPECT_NEAR(number(report, "draught_after"), 50 * s, 1e-9);
    EXPECT_NEAR(number(report, "heel_angle_after"), 0, 1e-6);
    EXPECT_NEAR(number(report, "metacentric_height_after"),
                100 * (0.64 / (12 * s * 0.5) - 0.25 * (1 - s)), 1e-7);
    EXPECT_NEAR(number(report, "metacentric_height_long_after"),
                100 * (1 / (12 * s * 0.5) - 0.25 * (1 - s)), 1e-7);
    EXPECT_NEAR(number(report, "reserve_buoyancy_after"), 1 - s, 1e-12);
    // Heavier, aside, or top-heavy beyond the metacentre it fails.
    EXPECT_NEAR(goal->equalities(1.1 * m).values[0], 0.1 * s, 1e-12);
    EXPECT_FALSE(verdict->isReached(1.1 * m));
    EXPECT_FALSE(verdict->isReached(translated(m, {0.05, 0, 0})));
    EXPECT_GT(goal->inequalities(translated(m, {0, 0, 0.5})).values[0], 0.0);
    EXPECT_FALSE(verdict->isReached(translated(m, {0, 0, 0.5})));
  }
}

TEST(FloatGoal, UnderWaterNeedsNeutralWeightAndALowCentre) {
  const TriangleMesh ball = transformed(sphere(8), Mat3::Identity(), {0, 0, 1});
  const auto goal = makeFloatGoal(ball.vertices, ball.faces, 1.0, 0.8, kPublished);
  const auto verdict = makeFloatVerdict(ball.vertices, ball.faces, 1.0, 0.8, 1.0);
  const double neutral = 0.8 * momentsOf(ball)[0];
  const double middle = momentsOf(ball)[3] / momentsOf(ball)[0];
  EXPECT_TRUE(verdict->isReached(bodyAt({0, 0, middle - 0.1}, neutral)));
  EXPECT_LT(largestViolation(*goal, bodyAt({0, 0, middle - 0.1}, neutral)), 1e-9);
  EXPECT_FALSE(verdict->isReached(bodyAt({0, 0, middle + 0.1}, neutral)));
  EXPECT_GT(largestViolation(*goal, bodyAt({0, 0, middle + 0.1}, neutral)), 0.05);
  EXPECT_FALSE(verdict->isReached(bodyAt({0, 0, middle - 0.1}, 1.01 * neutral)));
  EXPECT_FALSE(verdict->isReached(bodyAt({0, 0, middle - 0.1}, 0.99 * neutral)));
}

TEST(FloatGoal, RefusesAWaterlineBelowWhichThereIsNothing) {
  const TriangleMesh b = groundedBox();
  for (const double level : {1e-30, 1e-8}) {
    try {
      makeFloatGoal(b.vertices, b.faces, level, 1.0, kPublished);
      FAIL() << "a body cannot float " << level << " of its height deep";
    } catch (const InvalidInput& e) {
      EXPECT_NE(std::string(e.what()).find("raise water_level"), std::string::npos);
    }
  }
  EXPECT_TRUE(std::isfinite(largestViolation(
      *makeFloatGoal(b.vertices, b.faces, 1e-5, 1.0, kPublished), 0.3 * momentsOf(b))));
}

TEST(HangGoal, HasTheGradientsOfItsValues) {
  const Moments m = momentsOf(transformed(blob(5), someRotation(), {0.2, -0.1, 0.7}));
  expectGradientsMatch(*makeHangGoal({0.1, 0.2, 2.0}, kPublished), m);
}

TEST(HangGoal, FindsTheAngleOfAnLShape) {
  // Two bars of 1 × 1 and 3 × 1 cells, hung from the corner: c = (1.25, 0.75) of the L whose cells
  // are (0,0), (1,0), (2,0), (0,1); from the top left corner (0, 2) it hangs off by
  // atan(1.25 / (2 − 0.75)) = 45°.
  const TriangleMesh cells = polycube({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 1}}, 2);
  const Moments m = translated(momentsOf(cells), {0, -0.5, 0});
  const auto goal = makeHangGoal({0, 0, 2}, kPublished);
  const auto verdict = makeHangVerdict({0, 0, 2}, 10.0);
  const Report report = described(*verdict, m);
  EXPECT_NEAR(number(report, "hanging_angle_after"), 45.0, 1e-9);
  EXPECT_NEAR(number(report, "hanging_depth_after"), 12.5, 1e-9);
  EXPECT_FALSE(verdict->isReached(m));
  EXPECT_NEAR(largestViolation(*goal, m), 1.25, 1e-12);
  EXPECT_TRUE(makeHangVerdict({1.25, 0, 2}, 10.0)->isReached(m));
  EXPECT_LT(largestViolation(*makeHangGoal({1.25, 0, 2}, kPublished), m), 1e-12);
}

TEST(HangGoal, IsNotReachedWithTheCentreAboveThePoint) {
  const auto goal = makeHangGoal({0, 0, 0.5}, kPublished);
  const auto verdict = makeHangVerdict({0, 0, 0.5}, 1.0);
  EXPECT_FALSE(verdict->isReached(bodyAt({0, 0, 0.6})));
  EXPECT_NEAR(number(described(*verdict, bodyAt({0, 0, 0.6})), "hanging_angle_after"), 180, 1e-6);
  EXPECT_GT(largestViolation(*goal, bodyAt({0, 0, 0.6})), 0.1);
}

TEST(MassGoal, HasTheGradientsOfItsValues) {
  const Moments m = momentsOf(blob(5));
  expectGradientsMatch(*makeMassGoal(m[0], 0.4 * m[0], kPublished), m);
  expectGradientsMatch(*makeMassGoal(m[0], std::nullopt, kPublished), m);
}

TEST(MassGoal, MeasuresInGrams) {
  const auto goal = makeMassGoal(2.0, 1.0, kPublished);
  const auto verdict = makeMassVerdict(1.0, 30.0);
  EXPECT_NEAR(goal->objective(bodyAt({0, 0, 0}, 1.5)).value, 0.0625, 1e-12);
  EXPECT_NEAR(number(described(*verdict, bodyAt({0, 0, 0}, 1.5)), "mass_error_after"), 15.0, 1e-9);
  EXPECT_FALSE(verdict->isReached(bodyAt({0, 0, 0}, 1.5)));
  EXPECT_TRUE(verdict->isReached(bodyAt({0, 0, 0}, 1.0)));
  EXPECT_NE(verdict->worstViolation(bodyAt({0, 0, 0}, 1.5)).find("15 g too large"),
            std::string::npos);
}

TEST(MassGoal, WithoutATargetPrefersTheLighterBody) {
  const auto goal = makeMassGoal(2.0, std::nullopt, kPublished);
  EXPECT_EQ(largestViolation(*goal, bodyAt({0, 0, 0}, 1.5)), 0.0);
  EXPECT_LT(goal->objective(bodyAt({0, 0, 0}, 0.5)).value,
            goal->objective(bodyAt({0, 0, 0}, 1.5)).value);
}

} // namespace
} // namespace massprops::testing
