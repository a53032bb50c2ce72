// Beginning on a coarse stand-in leads to a minimum of the cavity itself.
#include "core/reduced/coarse_to_fine.h"

#include "core/goals/published_stand.h"
#include "core/goals/spin.h"
#include "core/physics/moments.h"
#include "core/reduced/laplacian.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <memory>

namespace massprops::testing {
namespace {

constexpr int kBasis = 12;

/// A lump of a few thousand vertices that stands on the ground z = 0, its basis on a carrier.
struct Lump {
  TriangleMesh mesh = transformed(blob(30), 0.4 * Mat3::Identity(), {0.05, -0.03, 0.42});
  DecimatedMesh carrier = decimated(mesh.vertices, mesh.faces, {600, 600, 0.0});
  Interpolation interpolation = interpolationFrom(carrier, mesh.vertices);
  Vector mass = vertexLumpedMass(mesh.vertices, mesh.faces);
  HarmonicBasis basis;
  Points directions = mesh.vertices;
  OffsetBounds inner;

  Lump() {
    mass /= mass.sum();
    basis = harmonicBasis(carrier.mesh.vertices, carrier.mesh.faces,
                          cotanLaplacian(carrier.mesh.vertices, carrier.mesh.faces),
                          interpolation.transposeTimes(mass), kBasis);
    directions.rowwise() -= Vec3(0.05, 0, 0.4).transpose();
    directions.rowwise().normalize();
    inner.lower = Vector::Constant(mass.size(), 0.02);
    inner.upper = Vector::Constant(mass.size(), 0.25);
  }

  OffsetModel model() const {
    OffsetModel result;
    result.surface = std::make_shared<MovingSurface>(
        MovingSurface{mesh.vertices, mesh.faces, mass, basis, interpolation, carrier});
    result.field.directions = directions;
    result.inner = inner;
    result.innerFaces = mesh.faces;
    result.solidMoments = moments(mesh.vertices, mesh.faces);
    return result;
  }
};

class CoarseToFine : public ::testing::TestWithParam<GoalKind> {};
INSTANTIATE_TEST_SUITE_P(Goals, CoarseToFine, ::testing::Values(GoalKind::Stand, GoalKind::Spin));

TEST_P(CoarseToFine, ReachesTheMinimumOfTheCavityItself) {
  const Lump lump;
  const OffsetModel model = lump.model();
  ASSERT_EQ(lump.carrier.mesh.vertices.rows(), 600);
  Weights weights;
  weights.smoothness = 0.0;
  const auto goal =
      GetParam() == GoalKind::Spin
          ? makeSpinGoal(model.solidMoments, weights)
          : makePublishedStandGoal({{{-0.1, -0.1}, {0.02, -0.1}, {0.02, 0.1}, {-0.1, 0.1}}, {}},
                                   1.0, weights);
  const Vector start = coefficientsFor(model, 0.5 * (model.inner.lower + model.inner.upper), {});
  const MinimizeOptions options;
  const auto exact = [&](const Vector& x) { return evaluate(model, *goal, weights, x); };
  const MinimizeResult plain = minimize(exact, start, options);
  const MinimizeResult result = minimizeCoarseToFine(model, *goal, weights, start, options);

  ASSERT_LE(plain.violation, options.feasibility);
  const double gain = exact(start).objective - plain.objective;
  ASSERT_GT(gain, 0.0);
  EXPECT_LE(result.objective - plain.objective, 1e-2 * gain);

  // The stand-in has a tenth of the vertices: what holds of it alone would not hold of the cavity.
  EXPECT_LE(result.violation, options.feasibility);
  const Evaluation e = exact(result.x);
  EXPECT_EQ(e.objective, result.objective);
  for (const double h : e.equalities) EXPECT_NEAR(h, 0.0, options.feasibility);
  for (const double g : e.inequalities) EXPECT_LE(g, options.feasibility);
}

} // namespace
} // namespace massprops::testing
