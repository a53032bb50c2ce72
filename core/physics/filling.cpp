#include "core/physics/filling.h"

#include "core/base/triangle.h"
#include "core/physics/hydrostatics.h"
#include "core/physics/mass_properties.h"

#include <array>
#include <cstddef>

namespace massprops {
namespace {

/// Where a triangle is clipped: a point, and the values of its three hat functions there.
struct ClippedCorner {
  Vec3 point;
  Vec3 hats;
};

struct Polygon {
  std::array<ClippedCorner, 4> corners;
  std::size_t size = 0;
};

Polygon clippedBelow(const std::array<Vec3, 3>& triangle, double level) {
  Polygon below;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    const double height = triangle[k].z() - level;
    const double nextHeight = triangle[next].z() - level;
    const auto hat = [](std::size_t i) { return Vec3(Vec3::Unit(static_cast<Eigen::Index>(i))); };
    if (height <= 0.0) below.corners[below.size++] = {triangle[k], hat(k)};
    if ((height <= 0.0) == (nextHeight <= 0.0)) continue;
    const double share = height / (height - nextHeight);
    below.corners[below.size++] = {triangle[k] + share * (triangle[next] - triangle[k]),
                                   (1.0 - share) * hat(k) + share * hat(next)};
  }
  return below;
}

} // namespace

Moments momentsBelow(const Points& vertices, const Faces& faces, double level) {
  const Displacement below = displacement(vertices, faces, Vec3::UnitZ(), level);
  Moments result = Moments::Zero();
  result[0] = below.volume;
  if (below.volume > 0.0) result.segment<3>(1) = below.volume * below.centre;
  return result;
}

MomentsWithRates momentsBelowWithRates(const Points& vertices, const Faces& faces,
                                       const Points& directions, double level) {
  // Reynolds, as for the whole surface: the level rests, so that only what is below it of each
  // triangle counts. With N = 2·area·n of a part and the hat function's values h at its corners p:
  // ∫h n dA = N Σh/6, ∫h x n dA = N (Σh Σp + Σ h p)/24.
  MomentsWithRates result{momentsBelow(vertices, faces, level),
                          MomentRates::Zero(vertices.rows(), 4)};
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const auto corner = [&](int k) { return Vec3(vertices.row(faces(f, k)).transpose()); };
    const Polygon below = clippedBelow({corner(0), corner(1), corner(2)}, level);
    for (std::size_t i = 2; i < below.size; ++i) {
      const ClippedCorner& a = below.corners[0];
      const ClippedCorner& b = below.corners[i - 1];
      const ClippedCorner& c = below.corners[i];
      const Vec3 N = areaNormal(a.point, b.point, c.point);
      const Vec3 sum = a.point + b.point + c.point;
      for (int k = 0; k < 3; ++k) {
        const double flux = N.dot(directions.row(faces(f, k)));
        const double hats = a.hats[k] + b.hats[k] + c.hats[k];
        const Vec3 weighted =
            hats * sum + a.hats[k] * a.point + b.hats[k] * b.point + c.hats[k] * c.point;
        auto rate = result.rates.row(faces(f, k));
        rate[0] += flux * hats / 6.0;
        rate.segment<3>(1) += flux / 24.0 * weighted.transpose();
      }
    }
  }
  return result;
}

std::vector<Moments> filledMoments(const Moments& outer, const Points& inner, const Faces& faces,
                                   const Fillings& fillings) {
  const Moments cavity = moments(inner, faces);
  std::vector<Moments> states;
  for (const Filling& filling : fillings) {
    Moments body = shellMoments(outer, cavity, 1.0, filling.isPartial() ? 0.0 : filling.density);
    if (filling.isPartial()) body += filling.density * momentsBelow(inner, faces, filling.level);
    states.push_back(body);
  }
  return states;
}

} // namespace massprops
