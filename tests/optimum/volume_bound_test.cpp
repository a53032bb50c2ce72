// What a cavity of a given volume can do at most, against cavities of that volume.
#include "core/optimum/volume_bound.h"

#include "core/goals/registry.h"
#include "core/model/posed_model.h"
#include "core/model/solid.h"
#include "core/physics/moments.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <vector>

namespace massprops::testing {
namespace {

/// A box that leans, so that hollowing helps it to stand.
struct Leaning {
  Options options;
  PosedModel posed;
  Moments solid;
  AdmissibleCells cells;
  std::unique_ptr<Goal> goal;
  OptimalBound bound;

  explicit Leaning(GoalKind kind) {
    TriangleMesh mesh = box({1.0, 0.7, 2.0}, 6);
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
      mesh.vertices(v, 0) += 0.25 * mesh.vertices(v, 2);
    options.goal = kind;
    options.innerLowerBound = 0.05;
    posed = makePosedModel(makeSolid(mesh, false, Mat3::Identity(), {}), options);
    solid = moments(posed.vertices, posed.faces);
    const TriangleTree tree(posed.vertices, posed.faces);
    cells = admissibleCells(tree, posed.wall, 8000);
    goal = makeGoal(options, posed, posed.vertices);
    bound = optimalBound(*goal, options.weights, solid, {{}}, cells);
  }

  std::optional<double> most(double volume) const {
    return greatestMeasure(*goal, bound, solid, {{}}, cells, volume);
  }
};

TEST(VolumeBound, OfAMassIsThatVolume) {
  const Leaning body(GoalKind::Mass);
  const double volume = 0.4 * body.cells.col(0).sum();
  const auto most = body.most(volume);
  ASSERT_TRUE(most);
  EXPECT_NEAR(*most, -(1.0 - volume / body.solid[0]), 1e-12);
}

TEST(VolumeBound, GrowsWithTheVolumeUpToTheLimit) {
  const Leaning body(GoalKind::Stand);
  const double limit = *body.bound.measure;
  const double solid = *body.goal->measure(body.solid);
  ASSERT_GT(limit, solid + 1.0);
  const double volume = body.solid[0] - body.bound.massMoments[0];
  // What is left between the level of the multipliers and the best body is some thousandths.
  EXPECT_NEAR(*body.most(1.001 * volume), limit, 0.01 * (limit - solid));
  // The multipliers are the limit's, not the solid's: a bound, not the best one.
  double last = *body.most(0.0);
  EXPECT_GE(last, solid);
  for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    const double most = *body.most(share * volume);
    EXPECT_GT(most, last);
    last = most;
  }
  EXPECT_LT(last, limit);
}

TEST(VolumeBound, IsExceededByNoCavityOfTheVolume) {
  const Leaning body(GoalKind::Stand);
  Random random(7);
  const double all = body.cells.col(0).sum();
  for (int i = 0; i < 300; ++i) {
    // What lies beyond a plane of any direction, up to the volume.
    const double volume = (0.05 + 0.9 * std::abs(random())) * all;
    const Vec3 direction = random.vector().normalized();
    std::vector<Eigen::Index> order(static_cast<std::size_t>(body.cells.rows()));
    for (std::size_t c = 0; c < order.size(); ++c) order[c] = static_cast<Eigen::Index>(c);
    const auto height = [&](Eigen::Index c) {
      return direction.dot(body.cells.block<1, 3>(c, 1).transpose()) / body.cells(c, 0);
    };
    std::sort(order.begin(), order.end(),
              [&](Eigen::Index a, Eigen::Index b) { return height(a) > height(b); });
    Moments cavity = Moments::Zero();
    for (const Eigen::Index c : order) {
      if (cavity[0] + body.cells(c, 0) > volume) break;
      cavity += body.cells.row(c).transpose();
    }
    EXPECT_LE(*body.goal->measure(body.solid - cavity), *body.most(volume) + 1e-9);
  }
}

TEST(VolumeBound, SaysNothingOfSeveralStatesOrOfGoalsWithoutAMeasure) {
  const Leaning body(GoalKind::Stand);
  EXPECT_FALSE(greatestMeasure(*body.goal, body.bound, body.solid, {{}, {1.0}}, body.cells, 0.1));
  const Leaning spinning(GoalKind::Spin);
  EXPECT_FALSE(spinning.most(0.1));
}

} // namespace
} // namespace massprops::testing
