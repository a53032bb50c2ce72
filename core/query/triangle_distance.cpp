#include "core/query/triangle_distance.h"

#include "core/base/infinity.h"
#include "core/base/triangle.h"

#include <algorithm>
#include <cmath>

namespace massprops {
namespace {

/// Whether an edge of t goes through the inside of the triangle (a, b, c).
bool pierces(const Vec3 (&t)[3], const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = areaNormal(a, b, c);
  double side[3];
  for (int k = 0; k < 3; ++k) side[k] = normal.dot(t[k] - a);
  if ((side[0] > 0.0 && side[1] > 0.0 && side[2] > 0.0) ||
      (side[0] < 0.0 && side[1] < 0.0 && side[2] < 0.0)) {
    return false;
  }
  for (int k = 0; k < 3; ++k) {
    const int n = (k + 1) % 3;
    if (side[k] * side[n] > 0.0 || side[k] == side[n]) continue;
    const Vec3 at = t[k] + side[k] / (side[k] - side[n]) * (t[n] - t[k]);
    if (normal.dot(areaNormal(a, b, at)) >= 0.0 && normal.dot(areaNormal(b, c, at)) >= 0.0 &&
        normal.dot(areaNormal(c, a, at)) >= 0.0) {
      return true;
    }
  }
  return false;
}

double squaredDistanceOfTriangles(const Vec3 (&s)[3], const Vec3 (&t)[3]) {
  if (pierces(s, t[0], t[1], t[2]) || pierces(t, s[0], s[1], s[2])) return 0.0;
  double least = kInfinity;
  for (int i = 0; i < 3; ++i) {
    least = std::min(least, (s[i] - nearestOnTriangle(s[i], t[0], t[1], t[2])).squaredNorm());
    least = std::min(least, (t[i] - nearestOnTriangle(t[i], s[0], s[1], s[2])).squaredNorm());
    for (int j = 0; j < 3; ++j) {
      least =
          std::min(least, squaredDistanceOfSegments(s[i], s[(i + 1) % 3], t[j], t[(j + 1) % 3]));
    }
  }
  return least;
}

/// The squared gap between s and t along `axis`, which points from s to t: no more than their
/// squared distance.
double squaredGapAlong(const Vec3& axis, const Vec3 (&s)[3], const Vec3 (&t)[3]) {
  const double endOfS = std::max({axis.dot(s[0]), axis.dot(s[1]), axis.dot(s[2])});
  const double startOfT = std::min({axis.dot(t[0]), axis.dot(t[1]), axis.dot(t[2])});
  const double gap = startOfT - endOfS;
  return gap > 0.0 ? gap * gap / axis.squaredNorm() : 0.0;
}

} // namespace

double squaredDistanceOfSegments(const Vec3& p, const Vec3& q, const Vec3& r, const Vec3& s) {
  const Vec3 d1 = q - p;
  const Vec3 d2 = s - r;
  const Vec3 w = p - r;
  const double a = d1.squaredNorm();
  const double e = d2.squaredNorm();
  const double f = d2.dot(w);
  const double c = d1.dot(w);
  const double b = d1.dot(d2);
  const double denominator = a * e - b * b;
  double t = 0.0;
  double u = 0.0;
  if (a > 0.0) {
    // Nearly parallel: any point will do, for ends are compared with the other triangle as well.
    if (denominator > 1e-14 * a * e) t = std::clamp((b * f - c * e) / denominator, 0.0, 1.0);
    u = e > 0.0 ? (b * t + f) / e : 0.0;
    if (!(u >= 0.0)) {
      u = 0.0;
      t = std::clamp(-c / a, 0.0, 1.0);
    } else if (u > 1.0) {
      u = 1.0;
      t = std::clamp((b - c) / a, 0.0, 1.0);
    }
  } else if (e > 0.0) {
    u = std::clamp(f / e, 0.0, 1.0);
  }
  return (w + t * d1 - u * d2).squaredNorm();
}

Vec3 nearestOnTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 w = nearestWeights(p, a, b, c);
  return w[0] * a + w[1] * b + w[2] * c;
}

double squaredDistanceBelow(double squaredBound, const Vec3 (&s)[3], const Vec3 (&t)[3]) {
  constexpr int kSteps = 4;
  Vec3 ofS = Vec3::Zero();
  Vec3 ofT = (t[0] + t[1] + t[2]) / 3.0;
  for (int step = 0; step < kSteps; ++step) {
    if (step % 2 == 0) {
      ofS = nearestOnTriangle(ofT, s[0], s[1], s[2]);
    } else {
      ofT = nearestOnTriangle(ofS, t[0], t[1], t[2]);
    }
    const Vec3 way = ofT - ofS;
    const double atLeast = (1.0 + kMeasured) * squaredGapAlong(way, s, t);
    if (atLeast >= squaredBound) return squaredBound;
    const double atMost = way.squaredNorm();
    const bool isDirectionKnown = atMost > kMeasured * kMeasured * squaredBound;
    if (atLeast >= atMost && isDirectionKnown) return atMost;
  }
  return std::min(squaredBound, squaredDistanceOfTriangles(s, t));
}

} // namespace massprops
