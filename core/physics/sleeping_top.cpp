#include "core/physics/sleeping_top.h"

#include "core/base/angles.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

namespace massprops {
namespace {

/// c2 w² + c1 w + c0
struct Quadratic {
  double c2, c1, c0;
  double operator()(double w) const { return (c2 * w + c1) * w + c0; }
};

/// A B s⁴ + P s² + Q = 0 for disturbances exp(s t), in w, the square of the speed: s² is real and
/// negative twice exactly if P, Q and D = P² − 4 A B Q are positive.
struct Conditions {
  double ab;
  Quadratic p, q, d;
  bool hold(double w) const { return p(w) >= 0.0 && q(w) >= 0.0 && d(w) >= 0.0; }

  /// Of the disturbance that grows fastest, its real part of s.
  double growth(double w) const {
    const std::complex<double> root = std::sqrt(std::complex<double>(d(w)));
    const auto rate = [&](double sign) {
      return std::sqrt((-p(w) + sign * root) / (2.0 * ab)).real();
    };
    return std::max(rate(1.0), rate(-1.0));
  }
};

Conditions conditionsOf(const Top& top) {
  const double A = top.acrossA;
  const double B = top.acrossB;
  const double C = top.axial;
  const double k = top.weightMoment;
  const double product = (C - A) * (C - B);
  const double p = product + A * B;
  return {A * B,
          {0.0, p, -k * (A + B)},
          {product, -k * (2.0 * C - A - B), k * k},
          {std::pow(C * (A + B - C), 2), 2.0 * k * (2.0 * A * B * (2.0 * C - A - B) - (A + B) * p),
           std::pow(k * (A - B), 2)}};
}

void addPositiveRoots(const Quadratic& f, std::vector<double>& roots) {
  const double discriminant = f.c1 * f.c1 - 4.0 * f.c2 * f.c0;
  if (discriminant < 0.0) return;
  // Both without a difference of nearly equal numbers.
  const double q = -0.5 * (f.c1 + std::copysign(std::sqrt(discriminant), f.c1));
  for (const double root : {q / f.c2, f.c0 / q}) {
    if (std::isfinite(root) && root > 0.0) roots.push_back(root);
  }
}

/// Whether a top that friction slows down from w = `above` to `below` passes before a disturbance
/// has doubled.
bool passes(const Conditions& conditions, double below, double above) {
  constexpr double kTurns = 1000.0; // that friction takes to slow it by e: more than by hand
  const double w = 0.5 * (below + above);
  const double turns = kTurns * 0.5 * std::log(above / below);
  return turns * 2.0 * kPi * conditions.growth(w) / std::sqrt(w) < std::log(2.0);
}

} // namespace

bool sleepsAt(const Top& top, double speed) {
  return conditionsOf(top).hold(speed * speed);
}

std::optional<double> sleepingSpeed(const Top& top) {
  const Conditions conditions = conditionsOf(top);
  std::vector<double> borders{0.0};
  for (const Quadratic& f : {conditions.p, conditions.q, conditions.d}) {
    addPositiveRoots(f, borders);
  }
  std::sort(borders.begin(), borders.end());
  // Between two borders nothing changes: from the fastest speeds down to the first unstable ones.
  const double scale = std::abs(top.weightMoment) / (top.acrossA + top.acrossB);
  if (!conditions.hold(2.0 * borders.back() + scale)) return std::nullopt;
  std::size_t i = borders.size() - 1;
  while (i > 0 && (conditions.hold(0.5 * (borders[i - 1] + borders[i])) ||
                   passes(conditions, borders[i - 1], borders[i])))
    --i;
  return std::sqrt(borders[i]);
}

} // namespace massprops
