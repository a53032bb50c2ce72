// What the answer looks like: marks, and bodies cut open.
#include "core/answer/cutaway.h"
#include "core/answer/picture.h"
#include "core/goals/mass.h"
#include "core/mesh/annotations.h"
#include "core/model/posed_model.h"
#include "core/model/repair.h"
#include "core/physics/hydrostatics.h"
#include "core/physics/moments.h"
#include "core/pipeline.h"
#include "core/reduced/cavity_search.h"

#include "judge/checks.h"
#include "samples.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace massprops::testing {
namespace {

constexpr double kPi = 3.14159265358979323846;

bool isColour(Colour a, Colour b) {
  return a.red == b.red && a.green == b.green && a.blue == b.blue;
}

/// The faces whose vertices have that colour; all vertices.
TriangleMesh partOf(const ColouredMesh& whole, Colour colour) {
  TriangleMesh part{whole.mesh.vertices, {}};
  for (Eigen::Index f = 0; f < whole.mesh.faces.rows(); ++f) {
    const auto corner = static_cast<std::size_t>(whole.mesh.faces(f, 0));
    if (!isColour(whole.colours[corner], colour)) continue;
    part.faces.conservativeResize(part.faces.rows() + 1, 3);
    part.faces.row(part.faces.rows() - 1) = whole.mesh.faces.row(f);
  }
  return part;
}

double areaOf(const TriangleMesh& mesh) {
  double area = 0.0;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    const Vec3 a = mesh.vertices.row(mesh.faces(f, 0)).transpose();
    const Vec3 b = mesh.vertices.row(mesh.faces(f, 1)).transpose();
    const Vec3 c = mesh.vertices.row(mesh.faces(f, 2)).transpose();
    area += 0.5 * (b - a).cross(c - a).norm();
  }
  return area;
}

Vec3 middleOf(const TriangleMesh& mesh) {
  Vec3 low = Vec3::Constant(1e300);
  Vec3 high = -low;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    for (const int v : mesh.faces.row(f)) {
      low = low.cwiseMin(mesh.vertices.row(v).transpose());
      high = high.cwiseMax(mesh.vertices.row(v).transpose());
    }
  }
  return 0.5 * (low + high);
}

TEST(Annotations, BallsAndLinesAreClosedAndAsLargeAsTheyShouldBe) {
  const TriangleMesh body = box({3.0, 2.0, 6.0}); // diagonal 7
  Annotations ball(body.vertices);
  ball.addBall({1.0, 2.0, 3.0}, kAfterColour);
  EXPECT_TRUE(isClosedAndOriented(ball.mesh().mesh));
  const Body measured = bodyOf(quadratureMoments(ball.mesh().mesh));
  const double radius = 0.015 * 7.0;
  // The inscribed polyhedron with 24 meridians and 12 zones is some per cent smaller.
  EXPECT_NEAR(measured.mass, 4.0 / 3.0 * kPi * std::pow(radius, 3), 0.06 * measured.mass);
  EXPECT_LT((measured.centre - Vec3(1.0, 2.0, 3.0)).norm(), 1e-9);

  Annotations line(body.vertices);
  line.addLine({0.0, 0.0, 0.0}, {0.0, 3.0, 4.0}, kBeforeColour);
  line.addLine({1.0, 1.0, 1.0}, {1.0, 1.0, 1.0}, kBeforeColour);
  EXPECT_TRUE(isClosedAndOriented(line.mesh().mesh));
  const double pen = 0.003 * 7.0;
  EXPECT_NEAR(quadratureMoments(line.mesh().mesh)[0], 5.0 * 1.5 * std::sqrt(3.0) * pen * pen, 1e-9);
  for (const Colour colour : line.mesh().colours) EXPECT_TRUE(isColour(colour, kBeforeColour));
}

/// A body with a cavity; the cavity's vertices come first.
TriangleMesh material(const TriangleMesh& outer, const TriangleMesh& inner) {
  return joined(reversed(inner), outer);
}

