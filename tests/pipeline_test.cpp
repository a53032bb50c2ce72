// The whole filter: what it promises about every result, measured with other means than its own.
#include "core/goals/registry.h"
#include "core/model/contact.h"
#include "core/pipeline.h"

#include "judge/checks.h"
#include "judge/guarantee.h"
#include "samples.h"
#include "shapes.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace massprops::testing {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegrees = 180.0 / kPi;

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
Vec3 point(const Result& result, const std::string& key) {
  return std::get<Vec3>(result.report.at(key));
}
Mat3 tensor(const Result& result, const std::string& key) {
  return std::get<Mat3>(result.report.at(key));
}

double diagonal(const TriangleMesh& mesh) {
  return (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).norm();
}

/// Stands on its base as a hollow body only: its centre leans 0.1 beyond the border of its foot.
TriangleMesh leaningPillar() {
  return transformed(roundedBox({1, 1, 2}, 0.15, 6, 2), shear(0.45));
}

/// No cavity can bring its centre back above its foot.
TriangleMesh hopelessPillar() {
  return transformed(roundedBox({1, 1, 2}, 0.15, 6, 2), shear(1.5));
}

/// The least tipping angle of the body, density 1, over levels of what its cavity, oriented as it
/// is delivered, holds.
double leastTippingAngle(const TriangleMesh& outer, const TriangleMesh& inner, double fill) {
  const GroundContact ground = groundContact(outer.vertices, {});
  const auto empty = quadratureMoments(outer) + quadratureMoments(inner);
  const double low = inner.vertices.col(2).minCoeff();
  const double high = inner.vertices.col(2).maxCoeff();
  double least = 90.0;
  constexpr int kLevels = 60;
  for (int i = 0; i <= kLevels; ++i) {
    const Eigen::Vector4d body =
        empty.head<4>() -
        fill * momentsOfColumns(inner, Vec3::UnitZ(), low + (high - low) * i / kLevels);
    const Vec3 centre = body.tail<3>() / body[0];
    least = std::min(least, tippingAngle(ground.area, Vec3(centre - ground.centre)));
  }
  return least;
}

Options stand() {
  return {};
}

Options spin() {
  Options options;
  options.goal = GoalKind::Spin;
  options.spinSpeed = 1e4; // the tops are two or three millimetres high
  return options;
}

struct Case {
  std::string name;
  TriangleMesh model;
  Options options;
};

std::vector<Case> cases() {
  Options moving = stand();
  moving.outerUpperBound = 0.1;
  Options filled = stand();
  filled.fillDensity = 1.0;
  filled.density = 2.7;
  Options sideways = stand();
  sideways.upAxis = UpAxis::MinusY;
  const Mat3 toMinusY = rotation(Vec3::UnitX(), kPi / 2); // takes +z to −y
  Options offset = stand();
  offset.cavityShape = CavityShape::Offset;
  Options best = spin();
  best.cavityShape = CavityShape::BestPossible;
  return {{"pillar", leaningPillar(), stand()},
          {"offset surface", leaningPillar(), offset},
          {"best possible", leaningTop(0.1, 9), best},
          {"figure", figure(3), stand()},
          {"ring", transformed(torus(2, 0.7, 48, 24), rotation(Vec3::UnitX(), 0.0)), stand()},
          {"top", leaningTop(0.1, 9), spin()},
          {"moving outer surface", leaningPillar(), moving},
          {"filled", leaningPillar(), filled},
          {"far away and sideways", transformed(leaningPillar(), 30 * toMinusY, {1000, -2000, 500}),
           sideways},
          {"hopeless", hopelessPillar(), stand()},
          {"fine", subdivided(sampleMesh("toy_dog")), stand()}};
}

/// Each case is computed once for all tests.
const Result& resultOf(const Case& c) {
  static std::map<std::string, Result> results;
  const auto known = results.find(c.name);
  if (known != results.end()) return known->second;
  return results.emplace(c.name, optimizeMassProperties(c.model, c.options)).first->second;
}

const TriangleMesh& outerOf(const Case& c) {
  const Result& result = resultOf(c);
  return result.outer ? *result.outer : c.model;
}

std::string caseName(const ::testing::TestParamInfo<Case>& info) {
  std::string name = info.param.name;
  std::replace_if(
      name.begin(), name.end(), [](char ch) { return ch == ' '; }, '_');
  return name;
}

void PrintTo(const Case& c, std::ostream* os) {
  *os << c.name;
}

class EveryResult : public ::testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Pipeline, EveryResult, ::testing::ValuesIn(cases()), caseName);

// ---------------------------------------------------------------- the cavity

TEST_P(EveryResult, HasACavityThatIsClosedAndWithoutSelfIntersections) {
  const TriangleMesh& inner = resultOf(GetParam()).inner;
  ASSERT_GT(inner.faces.rows(), 0);
  EXPECT_TRUE(inner.vertices.allFinite());
  EXPECT_TRUE(isClosedAndOriented(inner));
  EXPECT_EQ(intersectingPairs(inner), 0U);
}

TEST_P(EveryResult, HasItsCavityInsideOfTheOuterSurface) {
  const TriangleMesh& inner = resultOf(GetParam()).inner;
  const TriangleMesh& outer = outerOf(GetParam());
  EXPECT_EQ(intersectingPairs(outer), 0U);
  EXPECT_EQ(intersectingPairs(inner, outer), 0U);
  EXPECT_TRUE(isInside(inner, outer));
}

TEST_P(EveryResult, KeepsTheWallAndReportsTheLeast) {
  const Case& c = GetParam();
  const Result& result = resultOf(c);
  const double wall = leastDistance(result.inner, outerOf(c));
  const double wanted = c.options.innerLowerBound.value_or(0.01 * diagonal(c.model));
  EXPECT_GE(wall, wanted);
  EXPECT_NEAR(number(result, "min_wall"), wall, 1e-9 * diagonal(c.model));
}

TEST_P(EveryResult, PointsItsNormalsIntoTheCavity) {
  // Outer and inner surface together bound the material: around a point of the cavity they wind
  // 1 − 1 times, around a point of the wall once.
  const Case& c = GetParam();
  const Result& result = resultOf(c);
  EXPECT_LT(quadratureMoments(result.inner)[0], 0.0);
  const TriangleMesh& outer = outerOf(c);
  const TriangleMesh shell = joined(outer, result.inner);
  for (Eigen::Index f = 0; f < outer.faces.rows(); f += outer.faces.rows() / 10) {
    // Below the middle of an outer face by a quarter of the wall, and above it.
    const Vec3 a = outer.vertices.row(outer.faces(f, 0)).transpose();
    const Vec3 b = outer.vertices.row(outer.faces(f, 1)).transpose();
    const Vec3 d = outer.vertices.row(outer.faces(f, 2)).transpose();
    const Vec3 step = 0.25 * number(result, "min_wall") * (b - a).cross(d - a).normalized();
    EXPECT_NEAR(windingNumber(shell, (a + b + d) / 3 - step), 1.0, 1e-6);
    EXPECT_NEAR(windingNumber(shell, (a + b + d) / 3 + step), 0.0, 1e-6);
  }
}

// ---------------------------------------------------------------- the report

/// Mass moments in grams about the model's origin shifted to `origin`.
Eigen::Matrix<double, 10, 1> massMomentsOf(const Case& c, const Vec3& origin, bool before) {
  const auto about = [&](const TriangleMesh& mesh) {
    return quadratureMoments(transformed(mesh, Mat3::Identity(), -origin));
  };
  if (before) return c.options.density / 1000 * about(c.model);
  const Result& result = resultOf(c);
  const auto inner = about(result.inner); // negative: its normals point into the cavity
  return (c.options.density * (about(outerOf(c)) + inner) - c.options.fillDensity * inner) / 1000;
}

