// Roll upright: what the objective promises, and what no cavity can change.
#include "core/goals/roll_upright.h"

#include "cells.h"
#include "core/optimum/achievable_centres.h"
#include "core/physics/rolling_metacentres.h"
#include "core/pipeline.h"
#include "goals/goal_checks.h"
#include "large_test.h"
#include "samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace massprops::testing {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// A tumbler of diagonal about 1, standing on z = 0: its round foot has its centre at 0.3.
TriangleMesh tumbler(int segments = 160) {
  return transformed(capsule(0.3, 0.3, segments), Mat3::Identity(), {0, 0, 0.45});
}

double objectiveAt(const Goal& goal, const Vec3& centre) {
  return goal.objective(bodyAt(centre)).value;
}

int facesOf(const Verdict& verdict, const Vec3& centre) {
  return std::get<int>(described(verdict, bodyAt(centre)).at("resting_faces_after"));
}

TEST(RollUprightGoal, CountsTheRestingFaces) {
  // A tumbler with its centre of mass above and below the centre of its round foot.
  const auto verdict = makeRollUprightVerdict({}, tumbler().vertices);
  EXPECT_TRUE(verdict->isReached(bodyAt({0, 0, 0.2})));
  EXPECT_FALSE(verdict->isReached(bodyAt({0, 0, 0.45})));
  EXPECT_EQ(facesOf(*verdict, {0, 0, 0.2}), 1);
}

TEST(RollUprightGoal, HasTheGradientsOfItsValues) {
  for (const TriangleMesh& mesh : {tumbler(), box({0.3, 0.4, 0.6}, 1)}) {
    const auto goal = makeRollUprightGoal(mesh.vertices, {});
    // Its third derivatives are those of a sharp maximum, 1e5 to 1e6.
    const double h = 5e-7;
    expectGradientsMatch(*goal, bodyAt({0.01, 0.02, 0.2}), h);
    expectGradientsMatch(*goal, bodyAt({-0.001, 0.003, 0.4}), h);
  }
  Weights doubled;
  doubled.centerOfMass = 2.0;
  EXPECT_NEAR(objectiveAt(*makeRollUprightGoal(tumbler().vertices, doubled), {0, 0, 0.2}),
              2.0 * objectiveAt(*makeRollUprightGoal(tumbler().vertices, {}), {0, 0, 0.2}), 1e-12);
}

TEST(RollUprightGoal, IsTheHeightAboveTheMiddleOfABall) {
  // All metacentres of a ball are its middle.
  const TriangleMesh ball = sphere(40);
  const RollingMetacentres rolling = rollingMetacentres(ball.vertices);
  // A facet's sagitta of 1.5e-4 over the step's rise, 2 sin ϑ sin 2° of at least 0.0024.
  EXPECT_LT(rolling.heights.cwiseAbs().maxCoeff(), 0.07);
  const auto goal = makeRollUprightGoal(ball.vertices, {});
  EXPECT_NEAR(objectiveAt(*goal, {0, 0, 0.1}) - objectiveAt(*goal, {0, 0, -0.2}), 0.3, 1e-9);
  // Where c is below the middle by d and aside by x it rests at atan(x/d): reached within 2°.
  const auto verdict = makeRollUprightVerdict({}, ball.vertices);
  for (const double tilt : {1.0, 3.0}) {
    const Vec3 c(0.3 * std::tan(tilt * kPi / 180), 0, -0.3);
    EXPECT_EQ(verdict->isReached(bodyAt(c)), tilt < 2.0);
    EXPECT_EQ((rolling.slopes * c.head<2>() - rolling.heights).maxCoeff() + c.z() < 0.05,
              tilt < 2.0);
  }
}

TEST(RollUprightGoal, IsConvexInTheCentreOfMass) {
  const auto goal = makeRollUprightGoal(blob(8).vertices, {});
  Random random(5);
  for (int trial = 0; trial < 200; ++trial) {
    const Vec3 a = 0.3 * random.vector();
    const Vec3 b = 0.3 * random.vector();
    EXPECT_LE(objectiveAt(*goal, 0.5 * (a + b)),
              0.5 * (objectiveAt(*goal, a) + objectiveAt(*goal, b)) + 1e-9);
  }
}

/// Round below, anything above: tumblers of random shapes.
TriangleMesh roundedBelow(Random& random, int frequency) {
  const Vec3 stretch = 0.25 * (random.vector().array() + 2.0).matrix();
  const Vec3 lean = 0.1 * random.vector();
  return starShaped(
      [&](const Vec3& u) {
        const double up = std::max(0.0, u.z() + 0.3);
        return 0.4 * (1.0 + up * up * (stretch.z() + lean.dot(u) + 0.1 * std::sin(5.0 * u.x())));
      },
      frequency);
}

TEST(RollUprightGoal, IsBelowZeroOnlyForBodiesWithOneRestingFace) {
  Random random(17);
  int below = 0;
  for (int trial = 0; trial < 6; ++trial) {
    const TriangleMesh mesh = roundedBelow(random, 32);
    const auto goal = makeRollUprightGoal(mesh.vertices, {});
    const auto verdict = makeRollUprightVerdict({}, mesh.vertices);
    for (int i = 0; i < 20; ++i) {
      const Vec3 c(0.003 * random(), 0.003 * random(), -0.35 * std::abs(random()));
      if (objectiveAt(*goal, c) > 0.0) continue;
      ++below;
      EXPECT_TRUE(verdict->isReached(bodyAt(c))) << c.transpose();
    }
  }
  EXPECT_GT(below, 20);
}

