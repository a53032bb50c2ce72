// Models cut flat for something to stand on: what is known of a ball, a ring, a cone.
#include "core/model/foot.h"

#include "core/base/angles.h"
#include "core/base/tolerances.h"
#include "core/mesh/components.h"
#include "core/model/frame.h"
#include "core/pipeline.h"
#include "judge/checks.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace massprops::testing {
namespace {

double diagonal(const TriangleMesh& mesh) {
  return (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).norm();
}

double height(const TriangleMesh& mesh) {
  return mesh.vertices.col(2).maxCoeff() - mesh.vertices.col(2).minCoeff();
}

double number(const Result& result, const std::string& key) {
  return std::get<double>(result.report.at(key));
}

std::string text(const Result& result, const std::string& key) {
  return std::get<std::string>(result.report.at(key));
}

/// Edges of one face.
std::size_t borderEdges(const TriangleMesh& mesh) {
  std::set<std::pair<int, int>> edges;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) edges.emplace(mesh.faces(f, k), mesh.faces(f, (k + 1) % 3));
  }
  return static_cast<std::size_t>(std::count_if(edges.begin(), edges.end(), [&](const auto& edge) {
    return edges.count({edge.second, edge.first}) == 0;
  }));
}

Options standing() {
  Options options;
  options.cavityShape = CavityShape::BestPossible;
  return options;
}

TEST(Inradius, IsThatOfTheLargestCircle) {
  const ContactArea rectangle{{{-3, -1}, {3, -1}, {3, 1}, {-3, 1}}, {}};
  EXPECT_NEAR(inradius(rectangle), 1.0, 1e-12);
  EXPECT_TRUE(holdsCircle(rectangle, 1.0 - 1e-9));
  EXPECT_FALSE(holdsCircle(rectangle, 1.0 + 1e-9));
  EXPECT_NEAR(sizeOf(rectangle), 12.0, 1e-12);
  // 3, 4, 5: area over half the perimeter.
  const ContactArea triangle{{{7, 7}, {11, 7}, {7, 10}}, {}};
  EXPECT_NEAR(inradius(triangle), 1.0, 1e-12);
  const ContactArea ellipse{{}, Vec2(3, 2)};
  EXPECT_EQ(inradius(ellipse), 2.0);
  EXPECT_NEAR(sizeOf(ellipse), 6.0 * kPi, 1e-12);
  EXPECT_EQ(inradius({}), 0.0);
}

TEST(Foot, OfABallIsTheLeastThatHoldsTheCircle) {
  const TriangleMesh ball = sphere(40);
  const Footing footing = onFoot(makeSolid(ball), standing());
  ASSERT_TRUE(footing.foot);
  // r² = d (2 − d) for the smooth ball; the facets' sagitta is 1e-4, and a clear depth is up to a
  // twentieth deeper.
  const double radius = kFootInradius * diagonal(ball);
  const double depth = 1.0 - std::sqrt(1.0 - radius * radius);
  EXPECT_NEAR(footing.foot->depth, depth, 0.06 * depth + 1.5e-4);
  const GroundContact contact = groundContact(footing.solid.vertices(), {}, footing.foot->spread);
  EXPECT_GE(inradius(contact.area), radius * (1.0 - 1e-3));
  EXPECT_LE(inradius(contact.area), 1.15 * radius);
  EXPECT_TRUE(isClosedAndOriented({footing.solid.vertices(), footing.solid.faces()}));
}

TEST(Foot, IsNoneWhereContactsSuffice) {
  for (const TriangleMesh& mesh : {box({1, 2, 3}, 4), figure(4)}) {
    const Footing footing = onFoot(makeSolid(mesh), standing());
    EXPECT_FALSE(footing.foot);
    EXPECT_EQ(footing.solid.vertices(), mesh.vertices);
    EXPECT_EQ(footing.solid.faces(), mesh.faces);
  }
}

TEST(Foot, IsNoneWhereItIsRuledOut) {
  const auto footOf = [](const std::function<void(Options&)>& change) {
    Options options = standing();
    change(options);
    return onFoot(makeSolid(sphere(10)), options).foot;
  };
  EXPECT_TRUE(footOf([](Options&) {}));
  EXPECT_FALSE(footOf([](Options& o) { o.foot = FootCut::Never; }));
  EXPECT_FALSE(footOf([](Options& o) { o.radiusX = o.radiusY = 0.1; }));
  for (const GoalKind goal : {GoalKind::Spin, GoalKind::YoYo, GoalKind::RollUpright,
                              GoalKind::Float, GoalKind::Hang, GoalKind::Mass}) {
    EXPECT_FALSE(footOf([&](Options& o) { o.goal = goal; }));
  }
  EXPECT_TRUE(footOf([](Options& o) { o.goal = GoalKind::PublishedStand; }));
}