TEST_P(EveryResult, ReportsTheMassPropertiesOfItsTriangles) {
  const Case& c = GetParam();
  const Result& result = resultOf(c);
  const Vec3 origin = c.model.vertices.colwise().mean().transpose();
  const double size = diagonal(c.model);
  for (const bool before : {true, false}) {
    const std::string suffix = before ? "_before" : "_after";
    const Body body = bodyOf(massMomentsOf(c, origin, before));
    // The model's coordinates are used with 2⁻³² of the diagonal.
    const double relative = 1e-8;
    EXPECT_NEAR(number(result, "mass" + suffix), body.mass, relative * body.mass);
    EXPECT_LT((point(result, "center_of_mass" + suffix) - origin - body.centre).norm(),
              relative * size);
    EXPECT_LT((tensor(result, "inertia_tensor" + suffix) - body.inertia).norm(),
              relative * body.inertia.norm());
  }
  const double volumeBefore = quadratureMoments(c.model)[0];
  const double volumeAfter = quadratureMoments(outerOf(c))[0] + quadratureMoments(result.inner)[0];
  // Far from the origin the check itself loses digits.
  EXPECT_NEAR(number(result, "volume_before") / volumeBefore, 1.0, 1e-7);
  EXPECT_NEAR(number(result, "volume_after") / volumeAfter, 1.0, 1e-7);
}

/// Rotation of the model's up axis to z, for the axes that the cases use.
Mat3 upright(const Options& options) {
  Mat3 R = Mat3::Identity();
  if (options.upAxis == UpAxis::MinusY) R << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return R;
}

/// Upright vertices within 1e-4 of the diagonal of the ground.
std::vector<Vec2> groundPoints(const Case& c) {
  const Points x = c.model.vertices * upright(c.options).transpose();
  const double ground = x.col(2).minCoeff() + 1e-4 * diagonal(c.model);
  std::vector<Vec2> points;
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    if (x(v, 2) <= ground) points.emplace_back(x(v, 0), x(v, 1));
  }
  return points;
}

double tippingAngleOf(const Case& c, const Vec3& centreOfMass) {
  const Vec3 centre = upright(c.options) * centreOfMass;
  const double height =
      centre.z() - (c.model.vertices * upright(c.options).transpose()).col(2).minCoeff();
  const std::vector<Vec2> ground = groundPoints(c);
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 36000; ++i) {
    const Vec2 u(std::cos(2 * kPi * i / 36000), std::sin(2 * kPi * i / 36000));
    double farthest = -std::numeric_limits<double>::infinity();
    for (const Vec2& p : ground) farthest = std::max(farthest, u.dot(p));
    least = std::min(least, std::atan2(farthest - u.dot(centre.head<2>()), height));
  }
  return least * kDegrees;
}

TEST_P(EveryResult, ReportsTheVerdictOfItsTriangles) {
  const Case& c = GetParam();
  const Result& result = resultOf(c);
  for (const bool before : {true, false}) {
    const std::string suffix = before ? "_before" : "_after";
    const Vec3 origin = c.model.vertices.colwise().mean().transpose();
    const Body body = bodyOf(massMomentsOf(c, origin, before));
    if (c.options.goal == GoalKind::Stand) {
      const double angle = tippingAngleOf(c, body.centre + origin);
      // 36,000 directions are 0.01° apart.
      EXPECT_NEAR(number(result, "tip_angle" + suffix), angle, 0.01);
      EXPECT_EQ(truth(result, "stands" + suffix), angle > 0.0);
    } else {
      Vec2 pivot = Vec2::Zero();
      const std::vector<Vec2> ground = groundPoints(c);
      for (const Vec2& p : ground) pivot += p / static_cast<double>(ground.size());
      const Vec2 offset = (body.centre + origin).head<2>() - pivot;
      EXPECT_NEAR(number(result, "axis_offset" + suffix), offset.norm(), 1e-7 * diagonal(c.model));
      const Eigen::SelfAdjointEigenSolver<Mat3> principal(body.inertia);
      const double upwards = principal.eigenvectors().row(2).cwiseAbs().maxCoeff();
      EXPECT_NEAR(number(result, "axis_tilt" + suffix),
                  std::acos(std::min(1.0, upwards)) * kDegrees,
                  1e-5); // acos near 1 keeps half of the digits
      const double xx = body.inertia(0, 0);
      const double yy = body.inertia(1, 1);
      const double xy = body.inertia(0, 1);
      const double mean = (xx + yy) / 2;
      const double spread = std::hypot((xx - yy) / 2, xy);
      EXPECT_NEAR(number(result, "moment_ratio_a" + suffix), body.inertia(2, 2) / (mean + spread),
                  1e-7);
      EXPECT_NEAR(number(result, "moment_ratio_b" + suffix), body.inertia(2, 2) / (mean - spread),
                  1e-7);
    }
  }
}

TEST_P(EveryResult, SaysSolvedOnlyIfTheVerdictIsPositive) {
  const Case& c = GetParam();
  const Result& result = resultOf(c);
  if (!truth(result, "solved")) return;
  if (c.options.goal == GoalKind::Stand) {
    EXPECT_GT(number(result, "tip_angle_after"), 0.0);
  } else {
    EXPECT_LT(number(result, "axis_tilt_after"), 0.5);
    EXPECT_LT(number(result, "axis_offset_after"), 1e-3 * diagonal(c.model));
  }
}

TEST_P(EveryResult, IsNeverWorseThanTheSolid) {
  // Nearer to its constraints, or as near and with a lower objective.
  const Case& c = GetParam();
  const Result& result = resultOf(c);
  const bool nearer = c.options.goal == GoalKind::Stand
                          ? number(result, "tip_angle_after") > number(result, "tip_angle_before")
                          : number(result, "axis_tilt_after") < number(result, "axis_tilt_before");
  EXPECT_TRUE(nearer || number(result, "objective_after") < number(result, "objective_before"));
  EXPECT_GT(number(result, "volume_after"), 0.0);
}

TEST_P(EveryResult, TellsHowItCameAbout) {
  const Result& result = resultOf(GetParam());
  EXPECT_FALSE(text(result, "message").empty());
  EXPECT_FALSE(text(result, "stop_reason").empty());
  EXPECT_GT(integer(result, "evaluations"), 0);
  // Skeleton and basis are computed side by side.
  const double parts =
      std::max(number(result, "seconds_skeleton"), number(result, "seconds_basis")) +
      number(result, "seconds_optimization") + number(result, "seconds_inspection");
  EXPECT_GE(number(result, "seconds_total"), parts);
}

// ---------------------------------------------------------------- the goals

const Case& caseNamed(const std::string& name) {
  static const std::vector<Case> all = cases();
  return *std::find_if(all.begin(), all.end(), [&](const Case& c) { return c.name == name; });
}

TEST(Pipeline, MakesALeaningPillarStand) {
  const Result& result = resultOf(caseNamed("pillar"));
  EXPECT_FALSE(truth(result, "stands_before"));
  EXPECT_TRUE(truth(result, "stands_after"));
  EXPECT_TRUE(truth(result, "solved"));
}