TEST(Cutaway, HalvesTheMaterialOfAHollowBox) {
  const TriangleMesh outer = box({4.0, 6.0, 8.0}, 5);
  const TriangleMesh inner = box({2.0, 3.0, 4.0}, 3);
  // A plane that meets no vertex.
  const Vec3 point(0.0, 0.3, 0.0);
  const Vec3 normal(0.0, 2.0, 0.0);
  const ColouredMesh half =
      cutaway(material(outer, inner), inner.vertices.rows(), point, normal).value();
  EXPECT_LE(half.mesh.vertices.col(1).maxCoeff(), 0.3 + 1e-12);

  const TriangleMesh cut = partOf(half, kCutColour);
  EXPECT_NEAR(areaOf(cut), 4.0 * 8.0 - 2.0 * 4.0, 1e-9);
  EXPECT_NEAR(areaOf(partOf(half, kOuterColour)), 4.0 * 8.0 + 2.0 * (4.0 + 8.0) * 3.3, 1e-9);
  EXPECT_NEAR(areaOf(partOf(half, kCavityColour)), 2.0 * 4.0 + 2.0 * (2.0 + 4.0) * 1.8, 1e-9);
  EXPECT_NEAR(moments(half.mesh.vertices, half.mesh.faces)[0], 4.0 * 8.0 * 3.3 - 2.0 * 4.0 * 1.8,
              1e-9);
  EXPECT_TRUE(isClosedAndOriented(mergedAndCompacted(half.mesh).mesh));
}

TEST(Cutaway, CutsThroughVerticesAndSolidBodies) {
  const ColouredMesh half =
      cutaway(box({2.0, 2.0, 2.0}, 4), 0, Vec3::Zero(), Vec3::UnitX()).value();
  EXPECT_NEAR(areaOf(partOf(half, kCutColour)), 4.0, 1e-9);
  EXPECT_EQ(partOf(half, kCavityColour).faces.rows(), 0);
  EXPECT_NEAR(moments(half.mesh.vertices, half.mesh.faces)[0], 4.0, 1e-9);
  const auto nothing = cutaway(box({1.0, 1.0, 1.0}), 0, {-1.0, 0.0, 0.0}, Vec3::UnitX());
  EXPECT_EQ(nothing.value().mesh.faces.rows(), 0);
}

/// A prism along z whose half with y > 0 is two legs that hang together by an edge on the z axis.
TriangleMesh arch() {
  TriangleMesh mesh;
  const std::vector<Vec2> outline = {{-2, -1}, {2, -1}, {2, 1}, {1, 1}, {0, 0}, {-1, 1}, {-2, 1}};
  const int n = static_cast<int>(outline.size());
  mesh.vertices.resize(2 * n, 3);
  for (int i = 0; i < n; ++i) {
    const Vec2& p = outline[static_cast<std::size_t>(i)];
    mesh.vertices.row(i) << p.x(), p.y(), 0.0;
    mesh.vertices.row(n + i) << p.x(), p.y(), 1.0;
  }
  const std::vector<std::array<int, 3>> top = {
      {0, 1, 4}, {1, 2, 3}, {1, 3, 4}, {0, 4, 5}, {0, 5, 6}};
  std::vector<std::array<int, 3>> all;
  for (const auto& [a, b, c] : top) {
    all.push_back({n + a, n + b, n + c});
    all.push_back({a, c, b});
  }
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    all.push_back({i, j, n + j});
    all.push_back({i, n + j, n + i});
  }
  mesh.faces.resize(static_cast<Eigen::Index>(all.size()), 3);
  for (std::size_t f = 0; f < all.size(); ++f) {
    mesh.faces.row(static_cast<Eigen::Index>(f)) << all[f][0], all[f][1], all[f][2];
  }
  return mesh;
}

TEST(Cutaway, PartsWhatWouldHangTogetherByAnEdge) {
  const TriangleMesh whole = arch();
  ASSERT_TRUE(isClosedAndOriented(whole));
  ASSERT_EQ(intersectingPairs(whole), 0U);
  for (const double side : {-1.0, 1.0}) {
    const ColouredMesh half = cutaway(whole, 0, Vec3::Zero(), side * Vec3::UnitY()).value();
    EXPECT_TRUE(isClosedAndOriented(mergedAndCompacted(half.mesh).mesh));
    EXPECT_NEAR(moments(half.mesh.vertices, half.mesh.faces)[0], side < 0.0 ? 3.0 : 4.0, 1e-9);
  }
}

