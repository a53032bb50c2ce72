// The best that any cavity could do, against closed forms and brute force.
#include "core/optimum/optimal_bound.h"

#include "cells.h"
#include "core/goals/published_stand.h"
#include "core/goals/registry.h"
#include "core/goals/spin.h"
#include "core/goals/stand.h"
#include "core/model/posed_model.h"
#include "core/model/solid.h"
#include "core/pipeline.h"
#include "core/query/point_in_mesh.h"
#include "core/query/self_intersection.h"
#include "core/query/triangle_tree.h"
#include "large_test.h"
#include "samples.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <ostream>
#include <string>
#include <utility>

namespace massprops::testing {
namespace {

constexpr double kPi = 3.14159265358979323846;

ContactArea square(double side) {
  const double h = side / 2;
  return {{{-h, -h}, {h, -h}, {h, h}, {-h, h}}, {}};
}

TriangleTree treeOf(const TriangleMesh& mesh) {
  return {mesh.vertices, mesh.faces};
}

/// Least value of a function with one minimum in [low, high].
template <class F>
double leastValue(const F& f, double low, double high) {
  for (int i = 0; i < 100; ++i) {
    const double a = low + (high - low) / 3;
    const double b = high - (high - low) / 3;
    (f(a) < f(b) ? high : low) = f(a) < f(b) ? b : a;
  }
  return f(0.5 * (low + high));
}

TEST(OptimalBound, OfAStandingBoxIsHollowAboveItsCentreOfMass) {
  const double wall = 0.05;
  const double side = 1.0;
  const double height = 2.0;
  const TriangleMesh outer =
      transformed(box({side, side, height}, 4), Mat3::Identity(), Vec3(0, 0, height / 2));
  // Without the slab between h and the upper wall: c_z = (V H/2 − A (t² − h²)/2)/(V − A (t − h)).
  const double V = side * side * height;
  const double A = std::pow(side - 2 * wall, 2);
  const double top = height - wall;
  const double expected = leastValue(
      [&](double h) {
        return (V * height / 2 - A * (top * top - h * h) / 2) / (V - A * (top - h));
      },
      wall, top);
  const Moments solid = moments(outer.vertices, outer.faces);
  const auto goal = makePublishedStandGoal(square(side), 1.0, {});
  const OptimalBound limit = optimalBound(*goal, {}, solid, {{}}, cellsBehind(treeOf(outer), wall));
  const double gain = height / 2 - expected;
  EXPECT_NEAR(limit.objective, expected, 3e-3 * gain);
  EXPECT_EQ(limit.violation, 0.0);
  const Moments& worth = limit.worth.quadrics.front();
  // The border of the half-space is the height of the centre of mass itself.
  EXPECT_NEAR(-worth[0] / worth[3], expected, 0.02 * height);
  EXPECT_LT(std::hypot(worth[1], worth[2]), 0.02 * worth[3]);
}

TEST(OptimalBound, OfWhatTipsOverAllAroundIsHollowAboveAPlaneBetweenCells) {
  // Turned, so that no layer of cells is as symmetric as the column.
  const double wall = 0.05;
  const double height = 2.0;
  const double radius = 0.1;
  const Mat3 turned = Eigen::AngleAxisd(0.3, Vec3::UnitZ()).toRotationMatrix();
  const TriangleMesh outer = transformed(box({1, 1, height}, 4), turned, {0, 0, height / 2});
  const double A = std::pow(1.0 - 2 * wall, 2);
  const double top = height - wall;
  const double lowest = leastValue(
      [&](double h) {
        return (height * height / 2 - A * (top * top - h * h) / 2) / (height - A * (top - h));
      },
      wall, top);
  const Moments solid = moments(outer.vertices, outer.faces);
  const auto goal = makeStandGoal({{}, Vec2(radius, radius)}, {});
  // The plane is known to a share of a cell: with as many as elsewhere to 6 thousandths.
  const OptimalBound limit =
      optimalBound(*goal, {}, solid, {{}}, cellsBehind(treeOf(outer), wall, 8.0 * kCellsInBox));
  const Vec3 centre = limit.massMoments.segment<3>(1) / limit.massMoments[0];
  EXPECT_LT(centre.head<2>().norm(), 1e-5);
  EXPECT_NEAR(centre.z(), lowest, 3e-3 * (height / 2 - lowest));
  const Moments& worth = limit.worth.quadrics.front();
  EXPECT_LT(std::hypot(worth[1], worth[2]), 3e-3 * worth[3]);
  EXPECT_LE(limit.bestLevel()->reached, limit.bestLevel()->level);
}

TEST(OptimalBound, HasTheBestBodyOfAPartOfTheCells) {
  const TriangleMesh outer = transformed(box({1, 1, 2}, 4), Mat3::Identity(), Vec3(0.2, 0, 1));
  const Moments solid = moments(outer.vertices, outer.faces);
  const auto goal = makePublishedStandGoal(square(1.0), 1.0, {});
  const AdmissibleCells cells = cellsBehind(treeOf(outer), 0.05);
  const OptimalBound all = optimalBound(*goal, {}, solid, {{}}, cells);
  AdmissibleCells low = cells;
  Eigen::Index count = 0;
  for (Eigen::Index c = 0; c < cells.rows(); ++c) {
    if (cells(c, 3) < 1.4 * cells(c, 0)) low.row(count++) = cells.row(c);
  }
  low.conservativeResize(count, 10);
  const OptimalBound part = withBodyWithin(low, all, *goal, {}, solid, {{}});
  EXPECT_EQ(part.objective, optimalBound(*goal, {}, solid, {{}}, low).objective);
  EXPECT_GT(part.objective, 1.05 * all.objective);
  EXPECT_EQ(part.massMomentsInAll, all.massMoments);
  EXPECT_EQ(part.violationInAll, all.violation);
  const OptimalBound none = withBodyWithin({}, all, *goal, {}, solid, {{}});
  EXPECT_EQ(none.massMoments, solid);
  EXPECT_GT(none.objective, part.objective);
}

TEST(OptimalBound, OfASpinningBallIsTwoConesAlongTheAxis) {
  const double wall = 0.1;
  const TriangleMesh outer = transformed(sphere(24), Mat3::Identity(), Vec3(0, 0, 1.3));
  const Moments solid = moments(outer.vertices, outer.faces);
  // What is within the angle θ of the axis is hollow, in the ball of radius 1 − wall. With a
  // sector's ∫z² = 4π/15 (1 − cos³θ) r⁵ and ∫(x² + y²) = 4π/15 (2 − 3 cos θ + cos³θ) r⁵.
  const double r5 = std::pow(1 - wall, 5);
  const double expected = leastValue(
      [&](double theta) {
        const double c = std::cos(theta);
        const double zz = 1 - r5 * (1 - c * c * c);
        const double rr = 2 - r5 * (2 - 3 * c + c * c * c);
        return 2 * std::pow((0.5 * rr + zz) / rr, 2);
      },
      0.0, kPi / 2);
  Weights inertiaOnly;
  inertiaOnly.centerOfMass = 0.0;
  const auto goal = makeSpinGoal(solid, inertiaOnly);
  const OptimalBound limit =
      optimalBound(*goal, inertiaOnly, solid, {{}}, cellsBehind(treeOf(outer), wall));
  const double gain = 2.0 - expected;
  EXPECT_NEAR(limit.objective, expected, 5e-3 * gain);
  EXPECT_LE(limit.violation, 1e-6);
}

TEST(OptimalBound, OfAHeavyFillingLiesBelow) {
  const double wall = 0.05;
  const TriangleMesh outer = transformed(box({1, 1, 2}, 4), Mat3::Identity(), Vec3(0, 0, 1));
  const Moments solid = moments(outer.vertices, outer.faces);
  const auto goal = makePublishedStandGoal(square(1.0), 1.0, {});
  const double filling = 7.0;
  // The slab from the lower wall up to h, six times as heavy as before on top.
  const double A = std::pow(1 - 2 * wall, 2);
  const double expected = leastValue(
      [&](double h) {
        return (2.0 + (filling - 1) * A * (h * h - wall * wall) / 2) /
               (2.0 + (filling - 1) * A * (h - wall));
      },
      wall, 2 - wall);
  const OptimalBound limit =
      optimalBound(*goal, {}, solid, {{filling}}, cellsBehind(treeOf(outer), wall));
  EXPECT_NEAR(limit.objective, expected, 3e-3 * (1.0 - expected));
}

/// Least cost of a body without all that is on one side of a plane: many directions, and every
/// fiftieth offset in each.
double bestHalfSpace(const std::function<double(const Moments&)>& costOf, const Moments& solid,
                     const AdmissibleCells& cells) {
  double best = std::numeric_limits<double>::infinity();
  Vec3 centre = Vec3::UnitZ();
  const Points positions = cells.col(0).cwiseInverse().asDiagonal() * cells.middleCols<3>(1);
  std::vector<int> order(static_cast<std::size_t>(cells.rows()));
  double spread = kPi;
  for (int refinement = 0; refinement < 4; ++refinement) {
    Vec3 winner = centre;
    const Mat3 frame = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), centre).toRotationMatrix();
    for (int i = 0; i <= 10; ++i) {
      for (int j = 0; j < 16; ++j) {
        const double theta = spread * i / 10;
        const double phi = 2 * kPi * j / 16;
        const Vec3 direction = frame * Vec3(std::sin(theta) * std::cos(phi),
                                            std::sin(theta) * std::sin(phi), std::cos(theta));
        const Vector heights = positions * direction;
        std::iota(order.begin(), order.end(), 0);
        std::sort(order.begin(), order.end(),
                  [&](int a, int b) { return heights[a] > heights[b]; });
        Moments mass = solid;
        for (std::size_t c = 0; c < order.size(); ++c) {
          mass -= cells.row(order[c]).transpose();
          if (c % 50 != 0) continue;
          const double value = costOf(mass);
          if (value >= best) continue;
          best = value;
          winner = direction;
        }
      }
    }
    centre = winner;
    spread /= 5;
  }
  return best;
}

