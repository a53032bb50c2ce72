#include "core/query/triangle_packet.h"
#include "judge/checks.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
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

constexpr double kInfinity = std::numeric_limits<double>::infinity();

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
    const Lanes fromPoint = four.squaredDistances(p, rounding, kInfinity);
    for (int i = 0; i < 4; ++i) {
      const Corners& t = all[static_cast<std::size_t>(i)];
      EXPECT_LE(static_cast<double>(fromTriangle[i]), squaredDistance(query, t) * (1.0 + 1e-12));
      EXPECT_LE(static_cast<double>(fromPoint[i]), squaredDistance({p, p, p}, t) * (1.0 + 1e-12));
    }
  }
}

/// Boxes around one of four triangles each, and planes of any normal.
std::pair<BoxPacket, PlanePacket> boundsOf(const std::vector<Corners>& all, const Vec3& normal) {
  BoxPacket boxes;
  PlanePacket planes;
  planes.normal = normal.cast<float>();
  const auto below = [](double x) {
    return std::nextafter(static_cast<float>(x), -std::numeric_limits<float>::infinity());
  };
  for (int i = 0; i < 4; ++i) {
    const Corners& t = all[static_cast<std::size_t>(i)];
    const Vec3 low = t[0].cwiseMin(t[1]).cwiseMin(t[2]);
    const Vec3 high = t[0].cwiseMax(t[1]).cwiseMax(t[2]);
    for (int k = 0; k < 3; ++k) {
      boxes.lower[k][i] = below(low[k]);
      boxes.upper[k][i] = -below(-high[k]);
    }
    const Vec3 axis = planes.normal.cast<double>();
    const Vec3 at(axis.dot(t[0]), axis.dot(t[1]), axis.dot(t[2]));
    planes.above[i] = below(at.minCoeff());
    planes.below[i] = -below(-at.maxCoeff());
  }
  return {boxes, planes};
}