TEST(PictureOf, SaysWhyThereIsNone) {
  // The outer surface alone was moved, and crosses itself: no plane near its centre of mass can be
  // cut along.
  const TriangleMesh bar = box({1.0, 1.0, 6.0}, 2);
  TriangleMesh other = bar;
  other.vertices.rowwise() += Eigen::RowVector3d(0.3, 0.3, 0.1);
  const TriangleMesh whole = joined(bar, other);
  PosedModel posed;
  posed.vertices = whole.vertices;
  posed.faces = whole.faces;
  const TriangleTree surface(whole.vertices, whole.faces);
  const std::unique_ptr<Goal> goal = makeMassGoal(1.0, std::nullopt, Weights{});
  const std::unique_ptr<Verdict> verdict = makeMassVerdict(std::nullopt, 1.0);
  CavityTask task{surface, *goal, {}};
  task.model.surface = std::make_shared<MovingSurface>(MovingSurface{whole.vertices, whole.faces});
  task.model.solidMoments << 1, 0, 0, 0.5, 1, 1, 1, 0, 0, 0;
  task.inputMoments << 1, 0.1, 0, 0.5, 1, 1, 1, 0, 0, 0;
  CavityResult cavity;
  cavity.status = CavityStatus::Found;
  cavity.inner = Points::Zero(whole.vertices.rows(), 3);
  cavity.outer = whole.vertices;
  const PictureResult drawn = pictureOf(posed, task, *verdict, cavity);
  EXPECT_FALSE(drawn.picture);
  EXPECT_EQ(drawn.failure.rfind("could not be drawn: ", 0), 0U) << drawn.failure;
}

TEST(LevelLines, GoRoundTheBody) {
  const TriangleMesh ball = sphere(20);
  const double level = 0.4;
  double length = 0.0;
  for (const auto& [from, to] : levelLines(ball.vertices, ball.faces, Vec3::UnitX(), level)) {
    EXPECT_NEAR(from.x(), level, 1e-12);
    EXPECT_NEAR(to.x(), level, 1e-12);
    length += (to - from).norm();
  }
  const double circle = 2.0 * kPi * std::sqrt(1.0 - level * level);
  EXPECT_NEAR(length, circle, 0.01 * circle); // chords
}

struct Sight {
  const char* sample;
  GoalKind goal;
  const char* name;
};

class EveryGoal : public ::testing::TestWithParam<Sight> {};
INSTANTIATE_TEST_SUITE_P(
    Picture, EveryGoal,
    ::testing::Values(
        Sight{"tilted_ellipsoid_top", GoalKind::Stand, "centre of mass and contact area"},
        Sight{"tilted_ellipsoid_top", GoalKind::Spin, "centre of mass and axis"},
        Sight{"uneven_yo_yo", GoalKind::YoYo, "centre of mass and axis"},
        Sight{"leaning_jar", GoalKind::StandEmptyAndFilled, "centre of mass and contact area"},
        Sight{"roly_poly", GoalKind::RollUpright, "centre of mass and contact area"},
        Sight{"bath_duck", GoalKind::Float, "centre of mass and waterline"},
        Sight{"hanging_fish", GoalKind::Hang, "centre of mass and plumb line"},
        Sight{"game_piece", GoalKind::Mass, "centre of mass"}),
    [](const auto& test) { return std::string(test.param.sample) + std::to_string(test.index); });

