// The list of goals, and what is said about bodies that miss them.
#include "core/goals/registry.h"

#include "core/goals/float.h"
#include "core/goals/roll_upright.h"
#include "core/goals/spin.h"
#include "core/model/posed_model.h"
#include "core/model/solid.h"
#include "core/pipeline.h"
#include "goals/goal_checks.h"
#include "large_test.h"
#include "samples.h"
#include "shapes.h"
#include "translated_moments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace massprops::testing {
namespace {

TriangleMesh pillar() {
  return roundedBox({1, 1, 2}, 0.15, 6, 2);
}

Options optionsFor(GoalKind goal) {
  Options options;
  options.goal = goal;
  options.fillDensity = 0.5;
  options.targetMass = 1e-4;
  return options;
}

TEST(GoalRegistry, HasEveryGoalAtTheNumberThatScriptsStore) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < goalRegistry().size(); ++i) {
    const GoalEntry& entry = goalRegistry()[i];
    EXPECT_EQ(static_cast<std::size_t>(entry.kind), i) << entry.name;
    EXPECT_EQ(&goalEntry(entry.kind), &entry);
    EXPECT_EQ(goalNames()[i], entry.name);
    names.insert(entry.name);
  }
  EXPECT_EQ(names.size(), goalRegistry().size());
  EXPECT_THROW(goalEntry(static_cast<GoalKind>(goalRegistry().size())), InvalidInput);
}

TEST(GoalRegistry, CountsTheEqualities) {
  const PosedModel posed = makePosedModel(makeSolid(pillar()), {});
  const Moments solid = moments(posed.vertices, posed.faces);
  for (const GoalEntry& entry : goalRegistry()) {
    const auto goal = makeGoal(optionsFor(entry.kind), posed, posed.vertices);
    EXPECT_EQ(goal->equalities(solid).values.size(), entry.equalities) << entry.name;
  }
}

TEST(GoalRegistry, AsksForAsManyFunctionsAsThereAreEqualities) {
  for (const GoalEntry& entry : goalRegistry()) {
    Options options = optionsFor(entry.kind);
    options.basisSize = std::max(1, entry.equalities);
    EXPECT_NO_THROW(requireEnoughFunctions(options)) << entry.name;
    options.basisSize = entry.equalities - 1;
    if (entry.equalities == 0) continue;
    try {
      requireEnoughFunctions(options);
      ADD_FAILURE() << entry.name;
    } catch (const InvalidInput& e) {
      EXPECT_EQ(std::string(e.what()), "basis_k is " + std::to_string(options.basisSize) +
                                           ": the goal " + entry.name + " has to meet " +
                                           std::to_string(entry.equalities) +
                                           " conditions at once; give at least as many functions.");
    }
  }
}

TEST(GoalRegistry, TakesAnyPointOfTheAxisForSpin) {
  const TriangleMesh top = sampleMesh("tilted_ellipsoid_top");
  Options options = optionsFor(GoalKind::Spin);
  const auto valuesAt = [&](double height) {
    options.pivot = Vec3(1.0, 2.0, height);
    const PosedModel posed = makePosedModel(makeSolid(top), options);
    const Moments solid = moments(posed.vertices, posed.faces);
    return allValues(*makeGoal(options, posed, posed.vertices), solid);
  };
  const Vector atGround = valuesAt(top.vertices.col(2).minCoeff());
  for (const double height : {-30.0, 40.0, 200.0}) EXPECT_EQ(valuesAt(height), atGround);
}

/// A word about what is wrong with a body that is far too heavy and far off.
std::string complaint(GoalKind goal) {
  switch (goal) {
  case GoalKind::RollUpright:
    return "off upright";
  case GoalKind::Stand:
  case GoalKind::PublishedStand:
  case GoalKind::StandEmptyAndFilled:
    return "outside of the contact area";
  case GoalKind::Spin:
  case GoalKind::YoYo:
    return "off the axis";
  case GoalKind::Float:
    return "% too heavy";
  case GoalKind::Hang:
    return "off the plumb line";
  case GoalKind::Mass:
    return "g too large";
  }
  return "";
}

TEST(EveryVerdict, NamesTheViolatedConstraint) {
  LARGE_TEST();
  const PosedModel posed = makePosedModel(makeSolid(pillar()), {});
  const Moments body = bodyAt({0.4, 0.3, 0.4}, 10.0);
  for (const GoalEntry& entry : goalRegistry()) {
    const Options options = optionsFor(entry.kind);
    const auto goal = makeGoal(options, posed, posed.vertices);
    if (goal->measure(body) && !goal->conditions().empty()) {
      EXPECT_LT(levelReached(goal->conditions().front(), body), -0.1) << entry.name;
    } else if (entry.kind != GoalKind::RollUpright) { // has no constraints
      EXPECT_GT(largestViolation(*goal, body), 0.1) << entry.name;
    }
    const auto verdict = makeVerdict(options, posed, posed.vertices);
    EXPECT_FALSE(verdict->isReached(body)) << entry.name;
    const std::string told = verdict->worstViolation(body);
    ASSERT_FALSE(complaint(entry.kind).empty()) << entry.name;
    EXPECT_NE(told.find(complaint(entry.kind)), std::string::npos) << entry.name << ": " << told;
    EXPECT_FALSE(verdict->whatIsMissed(body).empty()) << entry.name;
  }
}

