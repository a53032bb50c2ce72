// Ends of an offset surface's cavity that a ball rounds.
#include "core/best/rounded_ends.h"

#include "core/best/best_cavity.h"

#include "core/goals/registry.h"
#include "core/model/posed_model.h"
#include "core/pipeline.h"
#include "core/query/self_intersection.h"
#include "judge/checks.h"
#include "judge/guarantee.h"
#include "large_test.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <numeric>
#include <variant>
#include <vector>

namespace massprops::testing {
namespace {

/// A box that is to become as light as possible, the wall a fifth of its side.
struct LightBox {
  Options options;
  PosedModel posed;
  std::unique_ptr<TriangleTree> surface;
  std::unique_ptr<Goal> goal;
  double side = 0.0; ///< working length
  RegionParts behindWalls;
  std::optional<Deliverable> deliverable;
  std::optional<CavityTask> task;
  Fillings states = {{}};

  LightBox() {
    options.goal = GoalKind::Mass;
    posed = makePosedModel(makeSolid(box({1, 1, 1}, 8)), options);
    surface = std::make_unique<TriangleTree>(posed.vertices, posed.faces);
    goal = makeGoal(options, posed, posed.vertices);
    side = surface->upper().x() - surface->lower().x();
    task.emplace(CavityTask{*surface, *goal, {}, options.weights});
    task->model.surface = std::make_shared<const MovingSurface>();
    task->model.fillings = states;
    task->model.solidMoments = moments(posed.vertices, posed.faces);
    task->inputMoments = task->model.solidMoments;
    task->wall = 0.1 * side;
    task->deliverable = [](const Points& points) { return points; };
    behindWalls = resolvedParts(*surface, task->wall);
    const AdmissibleCells cells = cellsOf(behindWalls);
    task->bound = optimalBound(*goal, options.weights, task->model.solidMoments, states, cells);
    deliverable.emplace(deliverableSet(*surface, task->wall, behindWalls, cells));
  }

  Vec3 middle() const { return 0.5 * (surface->lower() + surface->upper()); }

  CavityResult found(const TriangleMesh& cavity, const std::vector<int>& pleated) const {
    CavityResult result;
    result.status = CavityStatus::Found;
    result.inner = cavity.vertices;
    result.inner.rowwise() += middle().transpose();
    result.cavity.faces = cavity.faces;
    result.outer = posed.vertices;
    result.pleated = pleated;
    result.pleatedEnds = 1;
    return result;
  }