class SampleLimit : public ::testing::TestWithParam<const char*> {};

TEST_P(SampleLimit, IsWhatBruteForceFindsOnVoxels) {
  const TriangleMesh model = sampleMesh(GetParam());
  Options options;
  const Solid solid = makeSolid(model);
  options.innerLowerBound = 0.02 * solid.diagonal();
  const PosedModel posed = makePosedModel(solid, options);
  const AdmissibleCells cells = cellsBehind({posed.vertices, posed.faces}, posed.wall);

  // Plain voxels, in or out by their centre.
  const Vec3 low = posed.vertices.colwise().minCoeff();
  const Vec3 high = posed.vertices.colwise().maxCoeff();
  const double edge = std::cbrt((high - low).prod() / 40000);
  std::vector<Vec3> centres;
  for (double x = low.x() + edge / 2; x < high.x(); x += edge)
    for (double y = low.y() + edge / 2; y < high.y(); y += edge)
      for (double z = low.z() + edge / 2; z < high.z(); z += edge) centres.emplace_back(x, y, z);
  Points points(static_cast<Eigen::Index>(centres.size()), 3);
  for (std::size_t i = 0; i < centres.size(); ++i)
    points.row(static_cast<Eigen::Index>(i)) = centres[i].transpose();
  const TriangleTree surface(posed.vertices, posed.faces);
  Moments voxels = Moments::Zero();
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const Vec3 p = points.row(i).transpose();
    if (!PointInMesh(surface).contains(p) ||
        std::sqrt(surface.nearest(p).squaredDistance) < posed.wall)
      continue;
    Moments one;
    one << 1.0, p, p.cwiseAbs2(), p.x() * p.y(), p.y() * p.z(), p.z() * p.x();
    voxels += one * edge * edge * edge;
  }
  // About ten thousand voxels of which a few thousand are cut by the border, each wrong by a third.
  const Moments region = cells.colwise().sum().transpose();
  EXPECT_NEAR(region[0], voxels[0], 0.02 * voxels[0]);
  for (int k = 1; k < 10; ++k) EXPECT_NEAR(region[k], voxels[k], 0.01 * voxels[0]);

  const auto goal = makePublishedStandGoal(posed.contact, 1.0, {});
  const Moments whole = moments(posed.vertices, posed.faces);
  const double brute = bestHalfSpace(
      [&](const Moments& mass) {
        return largestViolation(*goal, mass) > 1e-6 ? std::numeric_limits<double>::infinity()
                                                    : goal->objective(mass).value;
      },
      whole, cells);
  const OptimalBound limit = optimalBound(*goal, {}, whole, {{}}, cells);
  const double gain = goal->objective(whole).value - brute;
  EXPECT_NEAR(limit.objective, brute, 5e-3 * gain);
}