TEST(Pipeline, TakesTheBestPossibleCavityOfAClosedSurfaceThatStays) {
  const TriangleMesh model = sampleMesh("toy_dinosaur");
  Options options;
  const Result result = optimizeMassProperties(model, options);
  EXPECT_EQ(text(result, "cavity_shape"), "best possible: the surface is closed and stays");
  options.cavityShape = CavityShape::Offset;
  const Result offset = optimizeMassProperties(model, options);
  EXPECT_EQ(text(offset, "cavity_shape"), "offset surface: as asked for");
  EXPECT_GT(number(offset, "gap_to_limit"), 0.02);
  EXPECT_LT(number(result, "gap_to_limit"), 0.015);
  EXPECT_GT(number(result, "tip_angle_after"), number(offset, "tip_angle_after"));
  EXPECT_EQ(text(resultOf(caseNamed("moving outer surface")), "cavity_shape"),
            "offset surface: the outer surface moves");
  // Nothing is looked for that it does not need.
  const Result& best = resultOf(caseNamed("best possible"));
  EXPECT_EQ(text(best, "cavity_shape"), "best possible: as asked for");
  EXPECT_EQ(number(best, "seconds_skeleton"), 0.0);
  EXPECT_TRUE(truth(best, "solved")) << text(best, "message");
  EXPECT_LT(number(best, "max_constraint_violation"), 1e-6);
  EXPECT_LT(number(best, "gap_to_limit"), 0.02);
}

TEST(Pipeline, MakesALeaningTopSpin) {
  const Result& result = resultOf(caseNamed("top"));
  EXPECT_GT(number(result, "axis_tilt_before"), 3.0);
  EXPECT_LT(number(result, "axis_tilt_after"), 0.1);
  EXPECT_TRUE(truth(result, "solved")) << text(result, "message");
}

TEST(Pipeline, DoesNotSayOfARodThatItSpins) {
  // Balanced as well as can be, but it would need 285,000 rpm.
  Options options;
  options.goal = GoalKind::Spin;
  const TriangleMesh rod = transformed(box({4, 4, 99}, 12), Mat3::Identity(), {0, 0, 49.5});
  const Result result = optimizeMassProperties(rod, options);
  EXPECT_NEAR(number(result, "sleeping_speed_before"), 285000, 1000);
  for (const std::string state : {"_before", "_after"}) {
    EXPECT_FALSE(truth(result, "spins" + state));
    EXPECT_LT(number(result, "axis_tilt" + state), 0.01);
    EXPECT_GT(number(result, "sleeping_speed" + state), 1e5);
  }
  EXPECT_FALSE(truth(result, "solved"));
  EXPECT_NE(text(result, "message").find("it stays upright only above"), std::string::npos)
      << text(result, "message");
  EXPECT_EQ(text(result, "message").find("could reach it"), std::string::npos);
}

TEST(Pipeline, SpinsOnAPoint) {
  // The pivot is one vertex: Spin needs no area to stand on.
  EXPECT_NO_THROW(resultOf(caseNamed("top")));
}

TEST(Pipeline, SaysHonestlyThatAModelCannotStand) {
  const Result& result = resultOf(caseNamed("hopeless"));
  EXPECT_FALSE(truth(result, "solved"));
  EXPECT_FALSE(truth(result, "stands_after"));
  EXPECT_LT(number(result, "tip_angle_after"), 0.0);
  EXPECT_GT(number(result, "tip_angle_after"), number(result, "tip_angle_before"));
}

TEST(Pipeline, LeavesABodySolidThatStandsAsFirmlyAsWanted) {
  // Heavier than the material: filled, it would stand more firmly, and weigh more.
  Options options;
  options.goal = GoalKind::Stand;
  options.tippingAngle = 20.0;
  options.fillDensity = 2.0 * options.density;
  options.cavityShape = CavityShape::Offset;
  const Result result = optimizeMassProperties(roundedBox({1, 1, 2}, 0.1, 6, 2), options);
  EXPECT_TRUE(truth(result, "solved"));
  EXPECT_GT(number(result, "tip_angle_before"), 20.0);
  EXPECT_EQ(number(result, "mass_after"), number(result, "mass_before"));
}

TEST(Pipeline, ComesAsNearToAWantedAngleAsItCanWhateverTheVolumeWeighs) {
  Options options;
  options.goal = GoalKind::Stand;
  options.tippingAngle = 60.0;
  options.cavityShape = CavityShape::Offset;
  const TriangleMesh body = roundedBox({1, 1, 2}, 0.1, 6, 2);
  const Result plain = optimizeMassProperties(body, options);
  options.weights.volume = 10.0;
  const Result weighed = optimizeMassProperties(body, options);
  EXPECT_FALSE(truth(weighed, "solved"));
  EXPECT_GT(number(plain, "tip_angle_after"), number(plain, "tip_angle_before"));
  EXPECT_EQ(number(weighed, "tip_angle_after"), number(plain, "tip_angle_after"));
}

TEST(Pipeline, MakesTheAngleAsLargeAsItCanWhereMoreIsWanted) {
  Options options;
  options.cavityShape = CavityShape::BestPossible;
  for (const char* sample : {"box_on_corner", "toy_dinosaur"}) {
    const TriangleMesh model = sampleMesh(sample);
    options.tippingAngle = 0.0;
    const Result best = optimizeMassProperties(model, options);
    options.tippingAngle = 60.0;
    const Result nearest = optimizeMassProperties(model, options);
    const double gain = number(best, "tip_angle_after") - number(best, "tip_angle_before");
    EXPECT_FALSE(truth(nearest, "solved"));
    EXPECT_NEAR(number(nearest, "tip_angle_after"), number(best, "tip_angle_after"), 0.01 * gain);
    EXPECT_NEAR(number(nearest, "tip_angle_limit"), number(best, "tip_angle_limit"), 0.01 * gain);
    EXPECT_LT(number(nearest, "gap_to_limit"), 0.02);
  }
}

TEST(Pipeline, LeavesAPlateSolidThatIsThinnerThanTwoWalls) {
  const Result result = optimizeMassProperties(box({1, 1, 0.01}, 8), stand());
  EXPECT_EQ(result.inner.vertices.rows(), 0);
  EXPECT_EQ(result.inner.faces.rows(), 0);
  EXPECT_EQ(integer(result, "cavity_components"), 0);
  EXPECT_EQ(number(result, "volume_after"), number(result, "volume_before"));
  EXPECT_NE(text(result, "message").find("inner_lower_bound"), std::string::npos);
}

// ---------------------------------------------------------------- scale, place and direction

TEST(Pipeline, ScalesTheCavityWithTheModelBitForBitByPowersOfTwo) {
  const TriangleMesh model = leaningPillar();
  const TriangleMesh& inner = resultOf(caseNamed("pillar")).inner;
  for (const double factor : {1.0 / 1024, 1024.0}) {
    const Result result = optimizeMassProperties(scaled(model, factor), stand());
    ASSERT_EQ(result.inner.vertices.rows(), inner.vertices.rows());
    EXPECT_EQ(result.inner.faces, inner.faces);
    EXPECT_EQ(result.inner.vertices, Points(factor * inner.vertices));
  }
}

TEST(Pipeline, ScalesTheCavityWithTheModel) {
  // Any other factor changes the last bits of the input. They are lost where the working
  // coordinates are rounded to 2⁻³² of the diagonal; what is left are the few coordinates that lie
  // on the verge of two grid points.
  const TriangleMesh model = leaningPillar();
  const Result& original = resultOf(caseNamed("pillar"));
  for (const double factor : {1e-3, 1e3}) {
    const Result result = optimizeMassProperties(scaled(model, factor), stand());
    ASSERT_EQ(result.inner.vertices.rows(), original.inner.vertices.rows());
    const Points difference = result.inner.vertices / factor - original.inner.vertices;
    EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-6 * diagonal(model)) << "factor " << factor;
    EXPECT_NEAR(number(result, "tip_angle_after"), number(original, "tip_angle_after"), 1e-4);
    EXPECT_NEAR(number(result, "objective_after"), number(original, "objective_after"), 1e-6);
  }
}

