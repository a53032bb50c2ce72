// Open surfaces: lids, shells, and what the whole filter makes of them.
#include "core/check/inspection.h"
#include "core/goals/spin.h"
#include "core/mesh/components.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/hole_filling.h"
#include "core/model/open_surface.h"
#include "core/model/repair.h"
#include "core/pipeline.h"
#include "core/reduced/offset_problem.h"

#include "judge/checks.h"
#include "large_test.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace massprops::testing {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// The part of a closed mesh whose faces' centres satisfy the predicate.
TriangleMesh where(const TriangleMesh& mesh, const std::function<bool(const Vec3&)>& isKept) {
  Faces kept(mesh.faces.rows(), 3);
  Eigen::Index row = 0;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    Vec3 centre = Vec3::Zero();
    for (const int v : mesh.faces.row(f)) centre += mesh.vertices.row(v).transpose() / 3.0;
    if (isKept(centre)) kept.row(row++) = mesh.faces.row(f);
  }
  return submesh(mesh.vertices, kept.topRows(row)).mesh;
}

std::vector<char> marks(const TriangleMesh& mesh, const std::function<bool(const Vec3&)>& isLid) {
  std::vector<char> result;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    Vec3 centre = Vec3::Zero();
    for (const int v : mesh.faces.row(f)) centre += mesh.vertices.row(v).transpose() / 3.0;
    result.push_back(isLid(centre) ? 1 : 0);
  }
  return result;
}

/// The half of the unit ball below z = 0, its flat side included.
TriangleMesh halfBall(int segments) {
  std::vector<Vec2> profile = {{0.0, 0.0}};
  const int rings = segments / 4;
  for (int i = 1; i <= rings; ++i) profile.emplace_back(double(i) / rings, 0.0);
  for (int i = 1; i <= rings; ++i) {
    const double angle = 0.5 * kPi * i / rings;
    profile.emplace_back(i == rings ? 0.0 : std::cos(angle), -std::sin(angle));
  }
  return revolved(profile, segments);
}

/// A cylinder of that radius from z = 0 to the height, both ends included.
TriangleMesh cylinder(double radius, double height, int segments) {
  const double edge = 2.0 * kPi * radius / segments;
  const int rings = std::max(2, int(std::lround(radius / edge)));
  const int floors = std::max(2, int(std::lround(height / edge)));
  std::vector<Vec2> profile;
  profile.reserve(static_cast<std::size_t>(2 * rings + floors + 1));
  for (int i = 0; i < rings; ++i) profile.emplace_back(radius * i / rings, height);
  for (int i = 0; i <= floors; ++i) profile.emplace_back(radius, height - height * i / floors);
  for (int i = rings - 1; i >= 0; --i) profile.emplace_back(radius * i / rings, 0.0);
  return revolved(profile, segments);
}

/// A vase that widens from its foot to its rim at z = 80 and leans.
TriangleMesh leaningVase() {
  constexpr int kSegments = 64;
  constexpr int kFloors = 40;
  std::vector<Vec2> profile = {{0.0, 80.0}};
  for (int i = 0; i <= kFloors; ++i) {
    const double t = 1.0 - double(i) / kFloors;
    profile.emplace_back(10.0 + 16.0 * std::sin(0.5 * kPi * t), 80.0 * t);
  }
  profile.insert(profile.end(), {{7.0, 0.0}, {4.0, 0.0}, {2.0, 0.0}, {0.0, 0.0}});
  return transformed(
      where(revolved(profile, kSegments), [](const Vec3& c) { return c.z() < 79.99; }),
      shear(0.26));
}

double boundaryEdges(const TriangleMesh& mesh) {
  double count = 0.0;
  const std::vector<int> opposite = oppositeHalfEdges(mesh.vertices.rows(), mesh.faces);
  for (const int other : opposite) count += other < 0 ? 1 : 0;
  return count;
}

/// The skin and the delivered layer as one surface, vertices with the same coordinates merged.
TriangleMesh shellFrom(const TriangleMesh& skin, const TriangleMesh& layer) {
  return mergedAndCompacted(joined(skin, layer)).mesh;
}

