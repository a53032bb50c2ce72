#include "core/physics/moments.h"

#include "core/base/parallel.h"
#include "core/base/triangle.h"

#include <vector>

namespace massprops {
namespace {

constexpr Eigen::Index kChunk = 2048;

using SymmetricSix = Eigen::Matrix<double, 6, 1>;

/// (xx, yy, zz, xy, yz, zx) of p pᵀ.
SymmetricSix square(const Vec3& p) {
  SymmetricSix six;
  six << p.x() * p.x(), p.y() * p.y(), p.z() * p.z(), p.x() * p.y(), p.y() * p.z(), p.z() * p.x();
  return six;
}

template <bool WithSecond>
MomentRates rates(const Points& vertices, const Faces& faces, const Points& directions,
                  Eigen::Index begin, Eigen::Index end) {
  // Reynolds: d/dt ∫q dV = ∫ q λ_a (n·d_a) dA over the triangles at a, λ_a the hat function of a.
  // With N = (b−a)×(c−a) = 2·area·n and ∫λ_a^i λ_b^j λ_c^k dA = 2·area·i!j!k!/(i+j+k+2)!:
  // dV = N·d/6, d∫x = N·d (s + a)/24, d∫x xᵀ = N·d (s sᵀ + Σ p pᵀ + a sᵀ + s aᵀ + 2a aᵀ)/120,
  // where (s+a)(s+a)ᵀ + a aᵀ + Σ p pᵀ is the last bracket.
  constexpr Eigen::Index kTerms = WithSecond ? 10 : 4;
  MomentRates result = MomentRates::Zero(vertices.rows(), kTerms);
  const double* x = vertices.data();
  const double* d = directions.data();
  for (Eigen::Index f = begin; f < end; ++f) {
    const Eigen::Index v[3] = {faces(f, 0), faces(f, 1), faces(f, 2)};
    const double* p[3] = {x + 3 * v[0], x + 3 * v[1], x + 3 * v[2]};
    const double e[3] = {p[1][0] - p[0][0], p[1][1] - p[0][1], p[1][2] - p[0][2]};
    const double g[3] = {p[2][0] - p[0][0], p[2][1] - p[0][1], p[2][2] - p[0][2]};
    const double N[3] = {e[1] * g[2] - e[2] * g[1], e[2] * g[0] - e[0] * g[2],
                         e[0] * g[1] - e[1] * g[0]};
    const double s[3] = {p[0][0] + p[1][0] + p[2][0], p[0][1] + p[1][1] + p[2][1],
                         p[0][2] + p[1][2] + p[2][2]};
    double sum[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    for (int k = 0; WithSecond && k < 3; ++k) {
      const double* q = p[k];
      sum[0] += q[0] * q[0];
      sum[1] += q[1] * q[1];
      sum[2] += q[2] * q[2];
      sum[3] += q[0] * q[1];
      sum[4] += q[1] * q[2];
      sum[5] += q[2] * q[0];
    }
    for (int k = 0; k < 3; ++k) {
      const double* a = p[k];
      const double* direction = d + 3 * v[k];
      const double flux = N[0] * direction[0] + N[1] * direction[1] + N[2] * direction[2];
      const double t[3] = {s[0] + a[0], s[1] + a[1], s[2] + a[2]};
      const double first = flux / 24.0;
      double* rate = result.data() + kTerms * v[k];
      rate[0] += flux / 6.0;
      rate[1] += first * t[0];
      rate[2] += first * t[1];
      rate[3] += first * t[2];
      if (!WithSecond) continue;
      const double second = flux / 120.0;
      rate[4] += second * (sum[0] + t[0] * t[0] + a[0] * a[0]);
      rate[5] += second * (sum[1] + t[1] * t[1] + a[1] * a[1]);
      rate[6] += second * (sum[2] + t[2] * t[2] + a[2] * a[2]);
      rate[7] += second * (sum[3] + t[0] * t[1] + a[0] * a[1]);
      rate[8] += second * (sum[4] + t[1] * t[2] + a[1] * a[2]);
      rate[9] += second * (sum[5] + t[2] * t[0] + a[2] * a[0]);
    }
  }
  return result;
}

} // namespace

Moments moments(const Points& vertices, const Faces& faces, bool withSecond) {
  // Signed tetrahedra (0, a, b, c) with D = a·(b×c) = a·((b−a)×(c−a)), s = a+b+c; the second form
  // cancels less far from the origin.
  // ∫1 = D/6, ∫x = D s/24, ∫x xᵀ = D (s sᵀ + a aᵀ + b bᵀ + c cᵀ)/120.
  std::vector<Moments> parts(static_cast<std::size_t>(chunkCount(faces.rows(), kChunk)));
  forChunks(faces.rows(), kChunk, [&](const Chunk& chunk) {
    double volume = 0.0;
    Vec3 first = Vec3::Zero();
    SymmetricSix second = SymmetricSix::Zero();
    for (Eigen::Index f = chunk.begin; f < chunk.end; ++f) {
      const Vec3 a = vertices.row(faces(f, 0)).transpose();
      const Vec3 b = vertices.row(faces(f, 1)).transpose();
      const Vec3 c = vertices.row(faces(f, 2)).transpose();
      const double D = a.dot(areaNormal(a, b, c));
      const Vec3 s = a + b + c;
      volume += D;
      first += D * s;
      if (withSecond) second += D * (square(s) + square(a) + square(b) + square(c));
    }
    parts[static_cast<std::size_t>(chunk.number)] << volume / 6.0, first / 24.0, second / 120.0;
  });
  Moments result = Moments::Zero();
  for (const Moments& part : parts) result += part;
  return result;
}

MomentsWithRates momentsWithRates(const Points& vertices, const Faces& faces,
                                  const Points& directions, bool withSecond) {
  const Eigen::Index n = faces.rows();
  MomentsWithRates result;
  if (withSecond) {
    inParallel([&] { result.rates = rates<true>(vertices, faces, directions, 0, n); },
               [&] { result.moments = moments(vertices, faces); });
    return result;
  }
  // Four terms are so few that a second array for half of the faces is worth its memory.
  MomentRates others;
  inParallel([&] { result.rates = rates<false>(vertices, faces, directions, 0, n / 2); },
             [&] { others = rates<false>(vertices, faces, directions, n / 2, n); });
  result.rates += others;
  result.moments = moments(vertices, faces, false);
  return result;
}

Mat3 secondMoment(const Moments& m) {
  Mat3 Q;
  Q << m[4], m[7], m[9], m[7], m[5], m[8], m[9], m[8], m[6];
  return Q;
}

} // namespace massprops