TEST(Pipeline, MovesTheCavityWithTheModel) {
  // At a distance of 3000 the coordinates have 4.5e-13 left: 1e-5 of a grid step.
  const Vec3 shift(1000, -3000, 250);
  for (const char* name : {"ring", "top"}) {
    const Case& c = caseNamed(name);
    const Result& original = resultOf(c);
    const Result result =
        optimizeMassProperties(transformed(c.model, Mat3::Identity(), shift), c.options);
    ASSERT_EQ(result.inner.vertices.rows(), original.inner.vertices.rows()) << name;
    const Points difference =
        (result.inner.vertices.rowwise() - shift.transpose()) - original.inner.vertices;
    EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-6 * diagonal(c.model)) << name;
    EXPECT_NEAR(number(result, "objective_after"), number(original, "objective_after"), 1e-8);
  }
  // Where a coordinate lies on the verge of two grid points, the search may end in another of
  // several cavities that are as good.
  const Case& figure = caseNamed("figure");
  const Result& original = resultOf(figure);
  const Result moved =
      optimizeMassProperties(transformed(figure.model, Mat3::Identity(), shift), figure.options);
  EXPECT_NEAR(number(moved, "tip_angle_after"), number(original, "tip_angle_after"),
              0.02 * (number(original, "tip_angle_after") - number(original, "tip_angle_before")));
  // The optimum of the pillar is flat: the rounding of its delivered cavity, looked at between the
  // rounds, moves its vertices by some 1e-5, and not its objective.
  const Case& flat = caseNamed("pillar");
  const Result result =
      optimizeMassProperties(transformed(flat.model, Mat3::Identity(), shift), flat.options);
  EXPECT_NEAR(number(result, "objective_after"), number(resultOf(flat), "objective_after"), 1e-8);
}

TEST(Pipeline, GivesTheSameCavityWhicheverAxisIsUp) {
  // The model turned by a permutation of its axes, with signs: no coordinate is rounded anew.
  const TriangleMesh model = leaningPillar();
  const TriangleMesh& inner = resultOf(caseNamed("pillar")).inner;
  const std::vector<std::pair<UpAxis, Vec3>> axes = {
      {UpAxis::PlusY, {0, 1, 0}},   {UpAxis::PlusX, {1, 0, 0}},   {UpAxis::MinusZ, {0, 0, -1}},
      {UpAxis::MinusY, {0, -1, 0}}, {UpAxis::MinusX, {-1, 0, 0}},
  };
  for (const auto& [axis, up] : axes) {
    // Columns: where the model's x, y, z go. The one horizontal axis that follows `up` cyclically
    // is x for a positive axis; for a negative one it is y.
    Eigen::Index k = 0;
    up.cwiseAbs().maxCoeff(&k);
    Mat3 turn;
    turn.col(2) = up;
    const Vec3 next = Vec3::Unit((k + 1) % 3);
    const Vec3 afterNext = Vec3::Unit((k + 2) % 3);
    turn.col(0) = up[k] > 0 ? next : afterNext;
    turn.col(1) = up[k] > 0 ? afterNext : next;
    ASSERT_EQ(turn.determinant(), 1.0);
    Options options = stand();
    options.upAxis = axis;
    const Result result = optimizeMassProperties(transformed(model, turn), options);
    ASSERT_EQ(result.inner.vertices.rows(), inner.vertices.rows());
    EXPECT_EQ(result.inner.faces, inner.faces);
    // −0 and 0 are equal.
    EXPECT_EQ(result.inner.vertices, transformed(inner, turn).vertices) << up.transpose();
  }
}

TEST(Pipeline, AcceptsASurfaceThatFacesInwards) {
  const TriangleMesh& inner = resultOf(caseNamed("pillar")).inner;
  const Result result = optimizeMassProperties(reversed(leaningPillar()), stand());
  EXPECT_LT(quadratureMoments(result.inner)[0], 0.0);
  EXPECT_EQ(result.inner.vertices.rows(), inner.vertices.rows());
}

// ---------------------------------------------------------------- determinism

/// FNV-1a over all bytes of the cavity.
std::uint64_t fingerprint(const TriangleMesh& mesh) {
  std::uint64_t hash = 14695981039346656037ULL;
  const auto feed = [&](const void* data, std::size_t size) {
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (std::size_t i = 0; i < size; ++i) hash = (hash ^ bytes[i]) * 1099511628211ULL;
  };
  feed(mesh.vertices.data(), static_cast<std::size_t>(mesh.vertices.size()) * sizeof(double));
  feed(mesh.faces.data(), static_cast<std::size_t>(mesh.faces.size()) * sizeof(int));
  return hash;
}

/// An organic shape: its skeleton is where chance would come in.
std::uint64_t figureFingerprint() {
  return fingerprint(optimizeMassProperties(figure(2), stand()).inner);
}

TEST(Pipeline, IsTheSameBitForBitWhateverTheHeapLooksLike) {
  const std::uint64_t first = figureFingerprint();
  // Blocks of all small sizes, every other one freed, so that new ones get scattered addresses.
  std::vector<std::unique_ptr<char[]>> blocks;
  constexpr std::size_t kBlocks = 200000;
  blocks.reserve(kBlocks);
  Random random(31);
  for (std::size_t i = 0; i < kBlocks; ++i)
    blocks.push_back(std::make_unique<char[]>(static_cast<std::size_t>(16 + 120 * (1 + random()))));
  for (std::size_t i = 0; i < blocks.size(); i += 2) blocks[i].reset();
  EXPECT_EQ(figureFingerprint(), first);
}

/// Also what the next test reads from another process.
TEST(Pipeline, IsTheSameBitForBitTheSecondTime) {
  const std::uint64_t first = figureFingerprint();
  EXPECT_EQ(figureFingerprint(), first);
  std::printf("fingerprint %llu\n", static_cast<unsigned long long>(first));
}

TEST(Pipeline, IsTheSameBitForBitInAnotherProcess) {
  const std::string command = "MALLOC_PERTURB_=85 MALLOC_MMAP_THRESHOLD_=4096 /proc/self/exe "
                              "--gtest_filter=Pipeline.IsTheSameBitForBitTheSecondTime";
  // /proc/self/exe would be the shell's in the child.
  std::array<char, 4096> path{};
  ASSERT_GT(readlink("/proc/self/exe", path.data(), path.size() - 1), 0);
  std::string own = command;
  own.replace(own.find("/proc/self/exe"), std::strlen("/proc/self/exe"),
              "'" + std::string(path.data()) + "'");
  std::FILE* pipe = popen(own.c_str(), "r");
  ASSERT_NE(pipe, nullptr);
  unsigned long long other = 0;
  std::array<char, 256> line{};
  while (std::fgets(line.data(), line.size(), pipe) != nullptr) {
    std::sscanf(line.data(), "fingerprint %llu", &other);
  }
  EXPECT_EQ(pclose(pipe), 0);
  EXPECT_EQ(other, figureFingerprint());
}

// ---------------------------------------------------------------- parameters

TEST(Pipeline, KeepsAThickerWallWhenAsked) {
  Options options = stand();
  options.innerLowerBound = 0.1;
  const Result result = optimizeMassProperties(leaningPillar(), options);
  EXPECT_GE(number(result, "min_wall"), 0.099);
  EXPECT_LT(number(resultOf(caseNamed("pillar")), "min_wall"), 0.099);
}