TEST(Lids, CloseEveryLoopAndLeaveTheRestAlone) {
  // A box without its top and with a hole in one side.
  const TriangleMesh closed = box({4.0, 3.0, 2.0}, 6);
  const TriangleMesh open = where(closed, [](const Vec3& c) {
    return c.z() < 0.999 && !(c.x() > 1.999 && std::hypot(c.y(), c.z()) < 0.6);
  });
  const TriangleMesh lidded = withOpeningsFilled(open);
  EXPECT_TRUE(isClosedAndOriented(lidded));
  EXPECT_EQ(eulerCharacteristic(lidded), 2);
  EXPECT_EQ(lidded.vertices.topRows(open.vertices.rows()), open.vertices);
  EXPECT_EQ(lidded.faces.topRows(open.faces.rows()), open.faces);
  EXPECT_EQ(facesWithoutArea(lidded), 0U);
  EXPECT_EQ(intersectingPairs(lidded), 0U);
  EXPECT_NEAR(quadratureMoments(lidded)[0], 24.0, 1e-9);
  EXPECT_GT(lidded.vertices.rows(), open.vertices.rows() + 8); // refined
}

TEST(Lids, CloseAnOpeningThatIsNotFlat) {
  TriangleMesh open = where(sphere(12), [](const Vec3& c) {
    return c.z() < 0.4 + 0.3 * std::cos(2.0 * std::atan2(c.y(), c.x()));
  });
  const TriangleMesh lidded = withOpeningsFilled(open);
  EXPECT_TRUE(isClosedAndOriented(lidded));
  EXPECT_EQ(facesWithoutArea(lidded), 0U);
  EXPECT_EQ(intersectingPairs(lidded), 0U);
}

TEST(OpenSurface, AHemisphereAndItsOffsetHaveTheMomentsOfTheShell) {
  const TriangleMesh ball = halfBall(96);
  const OpenSurface open = openSurface(ball.vertices.rows(), ball.faces,
                                       marks(ball, [](const Vec3& c) { return c.z() > -1e-9; }));
  EXPECT_EQ(open.openings, 1);
  EXPECT_EQ(open.rim.size(), 96U);
  const double r = 0.8;
  const Points positions = stacked(r * ball.vertices, ball.vertices);
  const TriangleMesh cavity{positions, open.cavity};
  EXPECT_TRUE(isClosedAndOriented(submesh(positions, open.cavity).mesh));
  const Body body = bodyOf(quadratureMoments(ball) - quadratureMoments(cavity));
  // Exact for the polyhedra: both are similar.
  const Body solid = bodyOf(quadratureMoments(ball));
  EXPECT_NEAR(body.mass, solid.mass * (1.0 - r * r * r), 1e-12);
  EXPECT_NEAR(body.centre.z(), solid.centre.z() * (1.0 - std::pow(r, 4)) / (1.0 - r * r * r),
              1e-12);
  // And up to the facets: V = 2π/3 (1 − r³), c_z = −3/8 (1 − r⁴)/(1 − r³).
  EXPECT_NEAR(body.mass, 2.0 * kPi / 3.0 * (1.0 - r * r * r), 3e-3 * body.mass);
  EXPECT_NEAR(body.centre.z(), -0.375 * (1.0 - std::pow(r, 4)) / (1.0 - r * r * r), 1e-3);

  const TriangleMesh shell =
      submesh(positions, shellOf(open.skin, open.cavity, ball.vertices.rows())).mesh;
  EXPECT_TRUE(isClosedAndOriented(shell));
  EXPECT_EQ(eulerCharacteristic(shell), 2);
  EXPECT_NEAR(quadratureMoments(shell)[0], body.mass, 1e-12);
}

TEST(OpenSurface, ATubeIsARing) {
  const TriangleMesh tube = cylinder(1.0, 3.0, 40);
  const OpenSurface open =
      openSurface(tube.vertices.rows(), tube.faces,
                  marks(tube, [](const Vec3& c) { return c.z() < 1e-9 || c.z() > 3.0 - 1e-9; }));
  EXPECT_EQ(open.openings, 2);
  Points inner = tube.vertices;
  inner.leftCols<2>() *= 0.7;
  const Points positions = stacked(inner, tube.vertices);
  const TriangleMesh shell =
      submesh(positions, shellOf(open.skin, open.cavity, tube.vertices.rows())).mesh;
  EXPECT_TRUE(isClosedAndOriented(shell));
  EXPECT_EQ(eulerCharacteristic(shell), 0);
  EXPECT_NEAR(quadratureMoments(shell)[0], quadratureMoments(tube)[0] * (1.0 - 0.49), 1e-12);
  EXPECT_EQ(intersectingPairs(shell), 0U);
}