INSTANTIATE_TEST_SUITE_P(Samples, SampleLimit,
                         ::testing::Values("box_on_corner", "toy_dinosaur", "leaning_ring"));

/// To 1e-3 they would not do: gap_to_limit cannot compare such a bound with a result that keeps
/// them, and is 0 % instead of 4.1 % for the top and of 0.4 % for the duck.
TEST(OptimalBound, KeepsConstraintsAsTightlyAsTheResultHasTo) {
  for (const auto& [sample, kind] : {std::pair("tilted_ellipsoid_top", GoalKind::Spin),
                                     std::pair("bath_duck", GoalKind::Float)}) {
    Options options;
    options.goal = kind;
    options.waterLevel = 0.4;
    const PosedModel posed = makePosedModel(makeSolid(sampleMesh(sample)), options);
    const auto goal = makeGoal(options, posed, posed.vertices);
    const OptimalBound bound =
        optimalBound(*goal, options.weights, moments(posed.vertices, posed.faces), {{}},
                     cellsBehind({posed.vertices, posed.faces}, posed.wall));
    EXPECT_LE(bound.violation, 1e-6) << sample;
  }
}

class SampleGap : public ::testing::TestWithParam<const char*> {};

double gapAtTwoPerCent(const std::string& sample) {
  const TriangleMesh model = sampleMesh(sample);
  Options options;
  options.goal = sample == "tilted_ellipsoid_top" ? GoalKind::Spin : GoalKind::Stand;
  options.innerLowerBound = 0.02 * makeSolid(model).diagonal();
  const Report report = optimizeMassProperties(model, options).report;
  return std::get<double>(report.at("gap_to_limit"));
}

