// The whole optimisation problem: from the coefficients to every term, with its gradient.
#include "core/reduced/offset_problem.h"

#include "core/goals/published_stand.h"
#include "core/goals/spin.h"
#include "core/goals/stand.h"
#include "judge/checks.h"
#include "shapes.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace massprops::testing {
namespace {

constexpr int kBasis = 8;

/// A lump that stands on the ground z = 0, with directions, bounds and basis, in a frame of size 1.
struct Scene {
  TriangleMesh mesh;
  SparseMatrix L;
  Vector mass;
  HarmonicBasis basis;
  Points directions;
  OffsetBounds inner;
  OffsetBounds outer;

  Scene() : mesh(transformed(blob(5), 0.4 * Mat3::Identity(), {0.05, -0.03, 0.42})) {
    L = cotanLaplacian(mesh.vertices, mesh.faces);
    mass = vertexLumpedMass(mesh.vertices, mesh.faces);
    mass /= mass.sum();
    basis = harmonicBasis(mesh.vertices, mesh.faces, L, mass, kBasis);
    const Eigen::Index n = mesh.vertices.rows();
    directions.resize(n, 3);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Vec3 x = mesh.vertices.row(i).transpose() - Vec3(0.05, 0, 0.4);
      directions.row(i) = x.normalized().transpose();
    }
    Random random(41);
    inner.lower = (random.vector(n).array() + 2.0) * 0.01;
    inner.upper = inner.lower.array() + (random.vector(n).array() + 2.0) * 0.08;
    outer.lower = Vector::Zero(n);
    outer.upper = (random.vector(n).array() + 1.5) * 0.02;
  }

  OffsetModel model(bool moving, double fill) const {
    OffsetModel result;
    result.surface = std::make_shared<MovingSurface>(MovingSurface{
        mesh.vertices, mesh.faces, mass, basis, Interpolation::identity(mass.size()), {}, L});
    result.field.directions = directions;
    result.inner = inner;
    result.fillings = {{fill}};
    if (moving) result.outer = outer;
    result.innerFaces = mesh.faces;
    result.solidMoments = moments(mesh.vertices, mesh.faces);
    return result;
  }
};

const Scene& scene() {
  static const Scene instance;
  return instance;
}

Weights allWeights() {
  Weights weights;
  weights.volume = 0.7;
  weights.centerOfMass = 1.3;
  weights.inertia = 0.9;
  weights.smoothness = 0.05;
  weights.constraints = 2.0;
  weights.outer = 5.0;
  return weights;
}

std::unique_ptr<Goal> makeGoal(GoalKind kind, const Weights& weights) {
  const Scene& s = scene();
  if (kind == GoalKind::Spin) return makeSpinGoal(moments(s.mesh.vertices, s.mesh.faces), weights);
  // Narrow and off the middle, so that some constraints are violated.
  return makePublishedStandGoal({{{-0.1, -0.1}, {0.02, -0.1}, {0.02, 0.1}, {-0.1, 0.1}}, {}}, 1.0,
                                weights);
}

struct Variant {
  GoalKind goal;
  bool moving;
  double fill;
};

class ProblemGradient : public ::testing::TestWithParam<Variant> {};
INSTANTIATE_TEST_SUITE_P(Problem, ProblemGradient,
                         ::testing::Values(Variant{GoalKind::Stand, false, 0.0},
                                           Variant{GoalKind::Stand, true, 0.5},
                                           Variant{GoalKind::Spin, false, 0.0},
                                           Variant{GoalKind::Spin, true, 0.3}));