TEST(OpenSurface, TheRimsAxisIsLevelWithTheRim) {
  const TriangleMesh ball = halfBall(32);
  const std::vector<char> isLid = marks(ball, [](const Vec3& c) { return c.z() > -1e-9; });
  const OpenSurface open = openSurface(ball.vertices.rows(), ball.faces, isLid);
  const Points axis =
      Points::Zero(ball.vertices.rows(), 3).rowwise() + Vec3(0.1, 0.0, -0.4).transpose();
  const Points levelled = levelAtRim(ball.vertices, ball.faces, isLid, open, axis);
  for (Eigen::Index v = 0; v < axis.rows(); ++v) {
    const bool isRim = std::binary_search(open.rim.begin(), open.rim.end(), static_cast<int>(v));
    const Vec3 expected(0.1, 0.0, isRim ? 0.0 : -0.4);
    EXPECT_LT((levelled.row(v).transpose() - expected).norm(), 1e-12);
  }
}

TEST(OpenSurface, HasTheMomentRatesOfItsStripsToo) {
  const TriangleMesh ball = halfBall(24);
  const Eigen::Index n = ball.vertices.rows();
  const OpenSurface open =
      openSurface(n, ball.faces, marks(ball, [](const Vec3& c) { return c.z() > -1e-9; }));
  Random random(3);
  Matrix functions(n, 3);
  for (int j = 0; j < 3; ++j) functions.col(j) = random.vector(n);
  const Points directions =
      (ball.vertices.rowwise() - Eigen::RowVector3d(0, 0, 0.5)).rowwise().normalized();
  const Vector mass = Vector::Constant(n, 1.0 / static_cast<double>(n));
  OffsetModel model;
  model.surface = std::make_shared<MovingSurface>(
      MovingSurface{ball.vertices, ball.faces, mass, {functions, Vector::Zero(3)}});
  model.field.directions = directions;
  model.inner = {Vector::Constant(n, 0.05), Vector::Constant(n, 0.4)};
  model.innerFaces = open.cavity;
  model.solidMoments = quadratureMoments(ball);
  model.isOpen = true;
  const Vector x = 0.1 * random.vector(3);
  // Spin looks at all ten moments.
  const Weights weights;
  const std::unique_ptr<Goal> goal = makeSpinGoal(model.solidMoments, weights);
  const Evaluation at = evaluate(model, *goal, weights, x);
  const Points positions = stacked(offsetSurfaces(model, x).inner, ball.vertices);
  const Moments inner = quadratureMoments({positions, open.cavity});
  const Moments shell = model.solidMoments - inner;
  EXPECT_NEAR(at.objective,
              momentObjective(*goal, weights, {shell}, shell[0] / model.solidMoments[0]), 1e-11);
  const double h = 1e-5;
  for (int j = 0; j < 3; ++j) {
    Vector step = Vector::Zero(3);
    step[j] = h;
    const double rate = (evaluate(model, *goal, weights, x + step).objective -
                         evaluate(model, *goal, weights, x - step).objective) /
                        (2.0 * h);
    // Truncation of order h² times third derivatives of order 100 at these random functions.
    EXPECT_NEAR(at.objectiveGradient[j], rate, 1e-6 * std::max(1.0, std::abs(rate)));
  }
}

TEST(InspectShell, FindsThinWallsAndFolds) {
  const TriangleMesh ball = halfBall(48);
  const Eigen::Index n = ball.vertices.rows();
  const OpenSurface open =
      openSurface(n, ball.faces, marks(ball, [](const Vec3& c) { return c.z() > -1e-9; }));
  const TriangleTree skin(ball.vertices, open.skin);
  const auto inspected = [&](const Points& inner, double wall) {
    return inspectShell(stacked(inner, ball.vertices), open.cavity, skin, wall);
  };
  const Points offset = 0.8 * ball.vertices;
  const Inspection clean = inspected(offset, 0.19);
  EXPECT_TRUE(clean.isClean());
  EXPECT_EQ(clean.components, 1);
  EXPECT_NEAR(clean.leastWall, 0.2, 2e-3); // the facets' sagitta
  EXPECT_FALSE(inspected(offset, 0.21).thin.empty());

  Points folded = offset;
  folded.row(n - 1) << 0.0, 0.0, -1.2; // the lowest point, through the skin
  EXPECT_FALSE(inspected(folded, 0.1).crossing.empty());
  Points turned = 1.2 * ball.vertices; // the offset surface outside of the skin
  EXPECT_FALSE(inspected(turned, 0.1).crossing.empty());
}

