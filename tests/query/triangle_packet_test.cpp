#include "core/query/triangle_packet.h"
#include "judge/checks.h"

#include <gtest/gtest.h>

#include <array>
#include <limits>
#include <random>

namespace massprops {
namespace {

using Corners = std::array<Vec3, 3>;

double squaredDistance(const Corners& s, const Corners& t) {
  const auto mesh = [](const Corners& corners) {
    TriangleMesh one{Points(3, 3), Faces(1, 3)};
    for (int k = 0; k < 3; ++k) one.vertices.row(k) = corners[static_cast<std::size_t>(k)];
    one.faces << 0, 1, 2;
    return one;
  };
  const double distance = testing::leastDistance(mesh(s), mesh(t));
  return distance * distance;
}

/// What coordinates lose as floats, as the tree allows for it.
float roundingOf(const std::vector<Corners>& all) {
  double largest = 0.0;
  for (const Corners& corners : all) {
    for (const Vec3& p : corners) largest = std::max(largest, p.cwiseAbs().maxCoeff());
  }
  return 8.0F * std::numeric_limits<float>::epsilon() * static_cast<float>(largest);
}

class FourTrianglesTest : public ::testing::TestWithParam<std::pair<double, Vec3>> {
protected:
  Vec3 place(double spread) {
    const auto [size, origin] = GetParam();
    return size * (origin + spread * Vec3(number_(random_), number_(random_), number_(random_)));
  }
  /// Every third one is a sliver.
  Corners triangle(int i) {
    const Vec3 middle = place(2.0);
    Corners corners;
    for (Vec3& p : corners) p = middle + place(0.3) - GetParam().first * GetParam().second;
    if (i % 3 == 0) corners[2] = 0.4 * corners[0] + 0.6 * corners[1] + 1e-5 * (corners[2] - middle);
    return corners;
  }

private:
  std::mt19937 random_{5};
  std::uniform_real_distribution<double> number_{-1.0, 1.0};
};

TEST_P(FourTrianglesTest, AreNeverNearerThanTheBound) {
  for (int round = 0; round < 300; ++round) {
    std::vector<Corners> all(4);
    TrianglePacket four;
    for (int i = 0; i < 4; ++i) {
      Corners& t = all[static_cast<std::size_t>(i)];
      t = triangle(i + round);
      four.set(i, t[0], t[1], t[2]);
    }
    const float rounding = roundingOf(all);
    const Corners query = triangle(round);
    const Vec3 p = place(round % 7 == 0 ? 1e6 : 2.0);
    const Lanes fromTriangle =
        QueryTriangle(query[0], query[1], query[2]).squaredDistances(four, rounding);
    const Lanes fromPoint = four.squaredDistances(p, rounding);
    for (int i = 0; i < 4; ++i) {
      const Corners& t = all[static_cast<std::size_t>(i)];
      EXPECT_LE(static_cast<double>(fromTriangle[i]), squaredDistance(query, t) * (1.0 + 1e-12));
      EXPECT_LE(static_cast<double>(fromPoint[i]), squaredDistance({p, p, p}, t) * (1.0 + 1e-12));
    }
  }
}

// Floats are exhausted by squares of such lengths and by such origins.
INSTANTIATE_TEST_SUITE_P(SizesAndPlaces, FourTrianglesTest,
                         ::testing::Values(std::pair<double, Vec3>{1.0, {0, 0, 0}},
                                           std::pair<double, Vec3>{1.0, {3e5, -2e5, 1e5}},
                                           std::pair<double, Vec3>{1e-9, {0, 0, 0}},
                                           std::pair<double, Vec3>{1e-21, {0, 0, 0}},
                                           std::pair<double, Vec3>{1e-22, {0, 0, 0}},
                                           std::pair<double, Vec3>{3e-23, {0, 0, 0}},
                                           std::pair<double, Vec3>{3e9, {20, 0, 30}},
                                           std::pair<double, Vec3>{1e18, {0, 0, 0}},
                                           std::pair<double, Vec3>{1e25, {0, 0, 0}}));

// Products are too large for floats while squares of the axes are not.
TEST(TrianglePacket, AreNotFarWhereTheyCrossHoweverLargeTheyAre) {
  const QueryTriangle query({-1e9, 1e9, -1e9}, {2e9, -2e9, -1e9}, {-1e9, 1e9, 2e9});
  TrianglePacket four;
  for (int i = 0; i < 4; ++i)
    four.set(i, {-2e18, 3e18, -1e18}, {1e20, -1.5e20, 0}, {-2e18, 3e18, 1e18});
  EXPECT_EQ(query.squaredDistances(four, 1e14F).maxCoeff(), 0.0F);
  for (int i = 0; i < 4; ++i)
    four.set(i, {2.7e19, -2.6e19, 0}, {-2.6e19, 2.7e19, 0}, {2.7e19, -2.6e19, 0.24});
  EXPECT_LE(four.squaredDistances(Vec3::Zero(), 0.0F).maxCoeff(), 5e35F);
}

TEST(TrianglePacket, TellNearlyTheDistanceAcrossTheirPlanes) {
  const Mat3 turn = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  TrianglePacket four;
  for (int i = 0; i < 4; ++i) {
    const double height = 0.1 * (i + 1);
    four.set(i, turn * Vec3(0, 0, height), turn * Vec3(1, 0, height), turn * Vec3(0, 1, height));
  }
  const Vec3 p = turn * Vec3(0.2, 0.2, 0);
  const QueryTriangle query(turn * Vec3(0.1, 0.1, 0), turn * Vec3(0.1, 0.6, 0),
                            turn * Vec3(0.6, 0.1, 0));
  const Lanes fromPoint = four.squaredDistances(p, 1e-6F);
  const Lanes fromTriangle = query.squaredDistances(four, 1e-6F);
  for (int i = 0; i < 4; ++i) {
    const double squared = 0.01 * (i + 1) * (i + 1);
    EXPECT_NEAR(static_cast<double>(fromPoint[i]), squared, 1e-3 * squared);
    EXPECT_NEAR(static_cast<double>(fromTriangle[i]), squared, 1e-3 * squared);
  }
}

} // namespace
} // namespace massprops