TEST_P(SampleGap, IsAtMostFifteenPerCentAtAWallOfTwoPerCent) {
  const double gap = gapAtTwoPerCent(GetParam());
  EXPECT_LE(gap, 0.15);
  EXPECT_GE(gap, 0.0);
}

INSTANTIATE_TEST_SUITE_P(Samples, SampleGap,
                         ::testing::Values("box_on_corner", "toy_dinosaur", "leaning_ring",
                                           "leaning_egg", "tilted_ellipsoid_top"));

class BestVerdict : public ::testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Samples, BestVerdict, ::testing::Values("leaning_egg", "leaning_skittle"));

TEST_P(BestVerdict, IsTheBestTippingAngleOfAllHalfSpaces) {
  Options options;
  const Solid solid = makeSolid(sampleMesh(GetParam()));
  options.innerLowerBound = 0.02 * solid.diagonal();
  const PosedModel posed = makePosedModel(solid, options);
  const AdmissibleCells cells = cellsBehind({posed.vertices, posed.faces}, posed.wall);
  const Moments whole = moments(posed.vertices, posed.faces);
  for (const bool isEllipse : {false, true}) {
    ContactArea area = posed.contact;
    if (isEllipse) area.radii = Vec2(0.06, 0.04);
    const auto tilt = [&](const Moments& mass) {
      return tippingAngle(area, Vec3(mass.segment<3>(1) / mass[0]));
    };
    const auto goal = makeStandGoal(area, {});
    const OptimalBound limit = optimalBound(*goal, {}, whole, {{}}, cells);
    const LevelBound* best = limit.bestLevel();
    ASSERT_NE(best, nullptr);
    const double brute =
        -bestHalfSpace([&](const Moments& mass) { return -tilt(mass); }, whole, cells);
    // The search looks at every fiftieth of ten thousand cells and at directions some degrees
    // apart in the last of its refinements.
    EXPECT_NEAR(tilt(best->states.front()), brute, 0.02);
    EXPECT_LT(tilt(best->states.front()), 0.0);
    // The multipliers prove it, but for cells that are hollow in part.
    EXPECT_NEAR(std::atan(best->level) * 180.0 / kPi, tilt(best->states.front()), 0.02);
  }
}