TEST(EveryVerdict, NamesWhatIsMissedWhereAllConstraintsHold) {
  LARGE_TEST();
  // Roll upright: in how many faces a box rests.
  const TriangleMesh cube = transformed(box({1, 1, 1}, 1), Mat3::Identity(), {0, 0, 0.5});
  const auto rolls = makeRollUprightVerdict(square(1.0), cube.vertices);
  EXPECT_EQ(rolls->whatIsMissed(bodyAt({0, 0, 0.5})),
            "it can come to rest on 6 different faces instead of one");

  // Spin: faster than a hand.
  const Moments rod = momentsOf(transformed(box({4, 4, 99}, 1), Mat3::Identity(), {0, 0, 49.5}));
  EXPECT_LT(largestViolation(*makeSpinGoal(rod, {}), rod), 1e-12);
  const auto spins = makeSpinVerdict(rod, Vec2::Zero(), 1.0, 1000.0);
  EXPECT_FALSE(spins->isReached(rod));
  EXPECT_EQ(spins->whatIsMissed(rod).rfind("it stays upright only above 285", 0), 0U)
      << spins->whatIsMissed(rod);

  // Float: the real pose instead of the wished one.
  const TriangleMesh hull = transformed(box({1, 0.8, 0.5}, 3), Mat3::Identity(), {0, 0, 0.25});
  const auto floats = makeFloatVerdict(hull.vertices, hull.faces, 0.6, 1.0, 100.0);
  EXPECT_EQ(floats->whatIsMissed(1.1 * momentsOf(hull)), "it sinks");
  EXPECT_EQ(floats->whatIsMissed(0.4 * momentsOf(hull)),
            "it floats with a draught of 20 instead of 30");
  const std::string heels = floats->whatIsMissed(translated(0.6 * momentsOf(hull), {0.05, 0, 0}));
  EXPECT_NE(heels.find("\u00b0 off upright"), std::string::npos) << heels;
}

TEST(EveryVerdict, IsInTheMessageAlsoWhereAllConstraintsHold) {
  LARGE_TEST();
  Options options;
  options.goal = GoalKind::RollUpright;
  const Report report = optimizeMassProperties(pillar(), options).report;
  EXPECT_FALSE(truth(report, "solved"));
  EXPECT_LE(number(report, "max_constraint_violation"), 1e-6);
  const std::string message = std::get<std::string>(report.at("message"));
  EXPECT_EQ(message, "The goal is missed: with the best cavity found it can come to rest on " +
                         toString(report.at("resting_faces_after")) +
                         " different faces instead of one. No cavity of any shape that keeps this "
                         "wall can reach it.");
}

/// A right prism on the given convex outline, counter-clockwise.
TriangleMesh prism(const std::vector<Vec2>& outline, double height, int layers) {
  const auto n = static_cast<int>(outline.size());
  const int below = n * (layers + 1);
  Vec2 middle = Vec2::Zero();
  for (const Vec2& p : outline) middle += p / n;
  TriangleMesh mesh{Points(below + 2, 3), Faces(2 * n * (layers + 1), 3)};
  for (int layer = 0; layer <= layers; ++layer) {
    for (int i = 0; i < n; ++i) {
      const Vec2& p = outline[static_cast<std::size_t>(i)];
      mesh.vertices.row(layer * n + i) << p.x(), p.y(), height * layer / layers;
    }
  }
  mesh.vertices.row(below) << middle.x(), middle.y(), 0.0;
  mesh.vertices.row(below + 1) << middle.x(), middle.y(), height;
  Eigen::Index f = 0;
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    mesh.faces.row(f++) << below, j, i;
    mesh.faces.row(f++) << below + 1, layers * n + i, layers * n + j;
    for (int q = 0; q < below - n; q += n) {
      mesh.faces.row(f++) << q + i, q + j, q + n + j;
      mesh.faces.row(f++) << q + i, q + n + j, q + n + i;
    }
  }
  return mesh;
}

TEST(Stand, DoesNotLoseTheSharpCornersOfAFootWithAFinelyTessellatedArc) {
  LARGE_TEST();
  // A foot of 100 × 60 with one corner rounded: with the arc thinned out by number, the hull's
  // other three corners would be lost, and the centre of mass be beyond what is left.
  for (const int segments : {20, 200, 1000}) {
    std::vector<Vec2> outline{{100, 0}, {100, 60}, {0, 60}};
    for (int i = 0; i <= segments; ++i) {
      const double t = std::acos(-1.0) * (1.0 + 0.5 * i / segments);
      outline.emplace_back(40 + 40 * std::cos(t), 40 + 40 * std::sin(t));
    }
    const Report report = optimizeMassProperties(prism(outline, 85.0, 8), {}).report;
    EXPECT_TRUE(truth(report, "solved")) << std::get<std::string>(report.at("message"));
    EXPECT_EQ(number(report, "max_constraint_violation"), 0.0);
    EXPECT_NEAR(number(report, "tip_angle_before"), 34.05, 0.01);
    // Stand lowers the centre of mass: which angle that gives differs by some degrees.
    EXPECT_GT(number(report, "tip_angle_after"), 45.0);
  }
}

} // namespace
} // namespace massprops::testing