struct OpenRun {
  TriangleMesh skin;
  Result result;
  TriangleMesh shell;
};

OpenRun runOn(const TriangleMesh& skin, Options options) {
  options.openSurface = true;
  // As in MeshLab: what is delivered fits into floats.
  options.representable = [](const Points& points) {
    return Points(points.cast<float>().cast<double>());
  };
  const TriangleMesh stored{options.representable(skin.vertices), skin.faces};
  OpenRun run{stored, optimizeMassProperties(stored, options), {}};
  if (run.result.inner.faces.rows() > 0) run.shell = shellFrom(stored, run.result.inner);
  return run;
}

double number(const OpenRun& run, const std::string& key) {
  return std::get<double>(run.result.report.at(key));
}

/// One closed solid that the report describes, with the wall that was asked for.
void expectShell(const OpenRun& run, double wall) {
  ASSERT_GT(run.result.inner.faces.rows(), 0)
      << std::get<std::string>(run.result.report.at("message"));
  EXPECT_TRUE(isClosedAndOriented(run.shell));
  EXPECT_EQ(intersectingPairs(run.shell), 0U);
  const Body body = bodyOf(quadratureMoments(run.shell));
  EXPECT_NEAR(number(run, "volume_after"), body.mass, 1e-6 * body.mass);
  const double size =
      (run.skin.vertices.colwise().maxCoeff() - run.skin.vertices.colwise().minCoeff()).norm();
  EXPECT_LT((std::get<Vec3>(run.result.report.at("center_of_mass_after")) - body.centre).norm(),
            1e-6 * size);

  // The strips are the faces with a corner on the skin.
  const TriangleMesh& layer = run.result.inner;
  Faces offset(layer.faces.rows(), 3);
  Eigen::Index rows = 0;
  std::size_t onSkin = 0;
  for (Eigen::Index f = 0; f < layer.faces.rows(); ++f) {
    double least = size;
    for (const int v : layer.faces.row(f)) least = std::min(least, run.result.innerWall[v]);
    if (least > 0.0) offset.row(rows++) = layer.faces.row(f);
  }
  for (const double distance : run.result.innerWall) onSkin += distance == 0.0 ? 1 : 0;
  EXPECT_EQ(static_cast<double>(onSkin), boundaryEdges(run.skin));
  EXPECT_EQ(static_cast<double>(layer.faces.rows() - rows), 2.0 * boundaryEdges(run.skin));
  const double thinnest = leastDistance({layer.vertices, offset.topRows(rows)}, run.skin);
  EXPECT_GE(thinnest, wall);
  EXPECT_NEAR(number(run, "min_wall"), thinnest, 1e-6 * size);
}

TEST(OpenSurface, AVaseThatLeansStandsAsAShell) {
  Options options;
  options.innerLowerBound = 1.0;
  const OpenRun run = runOn(leaningVase(), options);
  expectShell(run, 1.0);
  EXPECT_FALSE(std::get<bool>(run.result.report.at("stands_before")));
  EXPECT_TRUE(std::get<bool>(run.result.report.at("solved")))
      << std::get<std::string>(run.result.report.at("message"));
  EXPECT_EQ(std::get<int>(run.result.report.at("openings")), 1);
  EXPECT_EQ(eulerCharacteristic(run.shell), 2);
}