TEST_P(ProblemGradient, MatchesCentralDifferencesInEveryCoefficient) {
  const Variant v = GetParam();
  const OffsetModel model = scene().model(v.moving, v.fill);
  const Weights weights = allWeights();
  const auto goal = makeGoal(v.goal, weights);
  Random random(43);
  const Vector x = 0.1 * random.vector(v.moving ? 2 * kBasis : kBasis);
  const Evaluation at = evaluate(model, *goal, weights, x);
  if (v.goal == GoalKind::Stand) {
    ASSERT_GT(at.inequalities.maxCoeff(), 0.0); // the squared violations are part of the test
  } else {
    ASSERT_GT(at.equalities.cwiseAbs().maxCoeff(), 1e-4);
  }
  // Values of order one that vary over a coefficient of order the bounds' width, 0.1: a step of
  // 1e-5 leaves (1e-4)² = 1e-8 of truncation and 1e-11 of rounding, relative to gradients of order
  // one.
  const double h = 1e-5;
  for (Eigen::Index j = 0; j < x.size(); ++j) {
    Vector step = Vector::Zero(x.size());
    step[j] = h;
    const Evaluation plus = evaluate(model, *goal, weights, x + step);
    const Evaluation minus = evaluate(model, *goal, weights, x - step);
    const double scale = 1e-6 * std::max(1.0, at.objectiveGradient.norm());
    EXPECT_NEAR(at.objectiveGradient[j], (plus.objective - minus.objective) / (2 * h), scale)
        << "coefficient " << j;
    const Vector equalities = (plus.equalities - minus.equalities) / (2 * h);
    for (Eigen::Index r = 0; r < equalities.size(); ++r)
      EXPECT_NEAR(at.equalityJacobian(r, j), equalities[r], scale) << r << ", " << j;
    const Vector inequalities = (plus.inequalities - minus.inequalities) / (2 * h);
    for (Eigen::Index r = 0; r < inequalities.size(); ++r)
      EXPECT_NEAR(at.inequalityJacobian(r, j), inequalities[r], scale) << r << ", " << j;
  }
}

TEST(OffsetProblem, OfSeveralFillingsHasTheGradientOfItsValue) {
  const auto goal =
      makeStandGoal({{{-0.1, -0.1}, {0.02, -0.1}, {0.02, 0.1}, {-0.1, 0.1}}, {}}, allWeights());
  for (const bool moving : {false, true}) {
    OffsetModel model = scene().model(moving, 0.0);
    // Up to a quarter and three quarters of the lump's height.
    model.fillings = {{}, {0.8}, {0.8, 0.25}, {0.8, 0.6}};
    const Vector x = 0.1 * Random(47).vector(moving ? 2 * kBasis : kBasis);
    const Vector gradient = evaluate(model, *goal, allWeights(), x).objectiveGradient;
    const double h = 1e-5; // as above
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      Vector step = Vector::Zero(x.size());
      step[j] = h;
      const double change = evaluate(model, *goal, allWeights(), x + step).objective -
                            evaluate(model, *goal, allWeights(), x - step).objective;
      EXPECT_NEAR(gradient[j], change / (2 * h), 1e-6 * std::max(1.0, gradient.norm()))
          << "coefficient " << j;
    }
  }
}

TEST(OffsetProblem, OfSeveralFillingsHasTheObjectiveThatTheReportShows) {
  const Scene& s = scene();
  const auto goal =
      makeStandGoal({{{-0.1, -0.1}, {0.1, -0.1}, {0.1, 0.1}, {-0.1, 0.1}}, {}}, allWeights());
  OffsetModel model = s.model(false, 0.0);
  model.fillings = {{}, {0.8}, {0.8, 0.4}};
  const Vector x = 0.1 * Random(48).vector(kBasis);
  const OffsetSurfaces surfaces = offsetSurfaces(model, x);
  const auto states =
      filledMoments(model.solidMoments, surfaces.inner, s.mesh.faces, model.fillings);
  const double share = states[0][0] / model.solidMoments[0];
  EXPECT_NEAR(momentObjective(*goal, allWeights(), states, share) +
                  offsetObjective(*model.surface, allWeights(), surfaces.innerOffsets, {}),
              evaluate(model, *goal, allWeights(), x).objective, 1e-12);
}

