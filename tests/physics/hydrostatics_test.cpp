// Displacement of bodies whose hydrostatics are known.
#include "core/physics/hydrostatics.h"

#include "core/physics/moments.h"
#include "shapes.h"

#include <Eigen/Eigenvalues>

#include <gtest/gtest.h>

#include <cmath>

namespace massprops::testing {
namespace {

const double kPi = std::acos(-1.0);
const Vec3 kUp = Vec3::UnitZ();

Displacement displacementOf(const TriangleMesh& mesh, const Vec3& up, double level) {
  return displacement(mesh.vertices, mesh.faces, up, level);
}

TEST(Displacement, OfABoxIsAShorterBox) {
  const TriangleMesh b = box({3, 2, 1}, 4);
  for (const double level : {-0.5, -0.31, -0.25, 0.0, 0.2, 0.5}) { // between and on vertices
    const double draught = level + 0.5;
    const Displacement d = displacementOf(b, kUp, level);
    EXPECT_NEAR(d.volume, 6 * draught, 1e-13);
    if (draught == 0.0) continue;
    EXPECT_LT((d.centre - Vec3(0, 0, draught / 2 - 0.5)).norm(), 1e-13);
    if (draught == 1.0) continue;
    EXPECT_NEAR(d.waterplaneArea, 6, 1e-13);
    EXPECT_NEAR(d.waterplaneMoment(0, 0), 27.0 * 2 / 12, 1e-13);
    EXPECT_NEAR(d.waterplaneMoment(1, 1), 3 * 8.0 / 12, 1e-13);
    EXPECT_LT(std::abs(d.waterplaneMoment(0, 1)) + d.waterplaneMoment.col(2).norm(), 1e-13);
  }
}

TEST(Displacement, OfASphereIsACap) {
  // Cap of height h: V = πh²(3R − h)/3, its centroid 3(2R − h)²/(4(3R − h)) below the centre.
  // The inscribed polyhedron falls short by the square of its edges, 0.03² = 1e-3.
  const TriangleMesh ball = sphere(40);
  for (const double h : {0.3, 1.0, 1.6}) {
    const Displacement d = displacementOf(ball, kUp, h - 1);
    EXPECT_NEAR(d.volume, kPi * h * h * (3 - h) / 3, 3e-3);
    EXPECT_NEAR(d.centre.z(), -3 * (2 - h) * (2 - h) / (4 * (3 - h)), 3e-3);
    const double radius = std::sqrt(h * (2 - h));
    EXPECT_NEAR(d.waterplaneArea, kPi * radius * radius, 5e-3);
    EXPECT_NEAR(d.waterplaneMoment(0, 0), kPi * std::pow(radius, 4) / 4, 5e-3);
  }
}

TEST(Displacement, IsAllOfTheBodyUnderWaterAndNothingAboveIt) {
  const TriangleMesh body = transformed(blob(6), Mat3::Identity(), {3, -2, 5});
  const Moments all = moments(body.vertices, body.faces);
  const Displacement under = displacementOf(body, kUp, 100);
  EXPECT_NEAR(under.volume, all[0], 1e-12);
  EXPECT_LT((under.centre - all.segment<3>(1) / all[0]).norm(), 1e-12);
  EXPECT_NEAR(under.waterplaneArea, 0, 1e-12);
  EXPECT_EQ(displacementOf(body, kUp, -100).volume, 0);
}

TEST(Displacement, TurnsWithTheBody) {
  const TriangleMesh body = blob(6);
  const Mat3 turn = someRotation();
  const Displacement d = displacementOf(body, kUp, 0.2);
  const Displacement turned = displacementOf(transformed(body, turn), turn * kUp, 0.2);
  EXPECT_NEAR(turned.volume, d.volume, 1e-13);
  EXPECT_LT((turned.centre - turn * d.centre).norm(), 1e-13);
  EXPECT_LT((turned.waterplaneMoment - turn * d.waterplaneMoment * turn.transpose()).norm(), 1e-13);
}

TEST(Displacement, GrowsByTheWaterplane) {
  // dV/dlevel = A; the centre of buoyancy of a heeled body moves by J/V, d(B·t)/dφ = −tᵀJt/V.
  const TriangleMesh body = blob(6);
  const double h = 1e-4; // truncation h² = 1e-8, rounding 1e-16/h = 1e-12
  const Displacement d = displacementOf(body, kUp, 0.1);
  EXPECT_NEAR(
      (displacementOf(body, kUp, 0.1 + h).volume - displacementOf(body, kUp, 0.1 - h).volume) /
          (2 * h),
      d.waterplaneArea, 1e-6);
  for (const Vec3& t : {Vec3(1, 0, 0), Vec3(0.6, -0.8, 0)}) {
    const auto heeled = [&](double angle) {
      const Vec3 up = std::cos(angle) * kUp + std::sin(angle) * t;
      const double level = levelFor(body.vertices, body.faces, up, d.volume);
      return displacementOf(body, up, level).centre.dot(t);
    };
    EXPECT_NEAR((heeled(h) - heeled(-h)) / (2 * h), -t.dot(d.waterplaneMoment * t) / d.volume,
                1e-6);
  }
}

TEST(Displacement, HasTheLevelForAVolume) {
  const TriangleMesh body = figure(3);
  const double all = moments(body.vertices, body.faces)[0];
  for (const double share : {0.001, 0.3, 0.5, 0.9, 0.999}) {
    const double level = levelFor(body.vertices, body.faces, kUp, share * all);
    EXPECT_NEAR(displacementOf(body, kUp, level).volume, share * all, 1e-11 * all);
  }
}

} // namespace
} // namespace massprops::testing