struct Impossible {
  std::string name;
  std::string sample;
  GoalKind goal;
  std::function<void(Options&)> change;
  std::string best; ///< words about the best that could be had
  bool isProved = true;
};

void PrintTo(const Impossible& impossible, std::ostream* os) {
  *os << impossible.name;
}

class OutOfReach : public ::testing::TestWithParam<Impossible> {};
INSTANTIATE_TEST_SUITE_P(
    EveryGoal, OutOfReach,
    ::testing::Values(
        Impossible{"Stand", "leaning_egg", GoalKind::Stand, [](Options&) {},
                   "the best possible tipping angle is -4."},
        Impossible{"Spin", "tilted_ellipsoid_top", GoalKind::Spin,
                   [](Options& o) { o.pivot = Vec3(15.0, 0.0, 0.0); }, "off the axis"},
        Impossible{"YoYo", "uneven_yo_yo", GoalKind::YoYo,
                   [](Options& o) { o.pivot = Vec3(0.0, 0.0, 100.0); }, "off the middle"},
        Impossible{"StandEmptyAndFilled", "leaning_egg", GoalKind::StandEmptyAndFilled,
                   [](Options& o) { o.fillDensity = 0.6; }, "at the worst level of its contents"},
        Impossible{"RollUpright", "leaning_egg", GoalKind::RollUpright, [](Options&) {},
                   "can reach it."},
        Impossible{"Float", "bath_duck", GoalKind::Float, [](Options& o) { o.waterLevel = 0.05; },
                   "too heavy"},
        Impossible{"Hang", "hanging_fish", GoalKind::Hang,
                   [](Options& o) { o.pivot = Vec3(60.0, 0.0, 200.0); }, "off the plumb line"},
        Impossible{"Mass", "game_piece", GoalKind::Mass, [](Options& o) { o.targetMass = 1.0; },
                   "too large"}),
    [](const auto& test) { return test.param.name; });

TEST_P(OutOfReach, IsSaidWithTheBestThatCouldBeHad) {
  Options options;
  options.goal = GetParam().goal;
  GetParam().change(options);
  const Report report = optimizeMassProperties(sampleMesh(GetParam().sample), options).report;
  EXPECT_FALSE(std::get<bool>(report.at("solved")));
  const std::string message = std::get<std::string>(report.at("message"));
  const std::size_t limit =
      message.find(GetParam().isProved ? "No cavity of any shape that keeps this wall can reach it"
                                       : "No cavity of any shape that keeps this wall was found");
  ASSERT_NE(limit, std::string::npos) << message;
  EXPECT_NE(message.find(GetParam().best, limit), std::string::npos) << message;
  EXPECT_EQ(message.back(), '.');
  if (GetParam().goal == GoalKind::Stand) {
    const auto angle = [&](const char* key) { return std::get<double>(report.at(key)); };
    EXPECT_GE(angle("tip_angle_best"), angle("tip_angle_limit"));
    EXPECT_GE(angle("tip_angle_best"), angle("tip_angle_after"));
  }
}