TEST(Pipeline, LeavesMoreWithALowerUpperBound) {
  Options options = caseNamed("offset surface").options;
  options.innerUpperBound = 0.3;
  const Result result = optimizeMassProperties(leaningPillar(), options);
  EXPECT_GT(number(result, "gap_to_limit"),
            number(resultOf(caseNamed("offset surface")), "gap_to_limit"));
}

TEST(Pipeline, MovesTheOuterSurfaceWithinItsBoundsOutwardsAndNotItsFeet) {
  const Case& c = caseNamed("moving outer surface");
  const Result& result = resultOf(c);
  ASSERT_TRUE(result.outer.has_value());
  EXPECT_EQ(result.outer->faces, c.model.faces);
  const Vector moved = (result.outer->vertices - c.model.vertices).rowwise().norm();
  EXPECT_LE(moved.maxCoeff(), c.options.outerUpperBound * (1 + 1e-9));
  EXPECT_GT(moved.maxCoeff(), 1e-3);
  EXPECT_GT(quadratureMoments(*result.outer)[0], quadratureMoments(c.model)[0]);
  const double ground = c.model.vertices.col(2).minCoeff();
  EXPECT_GE(result.outer->vertices.col(2).minCoeff(), ground - 1e-9);
  for (Eigen::Index v = 0; v < moved.size(); ++v) {
    if (c.model.vertices(v, 2) <= ground) {
      EXPECT_LT(moved[v], 1e-9);
    }
  }
}

TEST(Pipeline, WeighsAsMuchAsTheWaterThatTheMovedOuterSurfaceDisplaces) {
  Options options;
  options.goal = GoalKind::Float;
  options.waterLevel = 1.0;
  const TriangleMesh model = transformed(blob(8), someRotation(), Vec3::Zero());
  const Result still = optimizeMassProperties(model, options);
  options.outerUpperBound = 0.1;
  const Result moved = optimizeMassProperties(model, options);
  ASSERT_TRUE(moved.outer.has_value());
  const double water = options.waterDensity / 1000.0;
  const double displaced = quadratureMoments(*moved.outer)[0];
  EXPECT_GT(displaced, 1.01 * quadratureMoments(model)[0]);
  EXPECT_TRUE(std::get<bool>(moved.report.at("solved")));
  EXPECT_NEAR(number(moved, "mass_after"), displaced * water, 2e-6 * displaced * water);
  EXPECT_NEAR(number(still, "mass_after"), quadratureMoments(model)[0] * water,
              2e-6 * displaced * water);
}

TEST(Pipeline, FillsTheMovedOuterSurfaceLessItsWalls) {
  Options options = stand();
  options.goal = GoalKind::StandEmptyAndFilled;
  options.fillDensity = 1.0;
  options.innerLowerBound = 0.08;
  const TriangleMesh model = leaningPillar();
  const Result still = optimizeMassProperties(model, options);
  options.outerUpperBound = 0.1;
  const Result moved = optimizeMassProperties(model, options);
  ASSERT_TRUE(moved.outer.has_value());
  EXPECT_LT(number(moved, "max_constraint_violation"),
            std::max(1e-6, number(still, "max_constraint_violation")));
  const auto outer = quadratureMoments(*moved.outer);
  const auto inner = quadratureMoments(moved.inner); // negative
  const auto filled = options.density * (outer + inner) - options.fillDensity * inner;
  const Vec3 centre(filled[1] / filled[0], filled[2] / filled[0], filled[3] / filled[0]);
  const ContactArea area = groundContact(model.vertices, {}).area;
  const Vec3 about = groundContact(model.vertices, {}).centre;
  EXPECT_NEAR(number(moved, "tip_angle_filled_after"), tippingAngle(area, centre - about), 1e-3);
}

/// An arm to one side below one to the other side, on a foot in the middle.
struct Armed {
  std::string name;
  std::vector<std::array<int, 3>> cells;
  double lean, fill, wall; ///< the wall as a share of the diagonal
};

void PrintTo(const Armed& armed, std::ostream* os) {
  *os << armed.name;
}