TEST(OpenSurface, AVaseHasABaseAsThickAsWanted) {
  const TriangleMesh vase = leaningVase();
  Options options;
  options.goal = GoalKind::Mass;
  options.innerLowerBound = 1.0;
  const double low = vase.vertices.col(2).minCoeff();
  const double high = vase.vertices.col(2).maxCoeff();
  options.keptSolid = where(vase, [&](const Vec3& p) { return p.z() < low + 0.02 * (high - low); });
  ASSERT_GT(options.keptSolid.faces.rows(), 10);
  options.solidDepth = 0.15 * (high - low);
  const OpenRun run = runOn(vase, options);
  expectShell(run, 1.0);
  const TriangleMesh inside =
      where(run.result.inner, [&](const Vec3& p) { return p.z() < 0.5 * (low + high); });
  ASSERT_GT(inside.faces.rows(), 10);
  // The skin is stored in single precision.
  EXPECT_GE(leastDistance(inside, options.keptSolid), *options.solidDepth - 1e-5);
  EXPECT_LT(leastDistance(inside, options.keptSolid), *options.solidDepth * 1.05);
}

TEST(OpenSurface, ATubeWithTwoOpeningsIsALoop) {
  Options options;
  options.goal = GoalKind::Mass;
  options.innerLowerBound = 1.0;
  const OpenRun run = runOn(
      where(cylinder(10.0, 40.0, 48), [](const Vec3& c) { return c.z() > 0.01 && c.z() < 39.99; }),
      options);
  expectShell(run, 1.0);
  EXPECT_EQ(std::get<int>(run.result.report.at("openings")), 2);
  EXPECT_EQ(eulerCharacteristic(run.shell), 0);
  // As light as possible: nearly the tube of constant wall, π (10² − 9²) 40.
  EXPECT_NEAR(number(run, "volume_after"), kPi * 19.0 * 40.0, 0.1 * kPi * 19.0 * 40.0);
}

TEST(OpenSurface, ABlobWithThreeHolesKeepsThem) {
  Options options;
  options.goal = GoalKind::Mass;
  const TriangleMesh closed = scaled(blob(24), 20.0);
  const Vec3 at[] = {Vec3::UnitZ(), Vec3(1.0, 0.2, -0.3).normalized(), -Vec3::UnitY()};
  const OpenRun run = runOn(where(closed,
                                  [&](const Vec3& c) {
                                    return std::none_of(std::begin(at), std::end(at), [&](auto& u) {
                                      return c.normalized().dot(u) > 0.95;
                                    });
                                  }),
                            options);
  const double size =
      (run.skin.vertices.colwise().maxCoeff() - run.skin.vertices.colwise().minCoeff()).norm();
  expectShell(run, 0.01 * size);
  EXPECT_EQ(std::get<int>(run.result.report.at("openings")), 3);
  EXPECT_EQ(eulerCharacteristic(run.shell), -2); // genus 2
}

TEST(OpenSurface, ASolidPartIsNoOpening) {
  // The stem is thinner than two walls: the bowl's cavity ends above it.
  std::vector<Vec2> profile = {{0.0, 60.0}};
  for (int i = 0; i <= 20; ++i) {
    const double angle = 0.5 * kPi * i / 20;
    profile.emplace_back(1.5 + 18.5 * std::cos(angle), 60.0 - 25.0 * std::sin(angle));
  }
  for (int z = 34; z >= 4; --z) profile.emplace_back(1.5, z);
  for (int r = 2; r <= 14; ++r) profile.emplace_back(r, 3.0 - 0.1 * r);
  for (int r = 14; r >= 1; --r) profile.emplace_back(r, 0.0);
  profile.emplace_back(0.0, 0.0);
  Options options;
  options.innerLowerBound = 1.6;
  const OpenRun run =
      runOn(where(revolved(profile, 48), [](const Vec3& c) { return c.z() < 59.99; }), options);
  expectShell(run, 1.6);
  EXPECT_GT(std::get<int>(run.result.report.at("solid_vertices")), 0);
  EXPECT_EQ(eulerCharacteristic(run.shell), 2);
}