TEST_P(EveryGoal, ShowsBothCentresOfMassAndWhatTheyAreJudgedBy) {
  const TriangleMesh model = sampleMesh(GetParam().sample);
  Options options;
  options.goal = GetParam().goal;
  options.fillDensity = 0.6;
  options.waterLevel = 0.4;
  options.targetMass = 15.0;
  options.showAnswer = true;
  options.cavityShape = CavityShape::Offset;
  const Result result = optimizeMassProperties(model, options);
  ASSERT_TRUE(result.picture);
  const Picture& picture = *result.picture;
  const ColouredMesh& cutOpen = picture.cutOpen;
  const ColouredMesh& marks = picture.marks;
  EXPECT_EQ(picture.marksName, GetParam().name);

  const Vec3 before = std::get<Vec3>(result.report.at("center_of_mass_before"));
  const Vec3 after = std::get<Vec3>(result.report.at("center_of_mass_after"));
  const double diagonal =
      (model.vertices.colwise().maxCoeff() - model.vertices.colwise().minCoeff()).norm();
  const auto nearest = [&](const Vec3& centre, Colour colour) {
    double least = diagonal;
    const TriangleMesh part = partOf(marks, colour);
    for (Eigen::Index f = 0; f < part.faces.rows(); ++f) {
      least = std::min(least, (part.vertices.row(part.faces(f, 0)).transpose() - centre).norm());
    }
    return least;
  };
  // A ball around each; lines may begin within.
  EXPECT_LE(nearest(before, kBeforeColour), 0.0151 * diagonal);
  EXPECT_LE(nearest(after, kAfterColour), 0.0151 * diagonal);
  EXPECT_TRUE(isClosedAndOriented(marks.mesh));

  // A skeleton within the model, and lines to it from the model's surface.
  EXPECT_TRUE(isClosedAndOriented(picture.skeleton.mesh));
  const Points& drawn = picture.skeleton.mesh.vertices;
  const double pen = 0.003 * diagonal;
  for (const auto& [drawnBound, bound] :
       {std::pair(drawn.colwise().minCoeff().eval(), model.vertices.colwise().minCoeff().eval()),
        std::pair((-drawn.colwise().maxCoeff()).eval(),
                  (-model.vertices.colwise().maxCoeff()).eval())}) {
    EXPECT_GT((drawnBound - bound).minCoeff(), -2.0 * pen);
    EXPECT_LT((drawnBound - bound).maxCoeff(), 0.02 * diagonal); // the carrier's corners, spread
  }

  // Half of the body in front of a plane through the centre of mass, with its cavity.
  EXPECT_TRUE(isClosedAndOriented(mergedAndCompacted(cutOpen.mesh).mesh));
  EXPECT_GT(partOf(cutOpen, kCavityColour).faces.rows(), 0);
  const TriangleMesh cut = partOf(cutOpen, kCutColour);
  ASSERT_GT(cut.faces.rows(), 0);
  const double volume = std::get<double>(result.report.at("volume_after"));
  const double half = moments(cutOpen.mesh.vertices, cutOpen.mesh.faces)[0];
  EXPECT_GT(half, 0.2 * volume);
  EXPECT_LT(half, 0.8 * volume);
  Vec3 normal = Vec3::Zero();
  for (Eigen::Index f = 0; f < cut.faces.rows(); ++f) {
    const Vec3 a = cut.vertices.row(cut.faces(f, 0)).transpose();
    const Vec3 b = cut.vertices.row(cut.faces(f, 1)).transpose();
    const Vec3 c = cut.vertices.row(cut.faces(f, 2)).transpose();
    normal += 0.5 * (b - a).cross(c - a);
  }
  normal.normalize();
  EXPECT_NEAR(normal.z(), 0.0, 1e-9);
  EXPECT_NEAR(normal.dot(middleOf(cut) - after), 0.0, 1e-7 * diagonal);
}

TEST(Picture, IsDrawnOnlyWhenAskedFor) {
  Options options;
  options.goal = GoalKind::Spin;
  const TriangleMesh model = sampleMesh("tilted_ellipsoid_top");
  const Result without = optimizeMassProperties(model, options);
  EXPECT_FALSE(without.picture);
  options.showAnswer = true;
  const Result with = optimizeMassProperties(model, options);
  EXPECT_EQ(with.inner.vertices, without.inner.vertices);
}

} // namespace
} // namespace massprops::testing