TEST_P(ProblemGradient, BelongsToTheSumOfTheSixTermsByTheirFormulas) {
  const Variant v = GetParam();
  const Scene& s = scene();
  const OffsetModel model = s.model(v.moving, v.fill);
  const Weights weights = allWeights();
  const auto goal = makeGoal(v.goal, weights);
  Random random(44);
  const Vector x = 0.1 * random.vector(v.moving ? 2 * kBasis : kBasis);
  const OffsetSurfaces surfaces = offsetSurfaces(model, x);
  // Each term from the two surfaces alone.
  const Moments inner = quadratureMoments({surfaces.inner, s.mesh.faces});
  const Moments outer =
      quadratureMoments({v.moving ? surfaces.outer : s.mesh.vertices, s.mesh.faces});
  const Moments m = outer - inner + v.fill * inner;
  const Body body = bodyOf(m);
  const Vec3& c = body.centre;
  const Mat3& I = body.inertia;
  const double solid = quadratureMoments(s.mesh)[0];
  double expected = weights.volume * (outer[0] - inner[0]) / solid;
  if (v.goal == GoalKind::Stand) {
    expected += weights.centerOfMass * (c.x() * c.x() + c.y() * c.y() + c.z());
  } else {
    expected += weights.centerOfMass * body.mass / solid * c.z();
    expected += weights.inertia * (I(0, 0) * I(0, 0) + I(1, 1) * I(1, 1) + 2 * I(0, 1) * I(0, 1)) /
                (I(2, 2) * I(2, 2));
  }
  expected += weights.smoothness * surfaces.innerOffsets.dot(s.L * surfaces.innerOffsets);
  const Evaluation e = evaluate(model, *goal, weights, x);
  expected += weights.constraints *
              (e.equalities.squaredNorm() + e.inequalities.cwiseMax(0.0).squaredNorm());
  if (v.moving) expected += weights.outer * s.mass.dot(surfaces.outerOffsets.cwiseAbs2());
  EXPECT_NEAR(e.objective, expected, 1e-11);
}

TEST_P(ProblemGradient, IsOfTheObjectiveThatTheReportShows) {
  const Variant v = GetParam();
  const Scene& s = scene();
  const OffsetModel model = s.model(v.moving, v.fill);
  const Weights weights = allWeights();
  const auto goal = makeGoal(v.goal, weights);
  Random random(45);
  const Vector x = 0.1 * random.vector(v.moving ? 2 * kBasis : kBasis);
  const OffsetSurfaces surfaces = offsetSurfaces(model, x);
  const Moments inner = moments(surfaces.inner, s.mesh.faces);
  const Moments outer = moments(v.moving ? surfaces.outer : s.mesh.vertices, s.mesh.faces);
  const Moments m = shellMoments(outer, inner, 1.0, v.fill);
  const double share = (outer[0] - inner[0]) / model.solidMoments[0];
  EXPECT_NEAR(momentObjective(*goal, weights, {m}, share) + offsetObjective(*model.surface, weights,
                                                                            surfaces.innerOffsets,
                                                                            surfaces.outerOffsets),
              evaluate(model, *goal, weights, x).objective, 1e-12);
}

TEST(OffsetSurfaces, AreInwardsByDeltaAndOutwardsByEpsilon) {
  const Scene& s = scene();
  const OffsetModel model = s.model(true, 0.0);
  const Vector x = Random(46).vector(2 * kBasis);
  const OffsetSurfaces surfaces = offsetSurfaces(model, x);
  for (Eigen::Index i = 0; i < s.mesh.vertices.rows(); ++i) {
    const Eigen::RowVector3d d = s.directions.row(i);
    EXPECT_LT(
        (surfaces.inner.row(i) - (s.mesh.vertices.row(i) - surfaces.innerOffsets[i] * d)).norm(),
        1e-15);
    EXPECT_LT(
        (surfaces.outer.row(i) - (s.mesh.vertices.row(i) + surfaces.outerOffsets[i] * d)).norm(),
        1e-15);
  }
  EXPECT_GE((surfaces.innerOffsets - s.inner.lower).minCoeff(), 0.0);
  EXPECT_GE((s.outer.upper - surfaces.outerOffsets).minCoeff(), 0.0);
}

TEST(CoefficientsFor, ReproduceFieldsOfTheBasis) {
  const Scene& s = scene();
  const OffsetModel model = s.model(true, 0.0);
  const Vector x = Random(47).vector(2 * kBasis);
  const Matrix H = s.basis.functions;
  const Vector again = coefficientsFor(model, H * x.head(kBasis), H * x.tail(kBasis));
  EXPECT_LT((again - x).norm(), 1e-9); // HᵀMH = 1 to 1e-10
}

TEST(Evaluate, LeavesTheConstraintsOutWhenTheirWeightIsZero) {
  Weights weights;
  weights.constraints = 0.0;
  const auto goal = makeGoal(GoalKind::Stand, weights);
  const Evaluation e = evaluate(scene().model(false, 0.0), *goal, weights, Vector::Zero(kBasis));
  EXPECT_EQ(e.equalities.size(), 0);
  EXPECT_EQ(e.inequalities.size(), 0);
}

} // namespace
} // namespace massprops::testing
