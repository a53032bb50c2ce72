// The ten integrals against closed forms, laws of motion and scale, and central differences.
#include "core/physics/moments.h"

#include "shapes.h"
#include "translated_moments.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>

namespace massprops::testing {
namespace {

constexpr double kPi = 3.14159265358979323846;

Moments momentsOf(const TriangleMesh& mesh) {
  return moments(mesh.vertices, mesh.faces);
}

/// Largest difference, each entry against the size of its kind (volume, first, second moments).
double relativeDifference(const Moments& actual, const Moments& expected) {
  const auto part = [&](int start, int size) {
    const double scale = expected.segment(start, size).cwiseAbs().maxCoeff();
    return (actual - expected).segment(start, size).cwiseAbs().maxCoeff() / std::max(scale, 1e-300);
  };
  return std::max({part(0, 1), part(1, 3), part(4, 6)});
}

Moments make(double volume, const Vec3& first, const Vec3& squares, const Vec3& products) {
  Moments result;
  result << volume, first, squares, products;
  return result;
}

/// ∫ over the box [0, a]×[0, b]×[0, c].
Moments boxMoments(const Vec3& s) {
  const double v = s.prod();
  return make(v, v * s / 2, v * s.cwiseAbs2() / 3,
              v * Vec3(s.x() * s.y(), s.y() * s.z(), s.z() * s.x()) / 4);
}

// Polyhedra are integrated exactly; 1e-12 leaves room for some hundred roundings in the sums.
constexpr double kRounding = 1e-12;

TEST(Moments, OfABoxMatchTheClosedForm) {
  const Vec3 size(1.0, 2.5, 0.4);
  const Moments expected = boxMoments(size);
  for (const int n : {1, 3, 10}) {
    const TriangleMesh mesh = transformed(box(size, n), Mat3::Identity(), size / 2);
    EXPECT_LT(relativeDifference(momentsOf(mesh), expected), kRounding) << "n = " << n;
  }
}

TEST(Moments, OfTheCornerTetrahedronMatchTheClosedForm) {
  // Over x, y, z ≥ 0, x + y + z ≤ 1: ∫x^i y^j z^k = i! j! k! / (i+j+k+3)!
  const TriangleMesh mesh = tetrahedron(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ());
  const Moments expected =
      make(1.0 / 6, Vec3::Constant(1.0 / 24), Vec3::Constant(1.0 / 60), Vec3::Constant(1.0 / 120));
  EXPECT_LT(relativeDifference(momentsOf(mesh), expected), kRounding);
}

TEST(Moments, OfAnyTetrahedronAreItsVolumeTimesSymmetricSumsOfItsCorners) {
  // ∫x xᵀ = V/20 (s sᵀ + Σ p pᵀ) with s the sum of the corners: an independent form. [Ton05]
  Random random(7);
  for (int trial = 0; trial < 20; ++trial) {
    std::array<Vec3, 4> p = {random.vector(), random.vector(), random.vector(), random.vector()};
    double six = (p[1] - p[0]).dot((p[2] - p[0]).cross(p[3] - p[0]));
    if (six < 0) {
      std::swap(p[2], p[3]);
      six = -six;
    }
    if (six < 0.05) continue; // nearly flat: the relative error is that of the data
    const double volume = six / 6;
    const Vec3 s = p[0] + p[1] + p[2] + p[3];
    Mat3 second = s * s.transpose();
    for (const Vec3& corner : p) second += corner * corner.transpose();
    second *= volume / 20;
    const Moments expected =
        make(volume, volume * s / 4, second.diagonal(), {second(0, 1), second(1, 2), second(2, 0)});
    const Moments actual = momentsOf(tetrahedron(p[0], p[1], p[2], p[3]));
    EXPECT_LT(relativeDifference(actual, expected), 1e-11);
    EXPECT_LT((secondMoment(actual) - second).norm(), 1e-12);
  }
}

TEST(Moments, OfAShearedBoxFollowTheLinearMap) {
  // Under x ↦ Ax: V ↦ det(A)·V, S ↦ det(A)·AS, Q ↦ det(A)·AQAᵀ.
  const Vec3 size(1.0, 0.7, 2.0);
  const Mat3 A = someRotation() * shear(0.6) * Vec3(1.2, 0.8, 1.5).asDiagonal();
  const TriangleMesh mesh = transformed(box(size, 2), Mat3::Identity(), size / 2);
  const Moments before = boxMoments(size);
  const double det = A.determinant();
  const Mat3 second = det * A * secondMoment(before) * A.transpose();
  const Moments expected = make(det * before[0], det * A * before.segment<3>(1), second.diagonal(),
                                {second(0, 1), second(1, 2), second(2, 0)});
  EXPECT_LT(relativeDifference(momentsOf(transformed(mesh, A)), expected), kRounding);
}

TEST(Moments, OfRevolvedPolygonsAreStacksOfFrustumsWithRegularPolygonsAsSections) {
  // The section at height z is a regular polygon with circumradius r(z):
  // area = n/2 sin(2π/n) r² and ∫x² = ∫y² = area·r²·(2 + cos(2π/n))/12. r is linear in z.
  const std::vector<Vec2> profile = {{0, 3}, {1, 3}, {2, 1}, {0.5, -1}, {0, -1}};
  const int n = 7;
  const double sector = 2 * kPi / n;
  Moments expected = Moments::Zero();
  for (std::size_t i = 1; i + 2 < profile.size(); ++i) {
    const Vec2 low = profile[i + 1];
    const Vec2 high = profile[i];
    // Polynomials of degree 4 in z: three Gauss points are exact up to degree 5.
    const std::array<std::array<double, 2>, 3> gauss = {
        {{-std::sqrt(0.6), 5.0 / 9}, {0.0, 8.0 / 9}, {std::sqrt(0.6), 5.0 / 9}}};
    for (const auto& [x, weight] : gauss) {
      const Vec2 at = low + (high - low) * (x + 1) / 2;
      const double dz = weight * (high.y() - low.y()) / 2;
      const double area = 0.5 * n * std::sin(sector) * at.x() * at.x();
      const double square = area * at.x() * at.x() * (2 + std::cos(sector)) / 12;
      expected[0] += area * dz;
      expected[3] += at.y() * area * dz;
      expected[4] += square * dz;
      expected[5] += square * dz;
      expected[6] += at.y() * at.y() * area * dz;
    }
  }
  EXPECT_LT(relativeDifference(momentsOf(revolved(profile, n)), expected), kRounding);
}

/// Errors at two resolutions whose edge lengths differ by 2 must differ by 4: inscribed polyhedra
/// converge with the square of the edge length. 10 % leave room for the next order.
void expectSecondOrder(double coarse, double fine) {
  EXPECT_GT(coarse, 1e-6); // else there is nothing to see
  EXPECT_NEAR(coarse / fine, 4.0, 0.4);
}

TEST(Moments, OfAnEllipsoidConvergeQuadratically) {
  const Vec3 r(1.0, 0.6, 1.7);
  const double volume = 4 * kPi / 3 * r.prod();
  const Moments expected = make(volume, Vec3::Zero(), volume * r.cwiseAbs2() / 5, Vec3::Zero());
  const auto errors = [&](int frequency) -> Vec2 {
    const Moments m = momentsOf(ellipsoid(r, frequency));
    EXPECT_LT(m.segment<3>(1).norm(), 1e-12); // symmetric meshes: exactly centred
    return {1 - m[0] / expected[0],
            (m.segment<3>(4) - expected.segment<3>(4)).norm() / expected.segment<3>(4).norm()};
  };
  const Vec2 coarse = errors(10);
  const Vec2 fine = errors(20);
  EXPECT_GT(coarse[0], 0.0); // inscribed
  expectSecondOrder(coarse[0], fine[0]);
  expectSecondOrder(coarse[1], fine[1]);
}

TEST(Moments, OfATorusConvergeQuadratically) {
  const double R = 2.0;
  const double a = 0.7;
  const double volume = 2 * kPi * kPi * R * a * a;
  const double xx = volume * (4 * R * R + 3 * a * a) / 8; // half of ∫(x² + y²)
  const double zz = volume * a * a / 4;
  const auto errors = [&](int n) -> Vec3 {
    const Moments m = momentsOf(torus(R, a, 3 * n, n));
    return {1 - m[0] / volume, 1 - m[4] / xx, 1 - m[6] / zz};
  };
  const Vec3 coarse = errors(24);
  const Vec3 fine = errors(48);
  for (int i = 0; i < 3; ++i) expectSecondOrder(coarse[i], fine[i]);
}

TEST(Moments, AreAdditive) {
  const TriangleMesh a = blob(6);
  const TriangleMesh b = transformed(torus(2, 0.5, 12, 8), someRotation(), {3, 0, 1});
  EXPECT_LT(relativeDifference(momentsOf(joined(a, b)), momentsOf(a) + momentsOf(b)), kRounding);
}

TEST(Moments, ChangeSignWithTheOrientation) {
  const TriangleMesh mesh = blob(6);
  EXPECT_LT(relativeDifference(momentsOf(reversed(mesh)), -momentsOf(mesh)), kRounding);
}

TEST(Moments, ScaleWithThirdFourthAndFifthPower) {
  const TriangleMesh mesh = blob(6);
  const Moments before = momentsOf(mesh);
  for (const double factor : {1e-3, 0.3, 1e3}) {
    Moments expected = before;
    expected[0] *= std::pow(factor, 3);
    expected.segment<3>(1) *= std::pow(factor, 4);
    expected.segment<6>(4) *= std::pow(factor, 5);
    EXPECT_LT(relativeDifference(momentsOf(scaled(mesh, factor)), expected), kRounding);
  }
}

TEST(Moments, TranslatedAgreeWithTheMovedMesh) {
  const TriangleMesh mesh = blob(6);
  const Vec3 shift(0.8, -1.5, 2.2);
  EXPECT_LT(relativeDifference(translated(momentsOf(mesh), shift),
                               momentsOf(transformed(mesh, Mat3::Identity(), shift))),
            kRounding);
}

TEST(Moments, RotateAsTensors) {
  const TriangleMesh mesh = transformed(blob(6), Mat3::Identity(), {0.3, 0.2, -0.4});
  const Mat3 R = someRotation();
  const Moments before = momentsOf(mesh);
  const Moments after = momentsOf(transformed(mesh, R));
  EXPECT_NEAR(after[0], before[0], 1e-12);
  EXPECT_LT((after.segment<3>(1) - R * before.segment<3>(1)).norm(), 1e-12);
  EXPECT_LT((secondMoment(after) - R * secondMoment(before) * R.transpose()).norm(), 1e-12);
}

TEST(Moments, LoseOnlyTheDigitsThatTheDistanceCosts) {
  // A body of size 1 at distance R = 1e4. D = a·N is of order R times the area of a face and loses
  // 4 of 16 digits, which leaves some 1e-12; as a·(b×c), of order R³, it would lose all.
  const TriangleMesh mesh = blob(10);
  const TriangleMesh far = transformed(mesh, Mat3::Identity(), {6e3, -7e3, 4e3});
  EXPECT_NEAR(momentsOf(far)[0] / momentsOf(mesh)[0], 1.0, 1e-10);
}

/// Central differences of all ten moments along `directions`, one vertex at a time.
Eigen::Matrix<double, 10, 1> centralDifference(const TriangleMesh& mesh, const Points& directions,
                                               Eigen::Index vertex) {
  // The moments are polynomials of degree 3 … 5 in one vertex, of order one: h² = 1e-8 for the
  // truncation and 1e-16/h = 1e-12 for the rounding.
  const double h = 1e-4;
  TriangleMesh moved = mesh;
  moved.vertices.row(vertex) += h * directions.row(vertex);
  const Moments plus = momentsOf(moved);
  moved.vertices.row(vertex) = mesh.vertices.row(vertex) - h * directions.row(vertex);
  return (plus - momentsOf(moved)) / (2 * h);
}

TEST(MomentRates, MatchCentralDifferences) {
  for (const TriangleMesh& mesh :
       {jittered(box({1, 1.5, 2}, 2), 0.1, 1),
        transformed(blob(2), someRotation(), {0.3, 0.1, -0.2}), torus(1.0, 0.4, 6, 4)}) {
    Points directions(mesh.vertices.rows(), 3);
    Random random(11);
    for (Eigen::Index i = 0; i < directions.rows(); ++i)
      directions.row(i) = random.vector().transpose();
    const MomentRates rates = momentsWithRates(mesh.vertices, mesh.faces, directions).rates;
    for (Eigen::Index i = 0; i < directions.rows(); ++i) {
      const Moments difference = centralDifference(mesh, directions, i);
      EXPECT_LT((rates.row(i).transpose() - difference).cwiseAbs().maxCoeff(), 1e-7)
          << "vertex " << i;
    }
  }
}

TEST(MomentRates, ComeWithTheMomentsThemselves) {
  const TriangleMesh mesh = blob(9);
  const Points directions = mesh.vertices.rowwise().normalized();
  const Moments alone = moments(mesh.vertices, mesh.faces);
  const Moments all = momentsWithRates(mesh.vertices, mesh.faces, directions).moments;
  const Moments few = momentsWithRates(mesh.vertices, mesh.faces, directions, false).moments;
  EXPECT_LT((all - alone).cwiseAbs().maxCoeff(), 1e-14 * alone[0]);
  EXPECT_LT((few.head<4>() - alone.head<4>()).cwiseAbs().maxCoeff(), 1e-14 * alone[0]);
  EXPECT_EQ(few.tail<6>(), Moments::Zero().tail<6>());
}

TEST(MomentRates, OfNoFacesAreZero) {
  const Points points = Points::Random(5, 3);
  EXPECT_EQ(momentsWithRates(points, Faces(0, 3), points).rates, MomentRates::Zero(5, 10));
  EXPECT_EQ(momentsWithRates(points, Faces(0, 3), points, false).rates, MomentRates::Zero(5, 4));
}

TEST(MomentRates, OfTheFirstMomentsAloneAreTheSame) {
  const TriangleMesh mesh = blob(7);
  const Points directions = mesh.vertices.rowwise().reverse();
  const MomentRates all = momentsWithRates(mesh.vertices, mesh.faces, directions).rates;
  const MomentRates few = momentsWithRates(mesh.vertices, mesh.faces, directions, false).rates;
  ASSERT_EQ(few.cols(), 4);
  // Added up in another order.
  EXPECT_LT((few - all.leftCols(4)).cwiseAbs().maxCoeff(), 1e-15 * all.cwiseAbs().maxCoeff());
  const Moments first = moments(mesh.vertices, mesh.faces, false);
  EXPECT_EQ(first.head<4>(), moments(mesh.vertices, mesh.faces).head<4>());
  EXPECT_EQ(first.tail<6>(), Moments::Zero().tail<6>());
}

TEST(MomentRates, OfARigidTranslationAreTheParallelAxisRule) {
  // d/dt of translated(m, t·d) at t = 0: (0, V d, S dᵀ + d Sᵀ).
  const TriangleMesh mesh = blob(5);
  const Vec3 d(0.3, -1.2, 0.7);
  const Points directions = d.transpose().replicate(mesh.vertices.rows(), 1);
  const Vector sum =
      momentsWithRates(mesh.vertices, mesh.faces, directions).rates.colwise().sum().transpose();
  const Moments m = momentsOf(mesh);
  const Vec3 S = m.segment<3>(1);
  const Mat3 second = S * d.transpose() + d * S.transpose();
  const Moments expected =
      make(0, m[0] * d, second.diagonal(), {second(0, 1), second(1, 2), second(2, 0)});
  EXPECT_LT((sum - expected).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(MomentRates, OfGrowthFromTheOriginAreThreeFourAndFiveTimesTheMoments) {
  // Euler's theorem for homogeneous functions of degree 3, 4, 5.
  const TriangleMesh mesh = blob(5);
  const Vector sum =
      momentsWithRates(mesh.vertices, mesh.faces, mesh.vertices).rates.colwise().sum().transpose();
  Moments expected = momentsOf(mesh);
  expected[0] *= 3;
  expected.segment<3>(1) *= 4;
  expected.segment<6>(4) *= 5;
  EXPECT_LT((sum - expected).cwiseAbs().maxCoeff(), 1e-11);
}

} // namespace
} // namespace massprops::testing
