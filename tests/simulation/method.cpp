#include "simulation/method.h"

#include "simulation/floating.h"
#include "simulation/free_spin.h"
#include "simulation/hanging.h"
#include "simulation/rolling.h"
#include "simulation/spinning.h"
#include "simulation/standing.h"

#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace simulation {
namespace {

constexpr double kDegrees = 180.0 / 3.14159265358979323846;

/// Edges along the axes, the middle of the lower face at the origin.
Mesh box(const Vector3d& size) {
  Mesh mesh;
  mesh.vertices.resize(8, 3);
  for (int v = 0; v < 8; ++v) {
    mesh.vertices.row(v) << ((v & 1) - 0.5) * size.x(), ((v >> 1 & 1) - 0.5) * size.y(),
        (v >> 2) * size.z();
  }
  mesh.faces.resize(12, 3);
  mesh.faces << 0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4, 2, 6, 3, 3, 6, 7, 0, 4, 2, 2,
      4, 6, 1, 3, 5, 3, 7, 5;
  return mesh;
}

Body bodyOf(const Mesh& mesh) {
  return inNaturalUnits(mesh, massProperties(mesh, {}, 1.0, 0.0), 1.0);
}

/// A body of mass 1 with these moments about the origin, which is `height` below its centre.
Body topWith(double A, double B, double C, double height) {
  Body body;
  body.centre = {0, 0, height};
  body.inertia = Vector3d(A - height * height, B - height * height, C).asDiagonal();
  return body;
}

void checkMassProperties(Comparison& comparison) {
  comparison.title("mass properties of a box 2 x 3 x 4");
  const MassProperties p = massProperties(box({2, 3, 4}), {}, 0.5, 0.0);
  comparison.number("mass", 12.0, p.mass, 1e-12);
  comparison.number("height of the centre", 2.0, p.centre.z(), 1e-12);
  comparison.number("I_xx", 12.0 * 25.0 / 12.0, p.inertia(0, 0), 1e-11);
  comparison.number("I_zz", 12.0 * 13.0 / 12.0, p.inertia(2, 2), 1e-11);
}

/// Of free rotation about the middle axis, which goes over and over.
void compareGyroscopicTerms(Comparison& comparison) {
  comparison.title("free rotation: drift of energy and angular momentum");
  for (const auto& [name, way] : {std::pair("explicit", Gyroscopic::Explicit),
                                  std::pair("implicit, world", Gyroscopic::ImplicitInWorld),
                                  std::pair("implicit, body", Gyroscopic::ImplicitInBody)}) {
    for (const double step : {2e-3, 1e-3}) {
      Settings settings;
      settings.step = step;
      settings.gravity = 0.0;
      settings.gyroscopic = way;
      World world(topWith(1.0, 0.8, 1.2, 0.0), settings);
      world.place(Matrix3d::Identity(), Vector3d::Zero());
      world.spin({2.0, 0.01, 0.01}, Vector3d::Zero());
      const double energy = world.energy();
      const Vector3d momentum = world.angularMomentum();
      while (world.time() < 50.0) world.step();
      const std::string label = std::string(name) + ", step " + std::to_string(step);
      // Of first order: the bound halves with the step.
      comparison.below(label + ": energy", 2.0 * step, std::abs(world.energy() / energy - 1.0));
      comparison.below(label + ": momentum", 2.0 * step,
                       (world.angularMomentum() - momentum).norm() / momentum.norm());
    }
  }
}

void checkTops(Comparison& comparison) {
  comparison.title("tops: the speed from which on they sleep");
  const Body round = topWith(1.0, 1.0, 1.4, 0.5);
  const Top top = topOf(round, Vector3d::Zero());
  const double closed = 2.0 * std::sqrt(top.k * top.A) / top.C;
  comparison.number("symmetric: 2 sqrt(kA)/C by the polynomial", closed, sleepingSpeed(top), 1e-9);
  std::vector<double> speeds;
  for (const double turn : {16e-3, 8e-3, 4e-3}) {
    speeds.push_back(
        criticalSpeed(round, Vector3d::Zero(), top, closed, spinSettings(closed, turn)));
    comparison.number("symmetric, " + std::to_string(turn) + " radians a step", closed,
                      speeds.back(), 0.03 * closed);
  }
  comparison.below("change with the second halving of the step, over the first", 0.75,
                   std::abs(speeds[2] - speeds[1]) / std::abs(speeds[1] - speeds[0]));
  Settings settings = spinSettings(2.0);
  settings.gravity = 10.0; // so that k = 1
  const Body uneven = topWith(1.0, 0.8, 1.2, 0.1);
  const Top unevenTop{1.0, 0.8, 1.2, 1.0};
  comparison.number("(1.0, 0.8, 1.2), k = 1, by the polynomial", std::sqrt(5.0),
                    sleepingSpeed(unevenTop), 1e-9);
  comparison.number("(1.0, 0.8, 1.2), k = 1", std::sqrt(5.0),
                    criticalSpeed(uneven, Vector3d::Zero(), unevenTop, std::sqrt(5.0), settings),
                    0.03 * std::sqrt(5.0));
  const auto wobbles = [&](const Body& body, double speed) {
    return amplification(body, Vector3d::Zero(), speed, kSpinDuration, settings) >= kWobbles;
  };
  comparison.truth("(1.0, 0.8, 1.2) wobbles at 1.65", true, wobbles(uneven, 1.65));
  comparison.truth("(1.0, 0.8, 1.2) wobbles at 1.5", growthRate(unevenTop, 1.5) > 0.0,
                   wobbles(uneven, 1.5));
  const Body middle = topWith(1.2, 0.6, 1.0, 0.1);
  comparison.truth("(1.2, 0.6, 1.0) sleeps at some speed", false,
                   std::isfinite(sleepingSpeed({1.2, 0.6, 1.0, 1.0})));
  for (const double speed : {3.0, 10.0}) {
    comparison.truth("(1.2, 0.6, 1.0) wobbles at " + std::to_string(speed), true,
                     wobbles(middle, speed));
  }
}

void checkTipping(Comparison& comparison) {
  comparison.title("tipping angle of a box 0.3 x 0.4 x 0.8");
  const Body body = bodyOf(box({0.3, 0.4, 0.8}));
  Contacts corners;
  corners.points = contactPolygon(body.surface);
  const double side = std::atan2(0.15, 0.4) * kDegrees;
  for (const double step : {2e-3, 1e-3, 5e-4}) {
    Settings settings;
    settings.step = step;
    comparison.number("over a side, step " + std::to_string(step), side,
                      tippingAngle(body, corners, {1, 0}, side - 2.0, side + 2.0, settings), 0.5);
  }
  const double corner = std::atan2(0.25, 0.4) * kDegrees;
  comparison.number("over a corner", corner,
                    tippingAngle(body, corners, {0.6, 0.8}, corner - 2.0, corner + 2.0), 0.5);
  corners.asHull = true;
  comparison.number("over a side, as one hull", side,
                    tippingAngle(body, corners, {1, 0}, side - 2.0, side + 2.0), 0.5);
}

void checkRests(Comparison& comparison) {
  comparison.title("rests");
  const Body body = bodyOf(box({0.3, 0.4, 0.8}));
  const Vector3d corner = body.surface.vertices.row(7);
  comparison.number("box hanging from a corner", std::atan2(0.25, 0.4) * kDegrees,
                    hangingAngle(body, corner), 0.01);
  double most = 0.0;
  for (const Vector3d& down : restsAfterDrops(body, 12)) {
    most = std::max(most, std::acos(down.cwiseAbs().maxCoeff()) * kDegrees);
  }
  comparison.below("dropped box: degrees off lying on a face", 0.5, most);
}

/// 1 x 1 x 1.3 of relative density 0.1: upright it is stable, and does not come back from more than
/// 25.3 degrees over a side, 23.0 over a corner.
void checkFloating(Comparison& comparison) {
  comparison.title("floating box 1 x 1 x 1.3, relative density 0.1");
  const Body body = bodyOf(box({1.0, 1.0, 1.3}));
  const double displaced = 0.13;
  const Floated upright = floated(body, displaced, 5.0, 0.3);
  comparison.number("heel", 0.0, upright.heel, 0.1);
  comparison.number("draught", displaced, upright.draught, 1e-4);
  for (const auto& [name, azimuth, barrier] :
       {std::tuple("side", 0.0, 25.3), std::tuple("corner", std::atan(1.0), 23.0)}) {
    double low = barrier - 3.0;
    double high = barrier + 3.0;
    while (high - low > 0.1) {
      const double middle = 0.5 * (low + high);
      (floated(body, displaced, middle, azimuth).heel < 1.0 ? low : high) = middle;
    }
    comparison.number(std::string("heel from which it does not come back, over a ") + name, barrier,
                      0.5 * (low + high), 0.5);
  }
}

void checkFreeSpin(Comparison& comparison) {
  comparison.title("free spin");
  const Body flat = bodyOf(box({0.6, 0.5, 0.2}));
  comparison.below("about the largest moment: degrees of wobble", expectedFreeWobble(flat),
                   freeWobble(flat));
  const Body middle = bodyOf(box({0.6, 0.2, 0.5}));
  comparison.truth("about the middle moment: turns over", true, freeWobble(middle) > 90.0);
}

} // namespace

void checkMethod(Comparison& comparison) {
  checkMassProperties(comparison);
  compareGyroscopicTerms(comparison);
  checkTops(comparison);
  checkTipping(comparison);
  checkRests(comparison);
  checkFloating(comparison);
  checkFreeSpin(comparison);
}

} // namespace simulation
