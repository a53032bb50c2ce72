#include "simulation/free_spin.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace simulation {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kPush = 0.01;
constexpr double kTurns = 200.0;

} // namespace

double freeWobble(const Body& body) {
  Settings settings;
  settings.gravity = 0.0;
  World world(body, settings);
  world.place(Matrix3d::Identity(), Vector3d::Zero());
  world.spin({0.8 * kPush, 0.6 * kPush, 1.0}, body.centre);
  double most = 0.0;
  // One radian a unit of time.
  while (world.time() < 2.0 * kPi * kTurns) {
    world.step();
    most = std::max(most, tilt(world.rotation()));
  }
  return most;
}

double expectedFreeWobble(const Body& body) {
  const Eigen::Matrix2d across = body.inertia.topLeftCorner<2, 2>();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(across);
  const double B = eigen.eigenvalues()[0];
  const double A = eigen.eigenvalues()[1];
  const double C = body.inertia(2, 2);
  if ((C - A) * (C - B) <= 0.0) return std::numeric_limits<double>::infinity();
  // ω_a and ω_b go through an ellipse whose axes are as √(B|C−B|) and √(A|C−A|); the angular
  // momentum, which stays, leans by (A ω_a, B ω_b)/C, and so does the axis at most twice.
  const double stretch = std::sqrt(B * std::abs(C - B) / (A * std::abs(C - A)));
  const double most = kPush * std::max({stretch, 1.0 / stretch, 1.0}) * std::sqrt(2.0);
  return 2.0 * most * A / C * 180.0 / kPi;
}

} // namespace simulation
