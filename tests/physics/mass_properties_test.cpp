// Mass, centre and inertia of known bodies, their laws and their derivatives.
#include "core/physics/mass_properties.h"

#include "shapes.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

namespace massprops::testing {
namespace {

MassProperties solidBody(const TriangleMesh& mesh, double density = 1.0) {
  return massProperties(density * moments(mesh.vertices, mesh.faces));
}

// Sums of some hundred terms of order one.
constexpr double kRounding = 1e-12;

TEST(MassProperties, OfABoxMatchTheTextbook) {
  const Vec3 s(1.0, 2.0, 3.0);
  const Vec3 centre(0.5, -0.25, 0.75);
  const MassProperties body = solidBody(transformed(box(s, 3), Mat3::Identity(), centre), 1.24);
  const double m = 1.24 * 6.0;
  EXPECT_NEAR(body.mass, m, kRounding * m);
  EXPECT_LT((body.centerOfMass - centre).norm(), kRounding);
  const Vec3 diagonal(s.y() * s.y() + s.z() * s.z(), s.z() * s.z() + s.x() * s.x(),
                      s.x() * s.x() + s.y() * s.y());
  const Mat3 expected = (m / 12 * diagonal).asDiagonal();
  EXPECT_LT((body.inertiaTensor - expected).norm(), 10 * kRounding);
}

TEST(MassProperties, HaveNegativeProductsOfInertiaWhereXAndYGrowTogether) {
  // A rod along (1, 1, 0): I_xy = −∫ρxy < 0. Its angular momentum for ω = e_x leans away from the
  // rod's direction, L_y < 0.
  const Mat3 turn = rotation(Vec3::UnitZ(), std::acos(-1.0) / 4);
  const MassProperties rod = solidBody(transformed(box({4, 0.1, 0.1}, 2), turn));
  EXPECT_LT(rod.inertiaTensor(0, 1), 0.0);
  // About its own axis a rod has nearly no inertia.
  const Vec3 along = Vec3(1, 1, 0).normalized();
  EXPECT_LT(along.dot(rod.inertiaTensor * along), 0.01 * rod.inertiaTensor.trace());
}

TEST(MassProperties, OfPointLikeMassesGiveTheAngularMomentum) {
  // Small cubes stand for point masses: L = Σ m x × (ω × x) about the centre of mass, up to the
  // cubes' own inertia m·h²/6 each.
  const double h = 0.01;
  const TriangleMesh cube = box(Vec3::Constant(h), 1);
  const std::array<Vec3, 3> at = {Vec3(1, 1, 0.2), Vec3(-1, 0.5, 0.4), Vec3(0, -1.5, -0.6)};
  const TriangleMesh all = joined(joined(transformed(cube, Mat3::Identity(), at[0]),
                                         transformed(cube, Mat3::Identity(), at[1])),
                                  transformed(cube, Mat3::Identity(), at[2]));
  const double density = 1 / (h * h * h); // every cube has mass 1
  const MassProperties body = solidBody(all, density);
  const Vec3 omega(0.3, -0.8, 0.5);
  Vec3 momentum = 3 * h * h / 6 * omega;
  for (const Vec3& p : at) {
    const Vec3 x = p - body.centerOfMass;
    momentum += x.cross(omega.cross(x));
  }
  EXPECT_NEAR(body.mass, 3.0, 1e-9); // positions of order 1, volumes of order 1e-6
  EXPECT_LT((body.inertiaTensor * omega - momentum).norm(), 1e-8);
}

TEST(MassProperties, OfAnEllipsoidHaveTheRatiosOfItsRadii) {
  // I_xx = m (b² + c²)/5. The inscribed polyhedron is the linear image of a sphere's, so the
  // ratios I_xx/(b² + c²) are equal without any discretisation error.
  const Vec3 r(1.0, 0.6, 1.7);
  const MassProperties body = solidBody(ellipsoid(r, 8));
  const Mat3& I = body.inertiaTensor;
  const double x = I(0, 0) / (r.y() * r.y() + r.z() * r.z());
  const double y = I(1, 1) / (r.z() * r.z() + r.x() * r.x());
  const double z = I(2, 2) / (r.x() * r.x() + r.y() * r.y());
  EXPECT_NEAR(y / x, 1.0, 1e-12);
  EXPECT_NEAR(z / x, 1.0, 1e-12);
  EXPECT_NEAR(x / body.mass, 0.2, 0.01); // frequency 8: 1.5 % below the sphere's radius squared
}

TEST(MassProperties, KeepTheCentralInertiaUnderTranslation) {
  const TriangleMesh mesh = blob(6);
  const Vec3 shift(10, -20, 5);
  const MassProperties here = solidBody(mesh);
  const MassProperties there = solidBody(transformed(mesh, Mat3::Identity(), shift));
  EXPECT_NEAR(there.mass / here.mass, 1.0, 1e-11);
  EXPECT_LT((there.centerOfMass - here.centerOfMass - shift).norm(), 1e-10);
  // The second moments are (20)² = 400 times the inertia, which cancels: 3 digits of 13.
  EXPECT_LT((there.inertiaTensor - here.inertiaTensor).norm(), 1e-9);
}

TEST(MassProperties, TurnWithTheBody) {
  const TriangleMesh mesh = blob(6);
  const Mat3 R = someRotation();
  const MassProperties before = solidBody(mesh);
  const MassProperties after = solidBody(transformed(mesh, R));
  EXPECT_LT((after.centerOfMass - R * before.centerOfMass).norm(), kRounding);
  EXPECT_LT((after.inertiaTensor - R * before.inertiaTensor * R.transpose()).norm(), 1e-11);
}

TEST(MassProperties, ObeyTheTriangleInequalityOfInertia) {
  // I_a ≤ I_b + I_c, with equality for flat bodies only.
  const MassProperties body = solidBody(leaningTop(0.2, 10));
  const Vec3 principal = Eigen::SelfAdjointEigenSolver<Mat3>(body.inertiaTensor).eigenvalues();
  EXPECT_GT(principal[0], 0.0);
  EXPECT_LT(principal[2], principal[0] + principal[1]);
}

TEST(ShellMoments, OfAHollowBallAreThoseOfTheBallMinusThoseOfTheCavity) {
  const TriangleMesh outer = sphere(6);
  const TriangleMesh inner = scaled(outer, 0.5);
  const Moments out = moments(outer.vertices, outer.faces);
  const Moments in = moments(inner.vertices, inner.faces);
  const double rho = 1.24;
  const double fill = 1.0;
  const MassProperties empty = massProperties(shellMoments(out, in, rho, 0.0));
  const MassProperties filled = massProperties(shellMoments(out, in, rho, fill));
  EXPECT_NEAR(empty.mass, rho * out[0] * (1 - 1.0 / 8), 1e-12);
  EXPECT_NEAR(filled.mass, rho * out[0] * 7 / 8 + fill * out[0] / 8, 1e-12);
  // I scales with the fifth power: a cavity of half the radius takes 1/32 away.
  const double ball = massProperties(rho * out).inertiaTensor(2, 2);
  EXPECT_NEAR(empty.inertiaTensor(2, 2), ball * 31 / 32, 1e-12);
}

TEST(ShellMoments, WithTheMaterialAsFillingAreThoseOfTheSolid) {
  const TriangleMesh outer = blob(5);
  const TriangleMesh inner = transformed(outer, 0.4 * Mat3::Identity(), {0.1, 0.2, 0.0});
  const Moments out = moments(outer.vertices, outer.faces);
  const Moments in = moments(inner.vertices, inner.faces);
  EXPECT_LT((shellMoments(out, in, 1.24, 1.24) - 1.24 * out).cwiseAbs().maxCoeff(), kRounding);
}

TEST(MassPropertyGradients, MatchCentralDifferences) {
  const TriangleMesh mesh = transformed(blob(5), someRotation(), {0.4, -0.3, 0.8});
  const Moments m = moments(mesh.vertices, mesh.faces);
  const MassPropertyGradients gradients = massPropertyGradients(massProperties(m));
  // Rational functions of order one: truncation h² = 1e-10, rounding 1e-16/h = 1e-11.
  const double h = 1e-5;
  for (int k = 0; k < 10; ++k) {
    Moments step = Moments::Zero();
    step[k] = h;
    const MassProperties plus = massProperties(m + step);
    const MassProperties minus = massProperties(m - step);
    const Vec3 centre = (plus.centerOfMass - minus.centerOfMass) / (2 * h);
    EXPECT_LT((gradients.centerOfMass.col(k) - centre).norm(), 1e-8) << "moment " << k;
    const Mat3 I = (plus.inertiaTensor - minus.inertiaTensor) / (2 * h);
    Eigen::Matrix<double, 6, 1> inertia;
    inertia << I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(1, 2), I(2, 0);
    EXPECT_LT((gradients.inertiaTensor.col(k) - inertia).norm(), 1e-8) << "moment " << k;
  }
}

} // namespace
} // namespace massprops::testing
