// What a body weighs whose cavity is filled up to a level, against closed forms and differences.
#include "core/physics/filling.h"

#include "shapes.h"

#include <gtest/gtest.h>

#include <array>

namespace massprops::testing {
namespace {

TEST(MomentsBelow, OfABoxAreThoseOfALowerBox) {
  const Vec3 size(1.0, 2.5, 0.4);
  const Vec3 corner(0.3, -0.7, 0.2);
  for (const int n : {1, 4}) {
    const TriangleMesh mesh = transformed(box(size, n), Mat3::Identity(), corner + size / 2);
    for (const double height : {0.05, 0.1, 0.33}) { // 0.1 is a row of vertices of the finer box
      const Moments below = momentsBelow(mesh.vertices, mesh.faces, corner.z() + height);
      const double volume = size.x() * size.y() * height;
      const Vec3 centre = corner + 0.5 * Vec3(size.x(), size.y(), height);
      EXPECT_NEAR(below[0], volume, 1e-14);
      EXPECT_LT((below.segment<3>(1) - volume * centre).norm(), 1e-14);
      EXPECT_EQ(below.tail<6>(), (Eigen::Matrix<double, 6, 1>::Zero()));
    }
  }
}

TEST(MomentsBelow, OfALeaningTetrahedronAreItsOwnLessTheTip) {
  const Vec3 tip(0.9, -0.4, 2.0);
  const std::array<Vec3, 3> foot{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  const TriangleMesh whole = tetrahedron(foot[0], foot[1], foot[2], tip);
  const double s = 0.35; // of the height left above
  const auto cut = [&](std::size_t i) { return Vec3(tip + s * (foot[i] - tip)); };
  const TriangleMesh top = tetrahedron(cut(0), cut(1), cut(2), tip);
  const Moments expected = moments(whole.vertices, whole.faces) - moments(top.vertices, top.faces);
  const Moments below = momentsBelow(whole.vertices, whole.faces, (1 - s) * 2.0);
  EXPECT_LT((below - expected).head<4>().norm(), 1e-14);
}

TEST(MomentsBelow, AreThoseOfAllOrNothingBeyondTheEnds) {
  const TriangleMesh mesh = blob(4);
  const Moments all = momentsBelow(mesh.vertices, mesh.faces, 2.0);
  EXPECT_LT((all - moments(mesh.vertices, mesh.faces)).head<4>().norm(), 1e-13);
  EXPECT_EQ(momentsBelow(mesh.vertices, mesh.faces, -2.0), Moments::Zero());
}

TEST(MomentsBelow, ChangeAtTheRatesThatCentralDifferencesShow) {
  const TriangleMesh mesh = transformed(blob(3), someRotation(), {0.4, -0.2, 0.3});
  Random random(5);
  Points directions(mesh.vertices.rows(), 3);
  for (Eigen::Index i = 0; i < directions.rows(); ++i) {
    directions.row(i) = random.vector().transpose();
  }
  for (const double level : {0.0, 0.31, 5.0}) {
    const MomentsWithRates at = momentsBelowWithRates(mesh.vertices, mesh.faces, directions, level);
    EXPECT_EQ(at.moments, momentsBelow(mesh.vertices, mesh.faces, level));
    // Coordinates of order one: the step leaves 1e-10 of truncation and of rounding.
    const double h = 1e-5;
    for (Eigen::Index i = 0; i < directions.rows(); ++i) {
      Points plus = mesh.vertices;
      Points minus = mesh.vertices;
      plus.row(i) += h * directions.row(i);
      minus.row(i) -= h * directions.row(i);
      const Moments change =
          momentsBelow(plus, mesh.faces, level) - momentsBelow(minus, mesh.faces, level);
      EXPECT_LT((at.rates.row(i).transpose() - change.head<4>() / (2 * h)).norm(), 1e-8)
          << i << ", level " << level;
    }
  }
}

TEST(FilledMoments, AreOfTheShellAndWhatItHolds) {
  const TriangleMesh outer = transformed(box({2, 2, 2}, 2), Mat3::Identity(), {0, 0, 1});
  const TriangleMesh inner = transformed(box({1, 1, 1}, 2), Mat3::Identity(), {0.2, 0, 1});
  const auto states = filledMoments(moments(outer.vertices, outer.faces), inner.vertices,
                                    inner.faces, {{}, {3.0}, {3.0, 0.75}});
  ASSERT_EQ(states.size(), 3U);
  EXPECT_NEAR(states[0][0], 7.0, 1e-13);
  EXPECT_NEAR(states[1][0], 10.0, 1e-13);
  EXPECT_NEAR(states[2][0], 7.75, 1e-13); // a quarter of the cavity
  EXPECT_NEAR(states[0][3], 8.0 - 1.0, 1e-13);
  EXPECT_NEAR(states[2][1], -0.2 + 0.75 * 0.2, 1e-13);
  EXPECT_NEAR(states[2][3], 7.0 + 0.75 * 0.625, 1e-13);
}

} // namespace
} // namespace massprops::testing