class StandsAtEveryLevel : public ::testing::TestWithParam<Armed> {};
INSTANTIATE_TEST_SUITE_P(
    Pipeline, StandsAtEveryLevel,
    ::testing::Values(
        Armed{"short_arms",
              {{-1, 0, 1}, {0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {1, 0, 2}},
              -0.015,
              0.63,
              0.019},
        Armed{"long_arms",
              {{-2, 0, 2}, {-1, 0, 2}, {0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {1, 0, 1}, {2, 0, 1}},
              0.028,
              0.59,
              0.0236}),
    [](const auto& test) { return test.param.name; });

/// With cavities for which only the empty and the full body count, both stand at both ends and fall
/// over by a degree when they are half full.
TEST_P(StandsAtEveryLevel, ThoughTheBestForTheEndsFallsOver) {
  const Armed& armed = GetParam();
  const TriangleMesh model =
      transformed(scaled(smoothed(polycube(armed.cells, 5), 2), 20.0), shear(armed.lean));
  Options options;
  options.goal = GoalKind::StandEmptyAndFilled;
  options.density = 1.0;
  options.fillDensity = armed.fill;
  options.innerLowerBound = armed.wall * diagonal(model);
  const Result result = optimizeMassProperties(model, options);
  EXPECT_TRUE(truth(result, "solved")) << text(result, "message");
  const double least = leastTippingAngle(model, result.inner, armed.fill);
  const double solid = number(result, "tip_angle_empty_before");
  const double limit = number(result, "tip_angle_filling_limit");
  EXPECT_GT(least, solid + 0.8 * (limit - solid));
  EXPECT_LT(least, limit);
  // Between the heights at which it cuts the cavity the report bounds the angle from below.
  EXPECT_LE(number(result, "tip_angle_filling_after"), least + 1e-6);
  EXPECT_GE(number(result, "tip_angle_filling_after"), least - 0.2);
}

TEST(Pipeline, LeavesTheOuterSurfaceAloneByDefault) {
  EXPECT_FALSE(resultOf(caseNamed("pillar")).outer.has_value());
}

TEST(Pipeline, SavesMaterialWhenVolumeHasWeight) {
  Options options = stand();
  options.weights.volume = 10.0;
  const Result result = optimizeMassProperties(leaningPillar(), options);
  EXPECT_LT(number(result, "volume_after"),
            0.9 * number(resultOf(caseNamed("pillar")), "volume_after"));
}

TEST(Pipeline, MovesTheOuterSurfaceLessWhenItsDisplacementHasWeight) {
  const Case& c = caseNamed("moving outer surface");
  Options options = c.options;
  options.weights.outer = 1e3;
  const Result heavy = optimizeMassProperties(c.model, options);
  const auto meanSquare = [&](const Result& r) {
    return (r.outer->vertices - c.model.vertices).squaredNorm();
  };
  EXPECT_LT(meanSquare(heavy), 0.5 * meanSquare(resultOf(c)));
}

TEST(Pipeline, GivesEveryVertexOfTheCavityItsOwnWall) {
  const TriangleMesh model = box({1, 1.5, 2}, 6);
  Options options;
  options.goal = GoalKind::Mass;
  options.targetMass = 0.0025;
  const Result result = optimizeMassProperties(model, options);
  ASSERT_GT(result.inner.vertices.rows(), 0);
  const Eigen::RowVector3d lower = model.vertices.colwise().minCoeff();
  const Eigen::RowVector3d upper = model.vertices.colwise().maxCoeff();
  ASSERT_EQ(result.innerWall.size(), result.inner.vertices.rows());
  const double tolerance = 1e-9 * diagonal(model); // the working frame rounds coordinates
  for (Eigen::Index v = 0; v < result.innerWall.size(); ++v) {
    const Eigen::RowVector3d p = result.inner.vertices.row(v);
    const double toSides = std::min((p - lower).minCoeff(), (upper - p).minCoeff());
    EXPECT_NEAR(result.innerWall[v], toSides, tolerance);
  }
  EXPECT_LE(number(result, "min_wall"), result.innerWall.minCoeff() + tolerance);
}

TEST(Pipeline, LeavesAWallAsThickEverywhereAsTheMassAsksFor) {
  const double side = 20.0;
  Options options;
  options.goal = GoalKind::Mass;
  options.cavityShape = CavityShape::BestPossible;
  options.density = 1.0;
  for (const double wall : {1.0, 3.0, 7.0}) {
    const double hollow = std::pow(side - 2.0 * wall, 3);
    options.targetMass = (std::pow(side, 3) - hollow) / 1000.0;
    const Result result = optimizeMassProperties(box(Vec3::Constant(side), 6), options);
    EXPECT_TRUE(std::get<bool>(result.report.at("solved")));
    const double volume = -quadratureMoments(result.inner)[0];
    EXPECT_NEAR(volume, hollow, 1e-6 * std::pow(side, 3));
    // Nowhere thinner, and nowhere thicker but at the corners, which a ball does not fill.
    EXPECT_NEAR(result.innerWall.minCoeff(), wall, 0.01 * wall);
    EXPECT_NEAR(result.innerWall.mean(), wall, 0.03 * wall);
  }
}

TriangleMesh upperFaces(const TriangleMesh& mesh, double height) {
  Faces upper(mesh.faces.rows(), 3);
  Eigen::Index rows = 0;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    const auto corners = mesh.faces.row(f);
    const bool isUpper = std::all_of(corners.begin(), corners.end(),
                                     [&](int v) { return mesh.vertices(v, 2) >= height; });
    if (isUpper) upper.row(rows++) = corners;
  }
  return {mesh.vertices, upper.topRows(rows)};
}

TEST(Pipeline, KeepsAPlateUnderSelectedFacesSolid) {
  const double side = 20.0;
  const double wall = 1.0;
  const TriangleMesh model = box(Vec3::Constant(side), 8);
  Options options;
  options.goal = GoalKind::Mass;
  options.innerLowerBound = wall;
  options.keptSolid = upperFaces(model, model.vertices.col(2).maxCoeff());
  ASSERT_EQ(options.keptSolid.faces.rows(), 128);
  for (const std::optional<double>& depth : {std::optional<double>(), std::optional(6.5)}) {
    options.solidDepth = depth;
    const double solid = depth.value_or(4.0 * wall);
    const double inside = side - 2.0 * wall;
    const double hollow = inside * inside * (side - wall - solid);
    for (const CavityShape shape : {CavityShape::Offset, CavityShape::BestPossible}) {
      options.cavityShape = shape;
      const Result result = optimizeMassProperties(model, options);
      ASSERT_GT(result.inner.vertices.rows(), 0);
      const double top = result.inner.vertices.col(2).maxCoeff();
      EXPECT_LE(top, model.vertices.col(2).maxCoeff() - solid);
      EXPECT_NEAR(number(result, "solid_depth"), model.vertices.col(2).maxCoeff() - top, 1e-9);
      EXPECT_GE(number(result, "min_wall"), wall);
      EXPECT_LT(number(result, "min_wall"), 1.01 * wall);
      const double share = -quadratureMoments(result.inner)[0] / hollow;
      EXPECT_LE(share, 1.0);
      // The opening rounds the corners; an offset surface leaves more.
      EXPECT_GE(share, shape == CavityShape::BestPossible ? 0.985 : 0.7);
    }
  }
}

TEST(Pipeline, KeepsEveryCavityAwayFromSelectedFaces) {
  Options options;
  for (const GoalKind goal : {GoalKind::Stand, GoalKind::Spin, GoalKind::Mass}) {
    options.goal = goal;
    for (const CavityShape shape : {CavityShape::Offset, CavityShape::BestPossible}) {
      options.cavityShape = shape;
      const TriangleMesh model = figure(2);
      const double size = diagonal(model);
      options.keptSolid = upperFaces(model, 0.7 * model.vertices.col(2).maxCoeff());
      ASSERT_GT(options.keptSolid.faces.rows(), 10);
      options.solidDepth = 0.07 * size;
      const Result result = optimizeMassProperties(model, options);
      ASSERT_GT(result.inner.faces.rows(), 0);
      const double apart = separation(result.inner, options.keptSolid).least;
      EXPECT_GE(apart, *options.solidDepth * (1.0 - 1e-9));
      EXPECT_NEAR(number(result, "solid_depth"), apart, 1e-7 * size);
      EXPECT_LT(number(result, "min_wall"), 0.02 * size);
      options.keptSolid = {};
      const Result free = optimizeMassProperties(model, options);
      EXPECT_GE(std::abs(quadratureMoments(free.inner)[0]),
                std::abs(quadratureMoments(result.inner)[0]));
    }
  }
}

TEST(Pipeline, HasEveryMassBetweenTheLightestBodyAndTheSolidOne) {
  Options options;
  options.goal = GoalKind::Mass;
  const TriangleMesh model = figure(2);
  const Result lightest = optimizeMassProperties(model, options);
  const double least = number(lightest, "mass_after");
  const double solid = number(lightest, "mass_before");
  for (const double share : {0.03, 0.5, 0.9, 0.98}) {
    options.targetMass = least + share * (solid - least);
    for (const CavityShape shape : {CavityShape::Automatic, CavityShape::BestPossible}) {
      options.cavityShape = shape;
      const Result result = optimizeMassProperties(model, options);
      EXPECT_TRUE(std::get<bool>(result.report.at("solved"))) << share;
      EXPECT_TRUE(std::get<bool>(result.report.at("weighs_target_limit"))) << share;
    }
  }
}

TEST(Pipeline, SaysThatThePrintMustBeDense) {
  EXPECT_EQ(text(resultOf(caseNamed("pillar")), "print_as").rfind("dense: 100 % infill", 0), 0U);
}

TEST(Pipeline, MakesSmootherOffsetsWhenSmoothnessHasWeight) {
  // The mean square of the wall's slope along the cavity's edges, long ones counting more.
  const TriangleMesh model = leaningPillar();
  const auto roughness = [&](const Result& r) {
    double sum = 0.0;
    double squares = 0.0;
    for (Eigen::Index f = 0; f < r.inner.faces.rows(); ++f) {
      for (int k = 0; k < 3; ++k) {
        const int v = r.inner.faces(f, k);
        const int w = r.inner.faces(f, (k + 1) % 3);
        sum += std::pow(r.innerWall[v] - r.innerWall[w], 2);
        squares += (r.inner.vertices.row(v) - r.inner.vertices.row(w)).squaredNorm();
      }
    }
    return sum / squares;
  };
  Options options = caseNamed("offset surface").options;
  options.weights.smoothness = 1.0;
  const Result smooth = optimizeMassProperties(model, options);
  EXPECT_LT(roughness(smooth), 0.5 * roughness(resultOf(caseNamed("offset surface"))));
}

TEST(Pipeline, MayMissTheConstraintsWhenTheyHaveNoWeightAndSaysSo) {
  // Without constraints the weight on inertia alone has no reason to bring the axis upright.
  Options options = spin();
  options.weights.constraints = 0.0;
  const Result result = optimizeMassProperties(leaningTop(0.1, 9), options);
  EXPECT_GT(number(result, "max_constraint_violation"), 1e-5);
  EXPECT_FALSE(truth(result, "solved"));
}

TEST(Pipeline, ReachesLessWithFewerBasisFunctions) {
  Options options = caseNamed("offset surface").options;
  options.basisSize = 1;
  const Result constant = optimizeMassProperties(leaningPillar(), options);
  EXPECT_GT(number(constant, "objective_after"),
            number(resultOf(caseNamed("offset surface")), "objective_after"));
}

TEST(Pipeline, StandsOnTheEllipseWhenRadiiAreGiven) {
  Options options = stand();
  options.radiusX = 5.0;
  options.radiusY = 5.0;
  const Result wide = optimizeMassProperties(leaningPillar(), options);
  EXPECT_TRUE(truth(wide, "stands_before"));
}

TEST(Pipeline, HasAMassProportionalToTheDensityAndTheSameCavity) {
  Options options = stand();
  options.density = 2.48;
  const Result result = optimizeMassProperties(leaningPillar(), options);
  const Result& original = resultOf(caseNamed("pillar"));
  EXPECT_EQ(result.inner.vertices, original.inner.vertices);
  EXPECT_NEAR(number(result, "mass_after"), 2 * number(original, "mass_after"), 1e-12);
}

TEST(Pipeline, DeliversAndMeasuresWhatTheCallerCanStore) {
  Options options = stand();
  options.representable = [](const Points& points) {
    return Points(points.cast<float>().cast<double>());
  };
  // Far away a float has a step of 6e-5 there: a quarter of a percent of the wall.
  const TriangleMesh model = transformed(leaningPillar(), Mat3::Identity(), {600, 700, 800});
  TriangleMesh stored = model;
  stored.vertices = options.representable(model.vertices);
  const Case c{"floats", stored, options};
  const Result& result = resultOf(c);
  EXPECT_EQ(result.inner.vertices, options.representable(result.inner.vertices));
  const Vec3 origin = stored.vertices.colwise().mean().transpose();
  const Body body = bodyOf(massMomentsOf(c, origin, false));
  EXPECT_NEAR(number(result, "mass_after"), body.mass, 1e-8 * body.mass);
  EXPECT_NEAR(number(result, "min_wall"), leastDistance(result.inner, stored), 1e-9);
  EXPECT_EQ(intersectingPairs(result.inner), 0U);
}

TEST(Pipeline, ComparesWithTheBoundWithoutSmoothness) {
  // For Mass without a target the objective is (m/m_solid)². The bound does not know the offsets,
  // so that what their smoothness costs is no part of the gap.
  Options options;
  options.goal = GoalKind::Mass;
  options.cavityShape = CavityShape::Offset;
  options.weights.smoothness = 0.05;
  const Report report = optimizeMassProperties(blob(5), options).report;
  const auto number = [&](const char* key) { return std::get<double>(report.at(key)); };
  const double share = number("mass_after") / number("mass_before");
  const double limit = number("objective_limit");
  ASSERT_GT(number("objective_after"), share * share); // smoothness costs something
  EXPECT_NEAR(number("gap_to_limit"), (share - std::sqrt(limit)) / (1.0 - std::sqrt(limit)), 1e-9);
}

TEST(Pipeline, KnowsTheLargestWallThatLeavesRoomForABestPossibleCavity) {
  Options options;
  options.goal = GoalKind::Mass;
  options.cavityShape = CavityShape::BestPossible;
  options.innerLowerBound = 0.45;
  const Result result = optimizeMassProperties(box({1, 1, 1}, 6), options);
  ASSERT_EQ(std::get<int>(result.report.at("cavity_components")), 0);
  const std::string message = text(result, "message");
  const std::string before = "lower inner_lower_bound to ";
  const std::size_t place = message.find(before);
  ASSERT_NE(place, std::string::npos) << message;
  // A ball as wide as the wall fits behind it up to a third of the cube's side; of what one does
  // that is a twentieth smaller, 0.5 / (1 + 0.95 / 2), it is 95 %.
  const double wall = std::stod(message.substr(place + before.size()));
  EXPECT_GT(wall, 0.875 / 3.0);
  EXPECT_LE(wall, 1.0 / 3.0);
}

TEST(Pipeline, SaysWhatToDoWhereALibraryGivesUp) {
  // CGAL's failures are logic errors.
  Options options;
  options.goal = GoalKind::Mass;
  options.representable = [](const Points& points) -> Points {
    if (points.rows() > 0) throw std::logic_error("CGAL ERROR: precondition violation!");
    return points;
  };
  try {
    optimizeMassProperties(blob(5), options);
    FAIL() << "nothing was thrown";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("Isotropic Explicit Remeshing"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("precondition"), std::string::npos);
  }
}

TEST(Pipeline, TellsItsProgressInOrder) {
  for (const CavityShape shape : {CavityShape::Automatic, CavityShape::Offset}) {
    std::vector<int> percents;
    std::vector<std::string> stages;
    Options options = stand();
    options.cavityShape = shape;
    optimizeMassProperties(leaningPillar(), options, [&](int percent, const char* stage) {
      percents.push_back(percent);
      stages.emplace_back(stage);
    });
    // The check, the best possible cavity, the report and the end; an offset surface has more.
    ASSERT_GE(percents.size(), shape == CavityShape::Offset ? 5U : 4U);
    EXPECT_TRUE(std::is_sorted(percents.begin(), percents.end()));
    EXPECT_GE(percents.front(), 0);
    EXPECT_EQ(percents.back(), 100);
    for (const std::string& stage : stages) EXPECT_FALSE(stage.empty());
  }
}

/// Of the cavity.
Vec3 centreOfCavity(const Result& result) {
  const auto m = quadratureMoments(result.inner);
  return m.segment<3>(1) / m[0]; // both negative, as the normals point inwards
}

TEST(Pipeline, AFillingHeavierThanTheMaterialInvertsTheOptimum) {
  Options heavy = stand();
  heavy.density = 1.0;
  heavy.fillDensity = 8.0;
  const TriangleMesh model = leaningPillar();
  const Result filled = optimizeMassProperties(model, heavy);
  const Result& empty = resultOf(caseNamed("pillar"));
  // The cavity that lightens lies in the upper part that leans over, the one that weighs below.
  const Vec3 centre = point(empty, "center_of_mass_before");
  EXPECT_GT(centreOfCavity(empty).z(), centre.z() + 0.1);
  EXPECT_LT(centreOfCavity(filled).z(), centre.z() - 0.1);
  EXPECT_TRUE(truth(filled, "solved"));
  EXPECT_GT(number(filled, "tip_angle_after"), 0.0);
  EXPECT_GT(number(filled, "mass_after"), number(filled, "mass_before"));
}

TEST(Pipeline, AnInfillIsAFillingOfThatShareOfTheMaterial) {
  const TriangleMesh model = leaningPillar();
  Options printed = stand();
  printed.density = 2.0;
  printed.cavityInfill = 0.25;
  Options filled = stand();
  filled.density = 2.0;
  filled.fillDensity = 0.5;
  const Result a = optimizeMassProperties(model, printed);
  const Result b = optimizeMassProperties(model, filled);
  EXPECT_EQ(a.inner.vertices, b.inner.vertices);
  EXPECT_EQ(number(a, "mass_after"), number(b, "mass_after"));
  EXPECT_EQ(number(a, "tip_angle_limit"), number(b, "tip_angle_limit"));
  EXPECT_NE(std::get<std::string>(a.report.at("print_as")).find("25 %"), std::string::npos);
}

TEST(Pipeline, EveryGoalIsReachedWithALightAndAHeavyFilling) {
  const TriangleMesh model = transformed(roundedBox({1, 1, 2}, 0.15, 6, 2), shear(0.03));
  for (std::size_t goal = 0; goal < goalNames().size(); ++goal) {
    for (const bool heavy : {false, true}) {
      Options options;
      options.goal = static_cast<GoalKind>(goal);
      options.density = 1.0;
      options.fillDensity = heavy ? 2.0 : 0.3;
      // Floating on its side, and weighing as much as nine tenths or five quarters of the solid do.
      if (options.goal == GoalKind::Float) options.upAxis = UpAxis::PlusY;
      options.spinSpeed = 1e5;   // a top of 2 mm
      options.waterLevel = 0.85; // a square log half under water is unstable
      options.waterDensity = heavy ? 1.47 : 1.06;
      options.targetMass = (heavy ? 1.25 : 0.9) * quadratureMoments(model)[0] / 1000;
      const Result result = optimizeMassProperties(model, options);
      const std::string name = goalNames()[goal] + (heavy ? ", heavy" : ", light");
      if (options.goal == GoalKind::StandEmptyAndFilled && heavy) {
        // Twice as heavy as the material it replaces, the filling adds what the empty cavity takes
        // away: what helps in one state does as much harm in the other.
        EXPECT_EQ(result.inner.faces.rows(), 0) << name;
        EXPECT_TRUE(truth(result, "solved")) << name;
        continue;
      }
      ASSERT_GT(result.inner.faces.rows(), 0) << name;
      EXPECT_EQ(intersectingPairs(result.inner), 0U) << name;
      if (options.goal == GoalKind::RollUpright) { // a pillar lies on its sides, too
        EXPECT_LT(number(result, "objective_after"), number(result, "objective_before")) << name;
        EXPECT_GT(integer(result, "resting_faces_after"), 1) << name;
      } else {
        EXPECT_TRUE(truth(result, "solved")) << name << ": " << text(result, "message");
      }
    }
  }
}

TEST(Pipeline, TheOuterSurfaceMovesAloneWhereTheWallLeavesNoRoom) {
  // Leans 0.02 beyond the border of its foot.
  const TriangleMesh model = transformed(roundedBox({1, 1, 2}, 0.15, 6, 2), shear(0.37));
  Options options = stand();
  options.innerLowerBound = 0.6; // more than half of its width
  options.outerUpperBound = 0.15;
  const Result result = optimizeMassProperties(model, options);
  EXPECT_EQ(result.inner.faces.rows(), 0);
  ASSERT_TRUE(result.outer);
  EXPECT_EQ(result.outer->faces, model.faces);
  EXPECT_EQ(intersectingPairs(*result.outer), 0U);
  EXPECT_LT(number(result, "objective_after"), number(result, "objective_before"));
  EXPECT_GT(number(result, "tip_angle_after"), number(result, "tip_angle_before") + 0.5);
  EXPECT_GT(number(result, "volume_after"), number(result, "volume_before"));
  EXPECT_EQ(number(result, "min_wall"), 0.0);
  EXPECT_NE(text(result, "message").find("outer surface alone"), std::string::npos);
  const Body body = bodyOf(quadratureMoments(*result.outer));
  EXPECT_LT((point(result, "center_of_mass_after") - body.centre).norm(), 1e-8);
}

// ---------------------------------------------------------------- refusals

void expectRefusal(const TriangleMesh& model, const Options& options, const std::string& word) {
  try {
    optimizeMassProperties(model, options);
    ADD_FAILURE() << "accepted; expected a refusal that names " << word;
  } catch (const InvalidInput& e) {
    EXPECT_NE(std::string(e.what()).find(word), std::string::npos) << e.what();
  }
}

TEST(Pipeline, RefusesAbsurdParametersByName) {
  const TriangleMesh model = leaningPillar();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto with = [](const std::function<void(Options&)>& change) {
    Options options;
    change(options);
    return options;
  };
  const std::vector<std::pair<Options, std::string>> absurd = {
      {with([](Options& o) { o.basisSize = 0; }), "basis_k"},
      {with([](Options& o) { o.basisSize = -3; }), "basis_k"},
      {with([](Options& o) { o.cavityShape = CavityShape::Offset, o.basisSize = 20000; }),
       "basis_k"},
      {with([](Options& o) { o.radiusX = -1.0, o.radiusY = 1.0; }), "radius_x"},
      {with([](Options& o) { o.radiusX = 1.0; }), "radius_y"},
      {with([](Options& o) { o.innerLowerBound = -0.1; }), "inner_lower_bound"},
      {with([&](Options& o) { o.innerLowerBound = nan; }), "inner_lower_bound"},
      {with([](Options& o) { o.innerLowerBound = 100.0; }), "inner_lower_bound"},
      {with([](Options& o) { o.innerUpperBound = 0.0; }), "inner_upper_bound"},
      {with([](Options& o) { o.innerUpperBound = 1.5; }), "inner_upper_bound"},
      {with([](Options& o) { o.outerLowerBound = 0.2, o.outerUpperBound = 0.1; }),
       "outer_lower_bound"},
      {with([](Options& o) { o.outerUpperBound = -0.1; }), "outer_upper_bound"},
      {with([](Options& o) { o.outerUpperBound = 100.0; }), "outer_upper_bound"},
      {with([](Options& o) { o.weights.volume = -1.0; }), "opt_weight"},
      {with([&](Options& o) { o.weights.outer = nan; }), "opt_weight"},
      {with([](Options& o) { o.density = -1.24; }), "density"},
      {with([](Options& o) { o.density = 0.0; }), "density"},
      {with([](Options& o) { o.fillDensity = -1.0; }), "fill_density"},
      {with([](Options& o) { o.cavityInfill = -0.1; }), "cavity_infill"},
      {with([](Options& o) { o.cavityInfill = 1.0; }), "cavity_infill"},
      {with([&](Options& o) { o.cavityInfill = nan; }), "cavity_infill"},
      {with([](Options& o) { o.goal = GoalKind::StandEmptyAndFilled; }), "fill_density"},
      {with([](Options& o) { o.goal = GoalKind::YoYo, o.basisSize = 4; }), "basis_k"},
      {with([](Options& o) { o.waterLevel = 0.0; }), "water_level"},
      {with([](Options& o) { o.waterLevel = 1.1; }), "water_level"},
      {with([&](Options& o) { o.waterDensity = nan; }), "water_density"},
      {with([&](Options& o) { o.spinSpeed = 0.0; }), "spin_speed"},
      {with([&](Options& o) { o.spinSpeed = nan; }), "spin_speed"},
      {with([](Options& o) { o.targetMass = -1.0; }), "target_mass"},
      {with([&](Options& o) { o.pivot = Vec3(nan, 0, 0); }), "pivot"},
      {with([](Options& o) { o.pivot = Vec3(0, 0, 1e3); }), "pivot"},
  };
  for (const auto& [options, word] : absurd) expectRefusal(model, options, word);
}

TEST(Pipeline, RefusesASurfaceThatCrossesItself) {
  TriangleMesh model = box({1, 1, 1}, 4);
  // The middle of the top pulled out through a side.
  for (Eigen::Index v = 0; v < model.vertices.rows(); ++v) {
    if (model.vertices.row(v) == Eigen::RowVector3d(0, 0, 0.5))
      model.vertices.row(v) << 0.8, 0.1, 0;
  }
  Options options = stand();
  options.mend = false;
  expectRefusal(model, options, "crosses itself");
}

TEST(Pipeline, RefusesToStandOnAPoint) {
  Options options = stand();
  options.foot = FootCut::Never;
  expectRefusal(sphere(6), options, "radius_x");
}

} // namespace
} // namespace massprops::testing
