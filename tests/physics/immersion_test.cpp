// How much of a body is under water, against the clipped triangles.
#include "core/physics/immersion.h"

#include "core/physics/hydrostatics.h"
#include "core/physics/inclination.h"
#include "core/physics/moments.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace massprops::testing {
namespace {

TEST(Immersion, HasTheVolumeAreaAndDepthsOfTheClippedTriangles) {
  const TriangleMesh body = transformed(figure(3), Mat3::Identity(), {2, -1, 3});
  Random random(3);
  for (int i = 0; i < 8; ++i) {
    const Vec3 up = random.vector().normalized();
    const Vector heights = body.vertices * up;
    const Immersion immersion(body.vertices, body.faces, up);
    for (const double share : {-0.1, 0.0, 0.2, 0.5, 0.9, 1.0, 1.1}) {
      const double level = heights.minCoeff() + share * (heights.maxCoeff() - heights.minCoeff());
      const Immersion::Sums s = immersion.below(level);
      const Displacement d = displacement(body.vertices, body.faces, up, level);
      // Rounding of values up to 500.
      EXPECT_NEAR(s.volume, d.volume, 1e-11);
      EXPECT_NEAR(s.area, d.waterplaneArea, 1e-11);
      EXPECT_NEAR(s.depths, d.volume * (level - d.centre.dot(up)), 1e-11);
    }
  }
}

TEST(Immersion, OfABoxOnItsVerticesIsAShorterBox) {
  // Levels in the planes of faces, and of vertices.
  const TriangleMesh b = box({3, 2, 1}, 4);
  const Immersion immersion(b.vertices, b.faces, Vec3::UnitZ());
  for (const double level : {-0.5, -0.25, 0.0, 0.25, 0.5}) {
    const double draught = level + 0.5;
    EXPECT_NEAR(immersion.below(level).volume, 6 * draught, 1e-13);
    EXPECT_NEAR(immersion.below(level).depths, 3 * draught * draught, 1e-13);
  }
}

TEST(InclinedEnergy, IsThatOfTheCentreOfBuoyancy) {
  const TriangleMesh mesh = blob(6);
  const double all = moments(mesh.vertices, mesh.faces)[0];
  Random random(4);
  for (const double share : {0.05, 0.5, 0.97, 1.0}) {
    const FloatingBody body =
        floatingBody(mesh.vertices, mesh.faces, {0.05, -0.02, 0.1}, share * all);
    for (int i = 0; i < 8; ++i) {
      const Vec3 up = random.vector().normalized();
      EXPECT_NEAR(inclinedEnergy(body, up), inclined(body, up).energy, 1e-11);
    }
  }
}

TEST(Inclination, LeverAndMetacentricHeightAreTheEnergysDerivatives) {
  const TriangleMesh mesh = blob(6);
  const double all = moments(mesh.vertices, mesh.faces)[0];
  const FloatingBody body = floatingBody(mesh.vertices, mesh.faces, {0.05, -0.02, 0.1}, 0.4 * all);
  const double h =
      1e-3; // truncation h² = 1e-6 times the fourth derivative, rounding 1e-12/h² = 1e-6
  Random random(6);
  for (int i = 0; i < 5; ++i) {
    const Vec3 up = random.vector().normalized();
    const Vec3 t = horizontal(up) * Vec2(0.6, 0.8);
    const auto energy = [&](double a) {
      return inclined(body, std::cos(a) * up + std::sin(a) * t).energy;
    };
    const Inclination at = inclined(body, up);
    EXPECT_NEAR(at.lever(t), (energy(h) - energy(-h)) / (2 * h), 1e-5);
    EXPECT_NEAR(at.metacentricHeight(t), (energy(h) - 2 * at.energy + energy(-h)) / (h * h), 1e-5);
  }
}

} // namespace
} // namespace massprops::testing