TEST(OpenSurface, IsTheSameForTheTurnedSurfaceAndFarAway) {
  LARGE_TEST();
  Options options;
  options.innerLowerBound = 1.0;
  const TriangleMesh vase = leaningVase();
  const OpenRun run = runOn(vase, options);
  const OpenRun again = runOn(vase, options);
  EXPECT_EQ(run.result.inner.vertices, again.result.inner.vertices);
  const OpenRun turned = runOn(reversed(vase), options);
  EXPECT_EQ(std::get<std::string>(turned.result.report.at("repairs")), "1 component flipped");
  // In another order of the faces the skeleton differs within its noise.
  const double gain = number(run, "objective_before") - number(run, "objective_after");
  EXPECT_NEAR(number(turned, "objective_after"), number(run, "objective_after"), 0.02 * gain);
  const OpenRun far = runOn(transformed(vase, Mat3::Identity(), {1000.0, -500.0, 200.0}), options);
  // Its coordinates have lost two digits.
  EXPECT_NEAR(number(far, "objective_after"), number(run, "objective_after"), 0.02 * gain);
}

TEST(OpenSurface, TheSwitchChangesNothingForAClosedSurface) {
  Options options;
  options.goal = GoalKind::Mass;
  const TriangleMesh body = scaled(blob(12), 20.0);
  const Result closed = optimizeMassProperties(body, options);
  options.openSurface = true;
  EXPECT_EQ(optimizeMassProperties(body, options).inner.vertices, closed.inner.vertices);
}

TEST(OpenSurface, ThePictureIsOfTheShell) {
  Options options;
  options.innerLowerBound = 1.0;
  options.showAnswer = true;
  const OpenRun run = runOn(leaningVase(), options);
  ASSERT_TRUE(run.result.picture);
  const TriangleMesh cut = mergedAndCompacted(run.result.picture->cutOpen.mesh).mesh;
  EXPECT_TRUE(isClosedAndOriented(cut));
  const double volume = number(run, "volume_after");
  EXPECT_GT(quadratureMoments(cut)[0], 0.2 * volume);
  EXPECT_LT(quadratureMoments(cut)[0], 0.8 * volume);
}

std::string refusalOf(const TriangleMesh& mesh, const Options& options) {
  try {
    optimizeMassProperties(mesh, options);
  } catch (const InvalidInput& refusal) {
    return refusal.what();
  }
  return "";
}

TEST(OpenSurface, IsRefusedWithWhatToDo) {
  Options options;
  const TriangleMesh vase = leaningVase();
  const auto says = [&](const TriangleMesh& mesh, const std::string& words) {
    const std::string sentence = refusalOf(mesh, options);
    EXPECT_NE(sentence.find(words), std::string::npos) << "'" << sentence << "'";
  };
  says(vase, "64 boundary edges");
  says(vase, "open_surface");
  options.openSurface = true;
  options.outerUpperBound = 1.0;
  says(vase, "stays where it is");
  options.outerUpperBound = 0.0;
  options.cavityShape = CavityShape::BestPossible;
  says(vase, "needs a closed surface: set cavity_shape to Automatic or Offset surface");
  options.cavityShape = CavityShape::Automatic;

  // Flat: the lid lies on the surface.
  says(where(box({4.0, 4.0, 4.0}, 4), [](const Vec3& c) { return c.z() > 1.999; }),
       "encloses no volume");
  // One open surface within another.
  says(joined(where(box({4.0, 4.0, 4.0}, 4), [](const Vec3& c) { return c.z() < 1.999; }),
              box({1.0, 1.0, 1.0}, 2)),
       "inside of another");
  // Two openings that share a corner: the middle of the top of a grid.
  says(where(box({4.0, 4.0, 4.0}, 4),
             [](const Vec3& c) {
               return c.z() < 1.999 || c.x() * c.y() < 0.0 ||
                      c.head<2>().cwiseAbs().maxCoeff() > 1.0;
             }),
       "non-manifold vertex");

  options.goal = GoalKind::Float;
  options.waterLevel = 1.0;
  says(vase, "water would run in");
}

TEST(OpenSurface, ABoatFloatsWithItsOpeningAboveTheWater) {
  Options options;
  options.goal = GoalKind::Float;
  options.waterLevel = 0.4;
  const OpenRun run =
      runOn(where(transformed(scaled(halfBall(64), 30.0), Vec3(1.6, 1.0, 1.0).asDiagonal()),
                  [](const Vec3& c) { return c.z() < -0.01; }),
            options);
  expectShell(run, 0.01 * Vec3(96.0, 60.0, 30.0).norm());
  EXPECT_TRUE(std::get<bool>(run.result.report.at("floats_upright_after")))
      << std::get<std::string>(run.result.report.at("message"));
}

} // namespace
} // namespace massprops::testing
