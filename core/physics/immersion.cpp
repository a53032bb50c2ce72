#include "core/physics/immersion.h"

#include "core/base/interruption.h"
#include "core/base/triangle.h"

#include <algorithm>
#include <cmath>

namespace massprops {

Immersion::Immersion(const Points& vertices, const Faces& faces, const Vec3& up) {
  checkpoint();
  const Vector heights = vertices * up;
  lowest_ = heights.minCoeff();
  height_ = heights.maxCoeff() - lowest_;
  faces_.reserve(static_cast<std::size_t>(faces.rows()));
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const int i = faces(f, 0);
    const int j = faces(f, 1);
    const int k = faces(f, 2);
    const double shadow =
        0.5 * up.dot(areaNormal(vertices.row(i).transpose(), vertices.row(j).transpose(),
                                vertices.row(k).transpose()));
    const double a = heights[i] - lowest_;
    const double b = heights[j] - lowest_;
    const double c = heights[k] - lowest_;
    const double low = std::min({a, b, c});
    const double high = std::max({a, b, c});
    faces_.push_back({shadow, low, std::max(std::min(a, b), std::min(std::max(a, b), c)), high});
  }
}

Immersion::Sums Immersion::below(double level) const {
  checkpoint();
  // With w = height − level, V = ∫w n_z dA and ∫(−w)dV = −∫½w² n_z dA over the wet surface: the
  // waterplane has w = 0. Over a triangle with w = 0 on one edge and w at the third corner the
  // means of w and w² are w/3 and w²/6; by such a triangle a face that is cut differs from nothing
  // or from all of itself.
  const double water = level - lowest_;
  double volume = 0.0;
  double area = 0.0;
  double squares = 0.0;
  for (const Face& f : faces_) {
    if (f.low >= water) continue;
    if (f.middle > water) {
      const double w = f.low - water;
      const double wet = f.shadow * w * w / ((f.middle - f.low) * (f.high - f.low));
      volume += wet * w / 3.0;
      area -= wet;
      squares += wet * w * w / 6.0;
      continue;
    }
    const double a = f.low - water;
    const double b = f.middle - water;
    const double c = f.high - water;
    volume += f.shadow * (a + b + c) / 3.0;
    area -= f.shadow;
    squares += f.shadow * (a * a + b * b + c * c + a * b + b * c + c * a) / 6.0;
    if (c <= 0.0) continue;
    const double dry = f.shadow * c * c / ((f.high - f.low) * (f.high - f.middle));
    volume -= dry * c / 3.0;
    area += dry;
    squares -= dry * c * c / 6.0;
  }
  return {volume, area, -0.5 * squares};
}

double Immersion::levelFor(double volume) const {
  double low = lowest_;
  double high = lowest_ + height_;
  constexpr double kPrecision = 1e-13; // of the height
  const double tolerance = kPrecision * height_;
  double level = 0.5 * (low + high);
  while (high - low > tolerance) {
    const Sums s = below(level);
    (s.volume < volume ? low : high) = level;
    // dV/dlevel is the waterplane's area: Newton, or halves where that leaves the bracket.
    const double newton = level + (volume - s.volume) / s.area;
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    if (std::abs(next - level) <= tolerance) return next;
    level = next;
  }
  return level;
}

} // namespace massprops