struct MissedGoal {
  const char* sample;
  GoalKind goal;
  CavityShape shape;
  const char* words; ///< of the number that is told of both bodies
};

class BodyThatComesNearest : public ::testing::TestWithParam<MissedGoal> {};

TEST_P(BodyThatComesNearest, IsNotFartherThanTheDeliveredOneInWhatIsTold) {
  LARGE_TEST();
  const MissedGoal& missed = GetParam();
  Options options;
  options.goal = missed.goal;
  options.cavityShape = missed.shape;
  const Report report = optimizeMassProperties(sampleMesh(missed.sample), options).report;
  ASSERT_FALSE(std::get<bool>(report.at("solved")));
  const std::string message = std::get<std::string>(report.at("message"));
  const auto told = [&](const std::string& before) {
    const std::string start = before + " the centre of mass lies ";
    const std::size_t at = message.find(start);
    if (at == std::string::npos) return std::numeric_limits<double>::quiet_NaN();
    std::size_t length = 0;
    const std::string rest = message.substr(at + start.size());
    const double number = std::stod(rest, &length);
    EXPECT_EQ(rest.compare(length + 1, std::string(missed.words).size(), missed.words), 0) << rest;
    return number;
  };
  const double delivered = told("with the best cavity found");
  EXPECT_GT(delivered, 0.0) << message;
  EXPECT_LE(told("with the nearest one found"), delivered) << message;
}

INSTANTIATE_TEST_SUITE_P(
    Samples, BodyThatComesNearest,
    ::testing::Values(
        MissedGoal{"leaning_egg", GoalKind::Spin, CavityShape::Offset, "off the axis"},
        MissedGoal{"leaning_egg", GoalKind::Spin, CavityShape::BestPossible, "off the axis"},
        MissedGoal{"toy_dog", GoalKind::Hang, CavityShape::Offset, "off the plumb line"},
        MissedGoal{"bath_duck", GoalKind::Hang, CavityShape::BestPossible, "off the plumb line"}));

TEST(OptimalBound, IsTheLeastOfAllForSpinAndYoYoWithinAPerCent) {
  LARGE_TEST();
  for (const char* sample : {"tilted_ellipsoid_top", "uneven_yo_yo", "roly_poly", "game_piece"}) {
    const TriangleMesh model = sampleMesh(sample);
    for (const GoalKind kind : {GoalKind::Spin, GoalKind::YoYo}) {
      Options options;
      options.goal = kind;
      const Solid solid = makeSolid(model);
      const PosedModel posed = makePosedModel(solid, options);
      const Moments moments = massprops::moments(posed.vertices, posed.faces);
      const OptimalBound limit =
          optimalBound(*makeGoal(options, posed, posed.vertices), options.weights, moments, {{}},
                       cellsBehind({posed.vertices, posed.faces}, posed.wall));
      EXPECT_EQ(limit.objectiveAtLeast.has_value(), limit.violation <= 1e-6) << sample;
      if (!limit.objectiveAtLeast) continue;
      EXPECT_LE(*limit.objectiveAtLeast, limit.objective) << sample;
      const double share = kind == GoalKind::YoYo ? 1e-3 : 6e-3;
      EXPECT_GE(*limit.objectiveAtLeast, (1.0 - share) * limit.objective) << sample;
    }
  }
}

} // namespace
} // namespace massprops::testing
