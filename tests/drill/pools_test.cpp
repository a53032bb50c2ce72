// What stands in a cavity, against closed forms and against water poured through cubes.
#include "core/drill/pools.h"

#include "core/mesh/signed_volume.h"
#include "core/query/point_in_mesh.h"

#include "large_test.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace massprops::testing {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

int nearestVertex(const TriangleMesh& mesh, const Vec3& p) {
  Eigen::Index nearest = 0;
  (mesh.vertices.rowwise() - p.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
  return static_cast<int>(nearest);
}

double total(const std::vector<Pool>& pools) {
  double volume = 0.0;
  for (const Pool& pool : pools) volume += pool.volume;
  return volume;
}

/// Cubes of a fine grid in a cavity: water falls and spreads from cube to cube, and leaves at the
/// outlets. What is left is what no way leads out from that never rises above it.
double volumeInCubes(const TriangleMesh& cavity, const std::vector<Outlet>& outlets, double edge) {
  const TriangleTree tree(cavity.vertices, cavity.faces);
  const PointInMesh inside(tree);
  const Vec3 low = tree.lower();
  const Eigen::Array3i size = ((tree.upper() - low) / edge).array().ceil().cast<int>();
  const auto index = [&](const Eigen::Array3i& c) {
    return static_cast<std::size_t>((c[2] * size[1] + c[1]) * size[0] + c[0]);
  };
  const auto cubes = static_cast<std::size_t>(size.prod());
  std::vector<char> isInside(cubes, 0);
  std::vector<double> needed(cubes, kInfinity); // greatest height on the lowest way out
  const auto middle = [&](const Eigen::Array3i& c) {
    return Vec3(low + edge * (c.cast<double>() + 0.5).matrix());
  };
  for (int z = 0; z < size[2]; ++z) {
    for (int y = 0; y < size[1]; ++y) {
      for (int x = 0; x < size[0]; ++x) {
        const Eigen::Array3i c(x, y, z);
        isInside[index(c)] = inside.contains(middle(c)) ? 1 : 0;
      }
    }
  }
  using Entry = std::pair<double, std::array<int, 3>>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto reach = [&](const Eigen::Array3i& c, double height) {
    if (isInside[index(c)] == 0 || needed[index(c)] <= height) return;
    needed[index(c)] = height;
    queue.push({height, {c[0], c[1], c[2]}});
  };
  for (const Outlet& outlet : outlets) {
    // The cube next to the outlet's vertex.
    const Vec3 p = cavity.vertices.row(outlet.vertex).transpose();
    Eigen::Array3i best = Eigen::Array3i::Zero();
    double least = kInfinity;
    const Eigen::Array3i at = ((p - low) / edge).array().floor().cast<int>();
    for (int i = 0; i < 125; ++i) {
      const Eigen::Array3i c = at + Eigen::Array3i(i % 5 - 2, i / 5 % 5 - 2, i / 25 - 2);
      if ((c < 0).any() || (c >= size).any() || isInside[index(c)] == 0) continue;
      const double distance = (middle(c) - p).norm();
      if (distance < least) {
        least = distance;
        best = c;
      }
    }
    reach(best, std::max(outlet.level, middle(best).z()));
  }
  while (!queue.empty()) {
    const auto [height, place] = queue.top();
    queue.pop();
    const Eigen::Array3i c(place[0], place[1], place[2]);
    if (needed[index(c)] < height) continue;
    for (int axis = 0; axis < 3; ++axis) {
      for (const int step : {-1, 1}) {
        Eigen::Array3i next = c;
        next[axis] += step;
        if (next[axis] < 0 || next[axis] >= size[axis]) continue;
        reach(next, std::max(height, middle(next).z()));
      }
    }
  }
  double volume = 0.0;
  for (int z = 0; z < size[2]; ++z) {
    for (int y = 0; y < size[1]; ++y) {
      for (int x = 0; x < size[0]; ++x) {
        const Eigen::Array3i c(x, y, z);
        if (isInside[index(c)] != 0 && middle(c).z() < needed[index(c)])
          volume += std::pow(edge, 3);
      }
    }
  }
  return volume;
}

TEST(StandingPools, FillACavityWithoutAnOutlet) {
  const TriangleMesh ball = ellipsoid({3, 2, 1}, 8);
  const std::vector<Pool> pools = standingPools(ball, someRotation() * Vec3::UnitZ(), {});
  ASSERT_EQ(pools.size(), 1U);
  EXPECT_EQ(pools[0].level, kInfinity);
  EXPECT_NEAR(pools[0].volume, signedVolume(ball.vertices, ball.faces), 1e-12);
}

TEST(StandingPools, StandInABoxUpToItsOutlet) {
  const TriangleMesh tank = box({2, 3, 4}, 5);
  const int corner = nearestVertex(tank, {-1, -1.5, -2});
  const std::vector<Pool> pools = standingPools(tank, Vec3::UnitZ(), {{corner, -1.3}});
  ASSERT_EQ(pools.size(), 1U);
  EXPECT_EQ(pools[0].level, -1.3);
  EXPECT_NEAR(pools[0].volume, 2 * 3 * 0.7, 1e-12);
  // At the very floor nothing stays.
  EXPECT_TRUE(standingPools(tank, Vec3::UnitZ(), {{corner, -2.0}}).empty());
}

TEST(StandingPools, AreOneBehindAStepAndTwoInTwoLegs) {
  // Two legs that a bar joins: an outlet at the foot of one leaves the other full to the bar.
  const TriangleMesh trousers =
      polycube({{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {2, 0, 1}, {2, 0, 0}}, 3);
  const double foot = trousers.vertices.col(2).minCoeff();
  const double left = trousers.vertices.col(0).minCoeff();
  const Outlet outlet{nearestVertex(trousers, {left, 0, foot}), foot};
  const std::vector<Pool> pools = standingPools(trousers, Vec3::UnitZ(), {outlet});
  ASSERT_EQ(pools.size(), 1U);
  EXPECT_NEAR(pools[0].volume, 1.0, 1e-12);
  EXPECT_NEAR(pools[0].level, foot + 1.0, 1e-12);
  // An outlet in the bar's ceiling leaves both legs and the bar as one pool.
  const Outlet high{nearestVertex(trousers, {left, 0, foot + 2}), foot + 2};
  const std::vector<Pool> full = standingPools(trousers, Vec3::UnitZ(), {high});
  ASSERT_EQ(full.size(), 1U);
  EXPECT_NEAR(full[0].volume, 5.0, 1e-12);
  // Upside down nothing stands in the legs, whose ends are the top.
  EXPECT_TRUE(standingPools(trousers, -Vec3::UnitZ(), {{high.vertex, -high.level}}).empty());
}

TEST(StandingPools, GoRoundWhatHangsFromTheCeiling) {
  // A room with a post that ends above the floor: one pool, less the post's part below its level.
  std::vector<std::array<int, 3>> cells;
  for (int x = 0; x < 3; ++x) {
    for (int y = 0; y < 3; ++y) {
      for (int z = 0; z < 3; ++z) {
        if (x != 1 || y != 1 || z == 0) cells.push_back({x, y, z});
      }
    }
  }
  const TriangleMesh room = polycube(cells, 2);
  const double floor = room.vertices.col(2).minCoeff();
  const Outlet outlet{nearestVertex(room, Vec3(room.vertices.col(0).minCoeff(), 0, floor)),
                      floor + 1.5};
  const std::vector<Pool> pools = standingPools(room, Vec3::UnitZ(), {outlet});
  ASSERT_EQ(pools.size(), 1U);
  EXPECT_NEAR(pools[0].volume, 9.0 + 8.0 * 0.5, 1e-12);
}

TEST(StandingPools, AgreeWithWaterInCubes) {
  LARGE_TEST();
  // Lumps with several basins, in poses of no symmetry.
  Random random(5);
  for (int trial = 0; trial < 4; ++trial) {
    const Vec3 a = random.vector();
    const Vec3 b = random.vector();
    const TriangleMesh lump = starShaped(
        [&](const Vec3& u) {
          return 1.0 + 0.25 * std::sin(6.0 * u.dot(a) + 1.0) + 0.25 * std::cos(7.0 * u.dot(b));
        },
        24);
    std::vector<Outlet> outlets;
    for (int i = 0; i < 1 + trial % 2; ++i) {
      const int v = nearestVertex(lump, random.vector());
      outlets.push_back({v, lump.vertices(v, 2) + 0.02});
    }
    constexpr double kEdge = 0.025;
    const double area = 4.0 * 3.14159 * 1.5; // about, of which cubes blur half an edge
    const double stands = total(standingPools(lump, Vec3::UnitZ(), outlets));
    EXPECT_GT(stands, 0.2) << trial;
    EXPECT_NEAR(stands, volumeInCubes(lump, outlets, kEdge), 0.1 * kEdge * area) << trial;
  }
}

} // namespace
} // namespace massprops::testing
