#include "simulation/rolling.h"

#include "simulation/hull.h"

#include <cmath>

namespace simulation {
namespace {

constexpr double kDropHeight = 0.02;
constexpr double kDuration = 100.0;
/// Angular speed that lifts a body by some ten thousandths of its diagonal: over facets, no
/// further.
constexpr double kNudge = 0.05;

/// The i-th of `count` points of a spiral round the unit sphere, evenly spread.
Vector3d onSphere(int i, int count) {
  const double z = 1.0 - (2.0 * i + 1.0) / count;
  const double r = std::sqrt(1.0 - z * z);
  const double angle = i * 3.14159265358979323846 * (3.0 - std::sqrt(5.0));
  return {r * std::cos(angle), r * std::sin(angle), z};
}

/// Rolls until it lies still.
Vector3d restOf(World& world, double step) {
  // At the top of a path a body is slow as well, but not for long.
  double still = 0.0;
  while (world.time() < kDuration && still < 2.0) {
    world.step();
    still = world.speed() < 1e-3 ? still + step : 0.0;
  }
  return -world.rotation().row(2).transpose();
}

Settings rollingSettings() {
  Settings settings;
  settings.step = 2e-3;
  settings.damping = 0.1;
  return settings;
}

Contacts hullOf(const Body& body) {
  return {hullCorners(body.surface), true};
}

} // namespace

std::vector<Vector3d> restsAfterDrops(const Body& body, int count) {
  const Settings settings = rollingSettings();
  const Contacts hull = hullOf(body);
  std::vector<Vector3d> rests;
  for (int i = 0; i < count; ++i) {
    World world(body, settings, hull);
    world.setDown(Eigen::Quaterniond::FromTwoVectors(onSphere(i, count), -Vector3d::UnitZ())
                      .toRotationMatrix(),
                  kDropHeight);
    rests.push_back(restOf(world, settings.step));
  }
  return rests;
}

Vector3d restWhenSetDown(const Body& body) {
  const Settings settings = rollingSettings();
  World world(body, settings, hullOf(body));
  world.setDown(Matrix3d::Identity());
  world.spin({kNudge, 0.0, 0.0}, {body.centre.x(), body.centre.y(), 0.0});
  return restOf(world, settings.step);
}

} // namespace simulation
