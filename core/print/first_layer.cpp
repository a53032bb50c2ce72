#include "core/print/first_layer.h"

#include "core/base/circle.h"
#include "core/base/infinity.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace massprops {
namespace {

using Segment = std::pair<Vec2, Vec2>;

/// The region's border, the region to the left of each segment.
std::vector<Segment> section(const Points& vertices, const Faces& faces, double height) {
  std::vector<Segment> border;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    Segment segment(Vec2::Zero(), Vec2::Zero());
    for (int k = 0; k < 3; ++k) {
      const Vec3 a = vertices.row(faces(f, k)).transpose();
      const Vec3 b = vertices.row(faces(f, (k + 1) % 3)).transpose();
      const bool isAbove = a.z() > height;
      if (isAbove == (b.z() > height)) continue;
      const Vec2 crossing = (a + (height - a.z()) / (b.z() - a.z()) * (b - a)).head<2>();
      // Around an outward triangle the way down comes first on the border.
      (isAbove ? segment.first : segment.second) = crossing;
    }
    if (segment.first != segment.second) border.push_back(segment);
  }
  return border;
}

/// ∫(1, x, y, xx, xy, yy) by Green's theorem, of triangles between the origin and each segment.
Eigen::Matrix<double, 6, 1> integrals(const std::vector<Segment>& border, const Vec2& origin) {
  Eigen::Matrix<double, 6, 1> sum = Eigen::Matrix<double, 6, 1>::Zero();
  for (const Segment& segment : border) {
    const Vec2 a = segment.first - origin;
    const Vec2 b = segment.second - origin;
    const Vec2 s = a + b;
    const double twiceArea = a.x() * b.y() - a.y() * b.x();
    const auto second = [&](int i, int j) {
      return (s[i] * s[j] + a[i] * a[j] + b[i] * b[j]) / 24;
    };
    Eigen::Matrix<double, 6, 1> part;
    part << 0.5, s.x() / 6, s.y() / 6, second(0, 0), second(0, 1), second(1, 1);
    sum += twiceArea * part;
  }
  return sum;
}

} // namespace

FirstLayer firstLayer(const Points& vertices, const Faces& faces, double height) {
  const std::vector<Segment> border = section(vertices, faces, height);
  if (border.empty()) return {};
  const Vec2 origin = border.front().first;
  const Eigen::Matrix<double, 6, 1> whole = integrals(border, origin);
  FirstLayer layer;
  layer.area = whole[0];
  if (!(layer.area > 0.0)) return {};
  const Vec2 centre = origin + whole.segment<2>(1) / layer.area;
  const Eigen::Matrix<double, 6, 1> central = integrals(border, centre);

  layer.sectionModulus = kInfinity;
  for (int i = 0; i < kAround; ++i) {
    const Vec2 u = onCircle(i);
    const double inertia =
        u.x() * u.x() * central[3] + 2.0 * u.x() * u.y() * central[4] + u.y() * u.y() * central[5];
    double reach = 0.0;
    for (const Segment& segment : border) {
      reach = std::max(reach, u.dot(segment.first - centre));
    }
    if (reach > 0.0) layer.sectionModulus = std::min(layer.sectionModulus, inertia / reach);
  }
  return layer;
}

bool holds(const FirstLayer& layer, double height) {
  constexpr double kAdhesion = 0.02; // MPa
  constexpr double kPush = 0.0981;   // N, the weight of ten grams
  return layer.sectionModulus * kAdhesion >= kPush * height;
}

} // namespace massprops