TEST(Foot, BringsNearlyLevelFeetToTheGround) {
  // Four feet, two of which are half a per cent of the height too short.
  TriangleMesh table = polycube({{0, 0, 0},
                                 {0, 2, 0},
                                 {2, 0, 0},
                                 {2, 2, 0},
                                 {0, 0, 1},
                                 {1, 0, 1},
                                 {2, 0, 1},
                                 {0, 1, 1},
                                 {1, 1, 1},
                                 {2, 1, 1},
                                 {0, 2, 1},
                                 {1, 2, 1},
                                 {2, 2, 1}},
                                3);
  // Those that touch are edges: the feet's soles slope.
  for (Eigen::Index v = 0; v < table.vertices.rows(); ++v) {
    const double x = table.vertices(v, 0);
    if (table.vertices(v, 2) == 0.0) table.vertices(v, 2) = 0.004 * x + 0.001;
  }
  const GroundContact before = groundContact(table.vertices, {});
  EXPECT_TRUE(before.area.polygon.empty());
  const Footing footing = onFoot(makeSolid(table), standing());
  ASSERT_TRUE(footing.foot);
  EXPECT_LE(footing.foot->depth, 0.01 * height(table));
  const GroundContact after = groundContact(footing.solid.vertices(), {}, footing.foot->spread);
  EXPECT_GE(inradius(after.area), kFootInradius * diagonal(table));
  EXPECT_GE(extent(after.area, Vec2(0, 1)), 1.49); // both feet of the side
}

TEST(Foot, OfAConeIsTheLargestWithinAHundredthOfTheHeight) {
  const TriangleMesh cone = revolved({{0, 1}, {0.2, 1}, {0, 0}}, 40);
  const Footing footing = onFoot(makeSolid(cone), standing());
  ASSERT_TRUE(footing.foot);
  EXPECT_LE(footing.foot->depth, 0.01);
  EXPECT_GT(footing.foot->depth, 0.009);
}

TEST(Foot, FollowsTheUpAxisAndTheScale) {
  const TriangleMesh ball = sphere(12);
  Options options = standing();
  const double depth = onFoot(makeSolid(ball), options).foot->depth;
  for (const UpAxis up : {UpAxis::PlusX, UpAxis::MinusY, UpAxis::MinusZ}) {
    options.upAxis = up;
    TriangleMesh turned = ball;
    turned.vertices = 1000.0 * ball.vertices * rotationToUp(up);
    const Footing footing = onFoot(makeSolid(turned), options);
    ASSERT_TRUE(footing.foot);
    EXPECT_NEAR(footing.foot->depth, 1000.0 * depth, 1e-6);
    const Points upright = footing.solid.vertices() * rotationToUp(up).transpose();
    EXPECT_GT((upright.col(2).array() == upright.col(2).minCoeff()).count(), 3);
  }
}

TEST(Foot, MayBeGiven) {
  Options options = standing();
  options.foot = FootCut::Given;
  options.footDepth = 0.3;
  const TriangleMesh block = box({1, 2, 3}, 4);
  const Footing footing = onFoot(makeSolid(block), options);
  ASSERT_TRUE(footing.foot);
  EXPECT_NEAR(footing.foot->depth, 0.3, 1e-12); // no vertex is near
  EXPECT_NEAR(quadratureMoments({footing.solid.vertices(), footing.solid.faces()})[0], 5.4, 1e-9);
  options.footDepth = 2.0;
  EXPECT_THROW(onFoot(makeSolid(block), options), InvalidInput);
  options.footDepth = 0.0;
  EXPECT_THROW(requireSensible(options, 1.0), InvalidInput);
}

TEST(Foot, FillsExistingCavitiesThatItWouldOpen) {
  TriangleMesh hollow = sphere(20);
  TriangleMesh inner = scaled(sphere(8), 0.99);
  for (Eigen::Index f = 0; f < inner.faces.rows(); ++f)
    std::swap(inner.faces(f, 1), inner.faces(f, 2));
  hollow = assembled({hollow, inner});
  const Footing footing = onFoot(makeSolid(hollow), standing());
  ASSERT_TRUE(footing.foot);
  EXPECT_EQ(footing.solid.cavities().faces.rows(), inner.faces.rows());
  EXPECT_EQ(footing.solid.repairs().replacedCavities, 1);
  Options given = standing();
  given.foot = FootCut::Given;
  given.footDepth = 0.1;
  const Footing filled = onFoot(makeSolid(hollow), given);
  ASSERT_TRUE(filled.foot);
  EXPECT_EQ(filled.solid.cavities().faces.rows(), 0);
  EXPECT_EQ(filled.solid.repairs().replacedCavities, 1);
}

