#include "simulation/standing.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace simulation {
namespace {

constexpr double kPi = 3.14159265358979323846;
/// Long enough to fall from rest at half a degree beyond the equilibrium, and to come to rest.
constexpr double kDuration = 30.0;
/// Degrees beyond where it was let go, from which nothing comes back.
constexpr double kFallen = 10.0;
/// Degrees off upright of a body that has come back.
constexpr double kBack = 0.1;
constexpr double kTolerance = 0.5; // degrees

Vector2d plane(const Vector3d& v) {
  return v.head<2>();
}

/// Leans the body's +z towards the direction.
Matrix3d lean(const Vector2d& direction, double degrees) {
  const Vector3d axis(-direction.y(), direction.x(), 0.0);
  return Eigen::AngleAxisd(degrees * kPi / 180.0, axis).toRotationMatrix();
}

} // namespace

WeakestSide weakestSide(const std::vector<Vector3d>& polygon, const Vector3d& centre) {
  const Vector2d c = plane(centre);
  double inside = std::numeric_limits<double>::infinity();
  double outside = inside;
  Vector2d normal = Vector2d::UnitX();
  Vector2d nearest = c;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vector2d p = plane(polygon[i]);
    const Vector2d edge = plane(polygon[(i + 1) % polygon.size()]) - p;
    const Vector2d outwards = Vector2d(edge.y(), -edge.x()).normalized();
    if (outwards.dot(p - c) < inside) {
      inside = outwards.dot(p - c);
      normal = outwards;
    }
    const Vector2d q = p + std::clamp(edge.dot(c - p) / edge.squaredNorm(), 0.0, 1.0) * edge;
    if ((c - q).norm() < outside) {
      outside = (c - q).norm();
      nearest = q;
    }
  }
  const double height = centre.z() - polygon.front().z();
  if (inside >= 0.0) return {normal, std::atan2(inside, height) * 180.0 / kPi};
  return {(c - nearest).normalized(), std::atan2(-outside, height) * 180.0 / kPi};
}

bool falls(const Body& body, const Contacts& contacts, const Vector2d& direction, double angle,
           const Settings& settings) {
  World world(body, settings, contacts);
  world.setDown(lean(direction, angle));
  while (world.time() < kDuration) {
    world.step();
    const double now = tilt(world.rotation());
    if (now > angle + kFallen) return true;
    if (now < kBack && world.speed() < 1e-3 && world.time() > 1.0) return false;
  }
  // It may have come to rest on another part of it.
  return tilt(world.rotation()) > std::max(2.0 * kBack, 0.5 * angle);
}

double tippingAngle(const Body& body, const Contacts& contacts, const Vector2d& direction,
                    double low, double high, const Settings& settings) {
  if (falls(body, contacts, direction, low, settings)) return low;
  if (!falls(body, contacts, direction, high, settings)) return high;
  while (high - low > 0.02) {
    const double middle = 0.5 * (low + high);
    (falls(body, contacts, direction, middle, settings) ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

void compareStanding(const Body& body, double reported, const std::string& state,
                     Comparison& comparison) {
  Contacts feet;
  feet.points = contactPolygon(body.surface);
  Contacts hull;
  hull.points = hullCorners(body.surface);
  hull.asHull = true;
  const WeakestSide weakest = weakestSide(feet.points, body.centre);
  comparison.number(state + ": tipping angle by geometry", reported, weakest.angle, 1e-3);
  if (reported <= -kTolerance) {
    comparison.truth(state + ": falls when set down", true,
                     falls(body, feet, weakest.direction, 0.0));
    comparison.truth(state + ": falls with its whole hull", true,
                     falls(body, hull, weakest.direction, 0.0));
    return;
  }
  comparison.number(
      state + ": tipping angle", reported,
      tippingAngle(body, feet, weakest.direction, std::max(0.0, reported - 2.0), reported + 2.0),
      kTolerance);
  const double less = reported - kTolerance;
  if (less <= 0.0) return;
  // Towards a strong side it is let down gently: rocking back from there it can have the energy to
  // fall over its weak side, which no tipping angle speaks of.
  Settings gently;
  gently.damping = 0.999999;
  int fallen = 0;
  int fallenByRocking = 0;
  constexpr int kDirections = 8;
  for (int i = 0; i < kDirections; ++i) {
    const Vector2d other = Eigen::Rotation2Dd(2.0 * kPi * i / kDirections) * weakest.direction;
    if (falls(body, feet, other, less, gently)) ++fallen;
    if (falls(body, feet, other, less)) ++fallenByRocking;
  }
  comparison.number(state + ": falls from half a degree less in 8 directions", 0, fallen, 0);
  comparison.note("undamped " + std::to_string(fallenByRocking) +
                  ", rocking over the weakest side");
  comparison.truth(state + ": comes back with its whole hull", true,
                   !falls(body, hull, weakest.direction, less));
  comparison.note(
      "with its whole hull it tips at " +
      std::to_string(tippingAngle(body, hull, weakest.direction, less, reported + 5.0)));
}

} // namespace simulation