TEST_P(FourTrianglesTest, AreNeverNearerThanTheBoundOfTheirBoxes) {
  for (int round = 0; round < 300; ++round) {
    std::vector<Corners> all(4);
    for (int i = 0; i < 4; ++i) all[static_cast<std::size_t>(i)] = triangle(i + round);
    const Corners& first = all.front();
    // Along one of them, along an axis, and none.
    const Vec3 upright = (first[1] - first[0]).cross(first[2] - first[0]).normalized();
    const Vec3 normal = round % 3 == 0   ? upright
                        : round % 3 == 1 ? Vec3(Vec3::UnitY())
                                         : Vec3(Vec3::Zero());
    const auto [boxes, planes] = boundsOf(all, normal);
    const float rounding = roundingOf(all);
    const Corners query = triangle(round);
    const Vec3 p = place(round % 7 == 0 ? 1e6 : 2.0);
    const Lanes fromTriangle =
        QueryTriangle(query[0], query[1], query[2]).squaredDistances(boxes, rounding, &planes);
    const Lanes fromPoint = boxes.squaredDistances(p, rounding, &planes);
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
  EXPECT_LE(four.squaredDistances(Vec3::Zero(), 0.0F, kInfinity).maxCoeff(), 5e35F);
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
  const Lanes fromPoint = four.squaredDistances(p, 1e-6F, kInfinity);
  const Lanes fromTriangle = query.squaredDistances(four, 1e-6F);
  for (int i = 0; i < 4; ++i) {
    const double squared = 0.01 * (i + 1) * (i + 1);
    EXPECT_NEAR(static_cast<double>(fromPoint[i]), squared, 1e-3 * squared);
    EXPECT_NEAR(static_cast<double>(fromTriangle[i]), squared, 1e-3 * squared);
  }
}

TEST(TrianglePacket, TellNearlyTheDistanceBesideTheirEdges) {
  const Mat3 turn = Eigen::AngleAxisd(1.1, Vec3(-2, 1, 2).normalized()).toRotationMatrix();
  TrianglePacket four;
  for (int i = 0; i < 4; ++i) {
    const double away = 0.1 * (i + 1);
    four.set(i, turn * Vec3(away, -1, 0.3), turn * Vec3(away, 1, 0.3), turn * Vec3(2, 0, 0.3));
  }
  const Lanes found = four.squaredDistances(Vec3::Zero(), 1e-6F, kInfinity);
  for (int i = 0; i < 4; ++i) {
    const double squared = 0.01 * (i + 1) * (i + 1) + 0.09;
    EXPECT_NEAR(static_cast<double>(found[i]), squared, 1e-3 * squared);
  }
}

// The boxes of slanted triangles reach nearly to the point, and so do the planes of those beside.
TEST(BoxPacket, TellsHowFarPiecesOfASlantedPlaneAre) {
  const Mat3 turn = Eigen::AngleAxisd(0.9, Vec3(1, 1, 1).normalized()).toRotationMatrix();
  std::vector<Corners> all;
  for (int i = 0; i < 4; ++i) {
    all.push_back({Vec3(2.0 * i, -0.5, 1), Vec3(2.0 * i + 1, -0.5, 1), Vec3(2.0 * i, 0.5, 1)});
    for (Vec3& p : all.back()) p = (turn * p).eval();
  }
  const Vec3 normal = turn * Vec3::UnitZ();
  const auto [boxes, planes] = boundsOf(all, normal);
  const Lanes found = boxes.squaredDistances(Vec3::Zero(), roundingOf(all), &planes);
  EXPECT_GT(found[0], 0.999F);
  for (int i = 1; i < 4; ++i) {
    const double reached = 2.0 * i - 1.0;
    EXPECT_GT(static_cast<double>(found[i]), 1.0 + reached * reached);
    EXPECT_LE(static_cast<double>(found[i]), 1.0 + 4.0 * i * i);
  }
}

TEST(QueryTriangle, TellsHowFarTrianglesBesideItsSidesAre) {
  const Mat3 turn = Eigen::AngleAxisd(0.4, Vec3(2, -1, 1).normalized()).toRotationMatrix();
  const QueryTriangle query(turn * Vec3(0, 0, 0), turn * Vec3(2, 0, 0), turn * Vec3(1, 1, 0));
  for (const double side : {-1.0, 1.0}) {
    const Vec3 outwards = Vec3(side, 1, 0).normalized();
    const Vec3 along(outwards.y(), -outwards.x(), 0);
    TrianglePacket four;
    for (int i = 0; i < 4; ++i) {
      const Vec3 near = Vec3(1.0 + 0.5 * side, 0.5, 0.3) + 0.1 * (i + 1) * outwards;
      four.set(i, turn * (near + 0.3 * along), turn * (near - 0.3 * along),
               turn * (near + outwards));
    }
    const Lanes found = query.squaredDistances(four, 1e-6F);
    for (int i = 0; i < 4; ++i) {
      const double squared = 0.01 * (i + 1) * (i + 1) + 0.09;
      EXPECT_NEAR(static_cast<double>(found[i]), squared, 1e-3 * squared);
    }
  }
}

// The nearest corner is beside the other pieces, the boxes of which reach farther up than they do.
TEST(QueryTriangle, TellsHowFarPiecesOfASlantedPlaneAreBelowIt) {
  const Mat3 turn = Eigen::AngleAxisd(0.9, Vec3(1, 1, 1).normalized()).toRotationMatrix();
  const Corners query{turn * Vec3(0, 0, 1), turn * Vec3(4, -1, 1.4), turn * Vec3(4, 1, 1.4)};
  std::vector<Corners> all;
  for (int i = 0; i < 4; ++i) {
    all.push_back({Vec3(i, -0.2, 0), Vec3(i + 0.4, -0.2, 0), Vec3(i, 0.2, 0)});
    for (Vec3& p : all.back()) p = (turn * p).eval();
  }
  const auto [boxes, planes] = boundsOf(all, turn * Vec3::UnitZ());
  const Lanes found =
      QueryTriangle(query[0], query[1], query[2]).squaredDistances(boxes, roundingOf(all), &planes);
  for (int i = 0; i < 4; ++i) {
    const double height = (1.0 + 0.1 * i) / std::sqrt(1.01);
    EXPECT_GT(static_cast<double>(found[i]), std::pow(height - 0.03, 2));
    EXPECT_LE(static_cast<double>(found[i]),
              squaredDistance(query, all[static_cast<std::size_t>(i)]));
  }
}

} // namespace
} // namespace massprops