/// All that is promised of a run that cut a foot.
void expectFooted(const TriangleMesh& model, const Result& result, double wall) {
  ASSERT_TRUE(result.outer);
  const TriangleMesh& outer = *result.outer;
  EXPECT_TRUE(isClosedAndOriented(outer));
  EXPECT_EQ(intersectingPairs(outer), 0U);
  const double depth = number(result, "foot_depth");
  EXPECT_GT(depth, 0.0);
  EXPECT_LE(depth, 0.01 * height(model));
  const double ground = outer.vertices.col(2).minCoeff();
  EXPECT_NEAR(ground, model.vertices.col(2).minCoeff() + depth, 1e-9 * height(model));
  EXPECT_NE(text(result, "message").find("cut flat"), std::string::npos);
  if (result.inner.faces.rows() == 0) return;
  EXPECT_TRUE(isClosedAndOriented(result.inner));
  EXPECT_EQ(intersectingPairs(result.inner, outer), 0U);
  EXPECT_TRUE(isInside(result.inner, outer));
  EXPECT_GE(leastDistance(result.inner, outer), wall);
  EXPECT_NEAR(quadratureMoments(outer)[0] + quadratureMoments(result.inner)[0],
              number(result, "volume_after"), 1e-6 * number(result, "volume_before"));
}

TEST(PipelineFoot, ABallStandsOnIt) {
  const TriangleMesh ball = sphere(14);
  for (const CavityShape shape : {CavityShape::Offset, CavityShape::BestPossible}) {
    Options options;
    options.cavityShape = shape;
    options.innerLowerBound = 0.05;
    const Result result = optimizeMassProperties(ball, options);
    expectFooted(ball, result, 0.05);
    EXPECT_TRUE(std::get<bool>(result.report.at("solved")));
    EXPECT_GE(number(result, "contact_inradius"), 0.01 * diagonal(ball) * (1.0 - 1e-3));
    EXPECT_GT(number(result, "tip_angle_after"), 0.0);
  }
}

TEST(PipelineFoot, IsDeeperWhereThatLetsTheGoalBeReached) {
  // A ball with a lump at its side tips over at 8° on a wider foot only.
  const TriangleMesh lopsided = starShaped(
      [](const Vec3& u) { return 1.0 + 0.35 * std::exp(-4.0 * (u - Vec3::UnitX()).squaredNorm()); },
      20);
  Options options = standing();
  options.tippingAngle = 8.0;
  const Result result = optimizeMassProperties(lopsided, options);
  EXPECT_TRUE(std::get<bool>(result.report.at("solved")));
  expectFooted(lopsided, result, 0.01 * diagonal(*result.outer));
  const double least = onFoot(makeSolid(lopsided), options).foot->depth;
  EXPECT_GT(number(result, "foot_depth"), 2.0 * least);
}

TEST(PipelineFoot, OfAMendedModel) {
  TriangleMesh open = sphere(14);
  open.faces = open.faces.bottomRows(open.faces.rows() - 1).eval();
  const Result result = optimizeMassProperties(open, standing());
  expectFooted(sphere(14), result, 0.01 * diagonal(*result.outer));
  EXPECT_NE(text(result, "repairs").find("hole"), std::string::npos);
}

TEST(PipelineFoot, IsTheSameEveryTime) {
  const TriangleMesh body = transformed(blob(8), someRotation());
  const Result first = optimizeMassProperties(body, standing());
  const Result second = optimizeMassProperties(body, standing());
  ASSERT_TRUE(first.outer && second.outer);
  EXPECT_EQ(first.outer->vertices, second.outer->vertices);
  EXPECT_EQ(first.outer->faces, second.outer->faces);
  EXPECT_EQ(first.inner.vertices, second.inner.vertices);
}

TEST(PipelineFoot, OfAnOpenSurface) {
  // A round bowl, open at the top.
  TriangleMesh bowl = sphere(16);
  Faces faces(bowl.faces.rows(), 3);
  Eigen::Index kept = 0;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    double highest = -1.0;
    for (const int v : bowl.faces.row(f)) highest = std::max(highest, bowl.vertices(v, 2));
    if (highest < 0.7) faces.row(kept++) = bowl.faces.row(f);
  }
  bowl.faces = faces.topRows(kept);
  Options options;
  options.openSurface = true;
  const Result result = optimizeMassProperties(bowl, options);
  ASSERT_TRUE(result.outer);
  EXPECT_GT(number(result, "foot_depth"), 0.0);
  EXPECT_TRUE(std::get<bool>(result.report.at("solved")));
  EXPECT_EQ(borderEdges(*result.outer), borderEdges(bowl));
}

TEST(Pipeline, SpeaksOfUnitsWhereTheModelIsVerySmallOrLarge) {
  const auto says = [](double size) {
    Options options = standing();
    options.goal = GoalKind::Mass;
    const Result result = optimizeMassProperties(scaled(box({1, 1, 1}, 4), size), options);
    return std::any_of(result.report.entries.begin(), result.report.entries.end(),
                       [](const auto& entry) { return entry.first == "units"; });
  };
  EXPECT_TRUE(says(1.0));
  EXPECT_FALSE(says(3.0)); // a diagonal of 5.2
  EXPECT_FALSE(says(1100.0));
  EXPECT_TRUE(says(1200.0));
}

} // namespace
} // namespace massprops::testing