TEST(RollUprightGoal, KnowsWhenNoCentreOfMassCan) {
  const TriangleMesh mesh = tumbler(120);
  const auto goal = makeRollUprightGoal(mesh.vertices, {});
  const Moments lying = bodyAt({0, 0, 0.45});
  // Centres between two heights, on the axis within a tenth.
  const auto slab = [](double low, double high) {
    HalfSpaces set{Points(6, 3), Vector(6)};
    set.normals << Mat3::Identity(), -Mat3::Identity();
    set.limits << 0.1, 0.1, high, 0.1, 0.1, -low;
    return [set] { return set; };
  };
  const auto needed = goal->noneCan(lying, slab(0.35, 0.6)); // above the middle of the foot, 0.3
  ASSERT_TRUE(needed);
  // It names what will do, wider if possible: that centres are not lower, at least.
  EXPECT_LE(needed->limits.size(), 6);
  EXPECT_TRUE(needed->contain(Vec3(0, 0, 0.35)));
  EXPECT_FALSE(needed->contain(Vec3(0, 0, 0.3)));
  EXPECT_TRUE(goal->noneCan(lying, [&] { return *needed; }));
  EXPECT_FALSE(goal->noneCan(lying, slab(0.2, 0.6)));
  EXPECT_FALSE(goal->noneCan(bodyAt({0, 0, 0.15}), slab(0.35, 0.6))); // there is one that does
}

TEST(AchievableCentres, HoldThoseOfAllHalfSpacesThatAreHollow) {
  const TriangleMesh cube = transformed(box({1, 1, 1}, 4), Mat3::Identity(), {0, 0, 0.5});
  const Moments solid = momentsOf(cube);
  const AdmissibleCells cells = cellsBehind({cube.vertices, cube.faces}, 0.05);
  for (const double filling : {0.0, 0.4, 3.0}) {
    const HalfSpaces centres = achievableCentres(solid, filling, cells);
    Random random(31);
    double slack = 1.0;
    for (int trial = 0; trial < 300; ++trial) {
      const Vec3 normal = random.vector();
      const double level = normal.dot(Vec3(0, 0, 0.5) + 0.3 * random.vector());
      Moments body = solid;
      for (Eigen::Index c = 0; c < cells.rows(); ++c) {
        const bool isAbove = normal.dot(cells.row(c).segment<3>(1)) > level * cells(c, 0);
        if (isAbove) body += (filling - 1.0) * cells.row(c).transpose();
      }
      const Vec3 centre = body.segment<3>(1) / body[0];
      EXPECT_TRUE(centres.contain(centre));
      slack = std::min(slack, (centres.limits - centres.normals * centre).minCoeff());
    }
    EXPECT_LT(slack, 5e-3); // and not many more
  }
}

TEST(AchievableCentres, OfABoxReachDownToThatOfTheBestSlab) {
  const TriangleMesh cube = transformed(box({1, 1, 1}, 4), Mat3::Identity(), {0, 0, 0.5});
  // Hollow above h: c_z = (1/2 − 0.81 (0.95² − h²)/2)/(1 − 0.81 (0.95 − h)).
  double lowest = 1.0;
  for (double h = 0.05; h < 0.95; h += 1e-4) {
    lowest = std::min(lowest, (0.5 - 0.405 * (0.9025 - h * h)) / (1 - 0.81 * (0.95 - h)));
  }
  const HalfSpaces centres =
      achievableCentres(momentsOf(cube), 0.0, cellsBehind({cube.vertices, cube.faces}, 0.05));
  EXPECT_FALSE(centres.contain(Vec3(0, 0, lowest - 4e-3)));
  EXPECT_TRUE(centres.contain(Vec3(0, 0, lowest)));
}

Report rolled(const TriangleMesh& model, double wall) {
  Options options;
  options.goal = GoalKind::RollUpright;
  options.innerLowerBound = wall;
  return optimizeMassProperties(model, options).report;
}

TEST(RollUpright, SaysWhetherAnyCavityCould) {
  LARGE_TEST();
  // A box has six resting faces whatever is in it.
  const Report box6 =
      rolled(transformed(roundedBox({10, 12, 15}, 1, 6, 2), Mat3::Identity(), {0, 0, 7.5}), 0.5);
  EXPECT_EQ(std::get<int>(box6.at("resting_faces_after")), 6);
  const std::string message = std::get<std::string>(box6.at("message"));
  EXPECT_NE(message.find("No cavity of any shape that keeps this wall can reach it."),
            std::string::npos)
      << message;
}

TEST(RollUpright, OfTheSampleIsReachedWithAThinWallAndProvenImpossibleWithAThickOne) {
  LARGE_TEST();
  const TriangleMesh model = sampleMesh("roly_poly");
  const double diagonal =
      (model.vertices.colwise().maxCoeff() - model.vertices.colwise().minCoeff()).norm();
  const Report thin = rolled(model, 0.01 * diagonal);
  EXPECT_TRUE(truth(thin, "solved"));
  EXPECT_EQ(std::get<int>(thin.at("resting_faces_after")), 1);
  const Report thick = rolled(model, 0.02 * diagonal);
  EXPECT_FALSE(truth(thick, "solved"));
  EXPECT_TRUE(truth(thick, "certified"));
  const std::string message = std::get<std::string>(thick.at("message"));
  EXPECT_NE(message.find("it can come to rest on " + toString(thick.at("resting_faces_after")) +
                         " different faces"),
            std::string::npos)
      << message;
  EXPECT_NE(message.find("No cavity of any shape that keeps this wall can reach it."),
            std::string::npos)
      << message;
}

} // namespace
} // namespace massprops::testing
