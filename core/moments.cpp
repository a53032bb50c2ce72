#include "core/moments.h"

namespace massprops {
namespace {

using Row3 = Eigen::RowVector3d;
using SymmetricSix = Eigen::Matrix<double, 1, 6>;

/// (xx, yy, zz, xy, yz, zx) of the symmetric product (p qᵀ + q pᵀ)/2.
SymmetricSix symmetricProduct(const Row3& p, const Row3& q) {
  SymmetricSix six;
  six << p.x() * q.x(), p.y() * q.y(), p.z() * q.z(), 0.5 * (p.x() * q.y() + p.y() * q.x()),
      0.5 * (p.y() * q.z() + p.z() * q.y()), 0.5 * (p.z() * q.x() + p.x() * q.z());
  return six;
}

SymmetricSix square(const Row3& p) {
  SymmetricSix six;
  six << p.x() * p.x(), p.y() * p.y(), p.z() * p.z(), p.x() * p.y(), p.y() * p.z(), p.z() * p.x();
  return six;
}

} // namespace

Moments moments(const Points& vertices, const Faces& faces) {
  // Signed tetrahedra (0, a, b, c) with D = a·(b×c) = a·((b−a)×(c−a)), s = a+b+c; the second form
  // cancels less far from the origin.
  // ∫1 = D/6, ∫x = D s/24, ∫x xᵀ = D (s sᵀ + a aᵀ + b bᵀ + c cᵀ)/120.
  double volume = 0.0;
  Row3 first = Row3::Zero();
  SymmetricSix second = SymmetricSix::Zero();
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const Row3 a = vertices.row(faces(f, 0));
    const Row3 b = vertices.row(faces(f, 1));
    const Row3 c = vertices.row(faces(f, 2));
    const double D = a.dot((b - a).cross(c - a));
    const Row3 s = a + b + c;
    volume += D;
    first += D * s;
    second += D * (square(s) + square(a) + square(b) + square(c));
  }
  Moments result;
  result << volume / 6.0, first.transpose() / 24.0, second.transpose() / 120.0;
  return result;
}

MomentRates momentRates(const Points& vertices, const Faces& faces, const Points& directions) {
  // Reynolds: d/dt ∫q dV = ∫ q λ_a (n·d_a) dA over the triangles at a, λ_a the hat function of a.
  // With N = (b−a)×(c−a) = 2·area·n and ∫λ_a^i λ_b^j λ_c^k dA = 2·area·i!j!k!/(i+j+k+2)!:
  // dV = N·d/6, d∫x = N·d (s + a)/24, d∫x xᵀ = N·d (s sᵀ + Σ p pᵀ + a sᵀ + s aᵀ + 2a aᵀ)/120.
  MomentRates rates = MomentRates::Zero(vertices.rows(), 10);
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const Row3 corner[3] = {vertices.row(faces(f, 0)), vertices.row(faces(f, 1)),
                            vertices.row(faces(f, 2))};
    const Row3 N = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
    const Row3 s = corner[0] + corner[1] + corner[2];
    const SymmetricSix common =
        square(s) + square(corner[0]) + square(corner[1]) + square(corner[2]);
    for (int k = 0; k < 3; ++k) {
      const Row3& a = corner[k];
      const double flux = N.dot(directions.row(faces(f, k)));
      auto rate = rates.row(faces(f, k));
      rate[0] += flux / 6.0;
      rate.segment<3>(1) += (flux / 24.0) * (s + a);
      rate.segment<6>(4) += (flux / 120.0) * (common + 2.0 * symmetricProduct(a, s + a));
    }
  }
  return rates;
}

Moments translated(const Moments& moments, const Vec3& shift) {
  // ∫(x+t)(x+t)ᵀ = ∫xxᵀ + S tᵀ + t Sᵀ + V t tᵀ
  const double V = moments[0];
  const Row3 S = moments.segment<3>(1).transpose();
  const Row3 t = shift.transpose();
  Moments result = moments;
  result.segment<3>(1) += V * shift;
  result.segment<6>(4) += (2.0 * symmetricProduct(S, t) + V * square(t)).transpose();
  return result;
}

Mat3 secondMoment(const Moments& m) {
  Mat3 Q;
  Q << m[4], m[7], m[9], m[7], m[5], m[8], m[9], m[8], m[6];
  return Q;
}

} // namespace massprops
