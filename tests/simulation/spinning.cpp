#include "simulation/spinning.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <vector>

namespace simulation {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kRadians = kPi / 180.0;
constexpr double kMostSteps = 1e6;
constexpr double kFirstTilt = 0.1; // degrees: small, so that the linear equations hold

/// AB s⁴ + b s² + c = 0, with b = b1 ω² − b0 and c = (c1 ω² − k)(c2 ω² − k).
struct Characteristic {
  explicit Characteristic(const Top& top)
      : a(top.A * top.B), b1(top.A * (top.C - top.A) + top.B * (top.C - top.B) +
                             (top.A + top.B - top.C) * (top.A + top.B - top.C)),
        b0(top.k * (top.A + top.B)), c1(top.C - top.A), c2(top.C - top.B), k(top.k) {}

  double b(double w) const { return b1 * w - b0; }
  double c(double w) const { return (c1 * w - k) * (c2 * w - k); }

  /// ω² at which stability can begin or end.
  std::vector<double> candidates() const {
    std::vector<double> w{k / c1, k / c2, b0 / b1};
    // b² = 4ac
    const double p = b1 * b1 - 4.0 * a * c1 * c2;
    const double q = 2.0 * a * k * (c1 + c2) - b0 * b1;
    const double r = b0 * b0 - 4.0 * a * k * k;
    const double root = std::sqrt(std::max(0.0, q * q - p * r));
    w.push_back((-q + root) / p);
    w.push_back((-q - root) / p);
    w.erase(
        std::remove_if(w.begin(), w.end(), [](double x) { return !(x > 0.0 && std::isfinite(x)); }),
        w.end());
    std::sort(w.begin(), w.end());
    return w;
  }

  double a, b1, b0, c1, c2, k;
};

} // namespace

double growthRate(const Top& top, double speed) {
  const Characteristic f(top);
  const double w = speed * speed;
  const std::complex<double> root =
      std::sqrt(std::complex<double>(f.b(w) * f.b(w) - 4.0 * f.a * f.c(w)));
  double rate = 0.0;
  for (const double sign : {1.0, -1.0}) {
    rate = std::max(rate, std::sqrt((-f.b(w) + sign * root) / (2.0 * f.a)).real());
  }
  return rate;
}

double sleepingSpeed(const Top& top) {
  // For friction to slow it by e; it has to double what grows on its way through a band.
  constexpr double kTurns = 1000.0;
  const std::vector<double> w = Characteristic(top).candidates();
  if (w.empty() || growthRate(top, std::sqrt(2.0 * w.back())) > 0.0) {
    return std::numeric_limits<double>::infinity();
  }
  for (std::size_t i = w.size(); i-- > 0;) {
    const double below = i > 0 ? w[i - 1] : 0.0;
    const double middle = std::sqrt(0.5 * (w[i] + below));
    const double turns = kTurns * 0.5 * std::log(w[i] / below);
    if (growthRate(top, middle) * turns * 2.0 * kPi > std::log(2.0) * middle) {
      return std::sqrt(w[i]);
    }
  }
  return 0.0;
}

Top topOf(const Body& body, const Vector3d& tip) {
  const double h = body.centre.z() - tip.z();
  const Eigen::Matrix2d horizontal = body.inertia.topLeftCorner<2, 2>();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> eigen(horizontal);
  return {eigen.eigenvalues()[1] + h * h, eigen.eigenvalues()[0] + h * h, body.inertia(2, 2), h};
}

Settings spinSettings(double speed, double turn) {
  Settings settings;
  settings.step = turn / speed;
  return settings;
}

double amplification(const Body& body, const Vector3d& tip, double speed, double duration,
                     const Settings& settings) {
  World world(body, settings);
  const Vector3d axis = Vector3d(0.8, 0.6, 0.0);
  const Matrix3d leaning = Eigen::AngleAxisd(kFirstTilt * kRadians, axis).toRotationMatrix();
  world.place(leaning, {0, 0, 0});
  world.pin(tip);
  // About its own axis: let go, not led round a cone.
  world.spin(speed * leaning.col(2), tip);
  double most = kFirstTilt;
  while (world.time() < duration && most < kWobbles * kFirstTilt) {
    world.step();
    most = std::max(most, tilt(world.rotation()));
  }
  return most / kFirstTilt;
}

double criticalSpeed(const Body& body, const Vector3d& tip, const Top& top, double expected,
                     const Settings& settings) {
  const double duration = kSpinDuration * std::sqrt(top.A / top.k);
  double low = 0.8 * expected;
  double high = 1.2 * expected;
  while (high - low > 3e-4 * expected) {
    const double middle = 0.5 * (low + high);
    const bool wobbles = amplification(body, tip, middle, duration, settings) >= kWobbles;
    (wobbles ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

void compareSpinning(const Body& body, const Vector3d& tip, bool balanced, const std::string& state,
                     Comparison& comparison) {
  const Top top = topOf(body, tip);
  const double sleeping = sleepingSpeed(top);
  const double duration = kSpinDuration * std::sqrt(top.A / top.k);
  const auto wobbles = [&](double speed) {
    return amplification(body, tip, speed, duration, spinSettings(speed)) >= kWobbles;
  };
  if (!balanced || !std::isfinite(sleeping)) {
    const double round = 2.0 * std::sqrt(top.k * top.A) / top.C;
    comparison.truth(state + ": wobbles at three times a round top's speed", true,
                     wobbles(3.0 * round));
    return;
  }
  if (duration / spinSettings(sleeping).step > kMostSteps) {
    comparison.note("so slim that it turns too often to be simulated");
    return;
  }
  comparison.number(state + ": speed from which on it sleeps", sleeping,
                    criticalSpeed(body, tip, top, sleeping, spinSettings(sleeping)),
                    0.03 * sleeping);
  for (const double share : {0.9, 1.1, 2.0}) {
    comparison.truth(state + ": wobbles at " + std::to_string(share).substr(0, 3) + " of it",
                     growthRate(top, share * sleeping) > 0.0, wobbles(share * sleeping));
  }
}

} // namespace simulation