  CavityResult rounded(const CavityResult& cavity) const {
    return withRoundedEnds(*task, {deliverable->set, behindWalls, states}, cavity);
  }
};

/// A box with a pyramid on its top, whose apex is the last vertex.
TriangleMesh spikedBox(double side, double width, double height) {
  const double h = 0.5 * side;
  const double w = 0.5 * width;
  Points vertices(13, 3);
  vertices << -h, -h, -h, h, -h, -h, h, h, -h, -h, h, -h, // bottom
      -h, -h, h, h, -h, h, h, h, h, -h, h, h,             // top
      -w, -w, h, w, -w, h, w, w, h, -w, w, h,             // of the pyramid
      0, 0, h + height;
  std::vector<Eigen::RowVector3i> faces{{0, 2, 1}, {0, 3, 2}};
  for (int i = 0; i < 4; ++i) {
    const int next = (i + 1) % 4;
    faces.insert(faces.end(), {{i, next, 4 + next},
                               {i, 4 + next, 4 + i},
                               {4 + i, 4 + next, 8 + next},
                               {4 + i, 8 + next, 8 + i},
                               {8 + i, 8 + next, 12}});
  }
  TriangleMesh mesh{vertices, Faces(static_cast<Eigen::Index>(faces.size()), 3)};
  for (std::size_t f = 0; f < faces.size(); ++f)
    mesh.faces.row(static_cast<Eigen::Index>(f)) = faces[f];
  return mesh;
}

TEST(RoundedEnds, LoseASpikeAndNothingElse) {
  const LightBox model;
  const double wall = model.task->wall;
  const double side = 5.0 * wall;
  const CavityResult found = model.found(spikedBox(side, 0.5 * wall, 1.2 * wall), {12});
  const CavityResult rounded = model.rounded(found);
  ASSERT_EQ(rounded.status, CavityStatus::Found);
  EXPECT_EQ(rounded.pleatedEnds, 0);
  EXPECT_EQ(rounded.shape, CavityShape::Offset);
  EXPECT_TRUE(rounded.inspection.isClean());
  const Vec3 middle = model.middle();
  const double top = rounded.inner.col(2).maxCoeff() - middle.z();
  EXPECT_LT(top, 0.5 * side + 0.3 * wall);
  EXPECT_GT(top, 0.5 * side - 0.1 * wall);
  // A ball would be 0.37 and 0.73 of its radius short of these; cubes are coarse.
  for (const double z : {-0.5, 0.5}) {
    const Vec3 corner = middle + side * Vec3(0.5, 0.5, z);
    const double missed =
        (rounded.inner.rowwise() - corner.transpose()).rowwise().norm().minCoeff();
    EXPECT_LT(missed, 0.35 * wall) << z;
  }
}

TEST(RoundedEnds, StayWhereTheCavityIsNarrowerThanAnyBall) {
  const LightBox model;
  const double wall = model.task->wall;
  TriangleMesh sheet = box({4.0 * wall, 4.0 * wall, 0.2 * wall}, 2);
  sheet.vertices.rowwise() -=
      0.5 * (sheet.vertices.colwise().minCoeff() + sheet.vertices.colwise().maxCoeff());
  std::vector<int> all(static_cast<std::size_t>(sheet.vertices.rows()));
  std::iota(all.begin(), all.end(), 0);
  const CavityResult found = model.found(sheet, all);
  const CavityResult rounded = model.rounded(found);
  EXPECT_EQ(rounded.inner, found.inner);
  EXPECT_EQ(rounded.pleatedEnds, 1);
}

struct Body {
  std::vector<std::array<int, 3>> cubes;
  GoalKind goal;
};

class RoundedEndsOf : public ::testing::TestWithParam<Body> {};

TEST_P(RoundedEndsOf, KeepTheWallAndTheConstraints) {
  if (GetParam().goal != GoalKind::Float) LARGE_TEST();
  const TriangleMesh body = polycube(GetParam().cubes, 5);
  Options options;
  options.goal = GetParam().goal;
  options.cavityShape = CavityShape::Offset;
  options.innerLowerBound =
      0.01 * (body.vertices.colwise().maxCoeff() - body.vertices.colwise().minCoeff()).norm();
  const Result result = optimizeMassProperties(body, options);
  ASSERT_GT(result.inner.faces.rows(), 0);
  EXPECT_EQ(std::get<int>(result.report.at("pleated_ends")), 0);
  EXPECT_EQ(std::get<std::string>(result.report.at("cavity_shape")),
            "offset surface: as asked for");
  EXPECT_LE(std::get<double>(result.report.at("max_constraint_violation")), 1e-6);
  EXPECT_LT(std::get<double>(result.report.at("gap_to_limit")), 0.05);
  EXPECT_TRUE(isClosedAndOriented(result.inner));
  EXPECT_EQ(intersectingPairs(result.inner), 0U);
  EXPECT_GE(separation(result.inner, body).least, *options.innerLowerBound);
}

// The goals are well within reach; no cap closes all ends of these.
INSTANTIATE_TEST_SUITE_P(
    Polycubes, RoundedEndsOf,
    ::testing::Values(
        Body{{{0, 0, 0},
              {-1, 0, 0},
              {0, -1, 0},
              {0, -1, -1},
              {0, 0, -1},
              {0, 0, 1},
              {1, 0, 0},
              {0, 0, 2}},
             GoalKind::Float},
        Body{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, -1, 0}, {1, 0, -1}, {1, 1, 0}}, GoalKind::Spin},
        Body{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, -1, 0}, {1, -1, 0}, {2, 1, 0}, {2, 0, 0}},
             GoalKind::Spin},
        Body{{{0, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 1, 0}, {-1, -1, 0}}, GoalKind::Stand}));

} // namespace
} // namespace massprops::testing
