// Bounds on integrals over what may be hollow, against closed forms.
#include "core/optimum/positive_part_bound.h"

#include "core/base/angles.h"
#include "core/query/point_in_mesh.h"
#include "large_test.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <utility>

namespace massprops::testing {
namespace {

/// Of 1 along each side, its foot on the ground.
TriangleMesh standingCube() {
  return transformed(box({1, 1, 1}, 6), Mat3::Identity(), Vec3(0, 0, 0.5));
}

TEST(PositivePartBound, IsCloseAboveTheIntegral) {
  const TriangleMesh cube = standingCube();
  const TriangleTree surface(cube.vertices, cube.faces);
  const double wall = 0.1;
  // What may be hollow is the cube of 0.8; of 1 the integral is its volume, of z − 1/2 that of its
  // upper half: 0.8² 0.4²/2.
  Moments one = Moments::Zero();
  one[0] = 1.0;
  Moments upper = Moments::Zero();
  upper[0] = -0.5;
  upper[3] = 1.0;
  // x² − z² about the middle is positive where |x| > |z|: 0.8 · 4 ∫∫ (x² − z²) dz dx over a
  // quarter.
  Moments saddle = Moments::Zero();
  saddle[0] = -0.25;
  saddle[3] = 1.0;
  saddle[4] = 1.0;
  saddle[6] = -1.0;
  const double ofSaddle = 0.8 * 2.0 / 3.0 * std::pow(0.4, 4);
  for (const auto& [quadric, exact] :
       {std::pair(one, 0.512), std::pair(upper, 0.64 * 0.08), std::pair(saddle, ofSaddle)}) {
    const double bound = PositivePartBounds(surface, wall).of({{}, {quadric}}, 1.01 * exact);
    EXPECT_GE(bound, exact);
    EXPECT_LE(bound, 1.01 * exact);
  }
}

TEST(PositivePartBound, KnowsLayers) {
  const TriangleMesh cube = standingCube();
  const TriangleTree surface(cube.vertices, cube.faces);
  Moments one = Moments::Zero();
  one[0] = 1.0;
  // −2 up to a third of the height, then x, then 3 from 0.7 on: over the cube of 0.8.
  Moments x = Moments::Zero();
  x[1] = 1.0;
  const LayeredQuadric q{{1.0 / 3.0, 0.7}, {-2.0 * one, x, 3.0 * one}};
  const double exact = (0.7 - 1.0 / 3.0) * 0.8 * 0.08 + 3.0 * 0.64 * 0.2;
  const double bound = PositivePartBounds(surface, 0.1).of(q, 1.01 * exact);
  EXPECT_GE(bound, exact);
  EXPECT_LE(bound, 1.01 * exact);
}

/// With an edge along which the walls meet at the outside of a bend.
TriangleMesh bend(int n) {
  return polycube({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, n);
}

TEST(PositivePartBound, IsAboveTheVolumeWhateverTheEffort) {
  LARGE_TEST();
  struct Case {
    const char* name;
    TriangleMesh mesh;
    std::function<double(double)> volume; ///< of what may be hollow, by the wall
  };
  const auto ofCube = [](double w) { return std::pow(1.0 - 2.0 * w, 3); };
  // Its outline loses strips of the wall's width along the sides, which overlap in five corners;
  // around the sixth they leave out all but a quarter of a disc.
  const auto ofBend = [](double w) {
    return (3.0 - 8.0 * w + 5.0 * w * w - 0.25 * kPi * w * w) * (1.0 - 2.0 * w);
  };
  const Case cases[] = {
      {"cube of two triangles a side", transformed(box({1, 1, 1}, 1), someRotation()), ofCube},
      {"cube of small triangles", transformed(box({1, 1, 1}, 9), someRotation()), ofCube},
      {"bend of two triangles a side", transformed(bend(1), someRotation()), ofBend},
      {"bend of small triangles", transformed(bend(7), someRotation()), ofBend},
  };
  Moments one = Moments::Zero();
  one[0] = 1.0;
  for (const Case& c : cases) {
    const TriangleTree surface(c.mesh.vertices, c.mesh.faces);
    // Thinner and thicker than the first cubes, by far.
    for (const double wall : {0.003, 0.02, 0.2}) {
      const double exact = c.volume(wall);
      for (const std::size_t most : {1, 30000, 300000}) {
        const double bound = PositivePartBounds(surface, wall).of({{}, {one}}, 0.0, most);
        EXPECT_GE(bound, exact) << c.name << ", " << wall << ", " << most;
        if (most < 300000 || wall < 0.01) continue;
        EXPECT_LE(bound, 1.02 * exact) << c.name << ", " << wall;
      }
    }
  }
}

TEST(PositivePartBound, LeavesOutNoPlaceThatMayBeHollow) {
  constexpr double kWall = 0.01;
  constexpr double kRadius = 0.01;
  // r² − |x − c|² is positive in a ball, which is smaller than the first cubes by far.
  const double exact = 8.0 / 15.0 * kPi * std::pow(kRadius, 5);
  const TriangleMesh shapes[] = {box({1, 1, 1}, 1), box({1, 1, 1}, 9), bend(1), bend(7), blob(8)};
  Random random(5);
  for (const TriangleMesh& shape : shapes) {
    const TriangleMesh mesh = transformed(shape, someRotation());
    const TriangleTree surface(mesh.vertices, mesh.faces);
    const PointInMesh inside(surface);
    for (int trial = 0; trial < 800; ++trial) {
      const Vec3 middle = 0.5 * (surface.lower() + surface.upper());
      const Vec3 half = 0.5 * (surface.upper() - surface.lower());
      const Vec3 c = middle + half.cwiseProduct(random.vector());
      const double distance = std::sqrt(surface.nearest(c).squaredDistance);
      if (distance < kWall + kRadius || distance > 0.06 || !inside.contains(c)) continue;
      Moments q = Moments::Zero();
      q << kRadius * kRadius - c.squaredNorm(), 2.0 * c, -1.0, -1.0, -1.0, 0.0, 0.0, 0.0;
      for (const std::size_t most : {std::size_t{1}, std::size_t{5000}}) {
        EXPECT_GE(PositivePartBounds(surface, kWall).of({{}, {q}}, 0.0, most), exact)
            << c.transpose() << ", " << most;
      }
    }
  }
}

/// Of u·x − t, the sum over the middles of small cubes that keep the wall, less what half a cube
/// may be off.
double leastSum(const Vec3& u, double t, const TriangleTree& surface, double wall) {
  constexpr int kAlong = 40;
  const PointInMesh inside(surface);
  const Vec3 size = surface.upper() - surface.lower();
  const Vec3 step = size / kAlong;
  double sum = 0.0;
  for (int i = 0; i < kAlong * kAlong * kAlong; ++i) {
    const Vec3 place(i % kAlong, i / kAlong % kAlong, i / kAlong / kAlong);
    const Vec3 x = surface.lower() + step.cwiseProduct(place + Vec3::Constant(0.5));
    const double worth = u.dot(x) - t - 0.5 * u.cwiseAbs().dot(step);
    const double distance = std::sqrt(surface.nearest(x).squaredDistance);
    const bool isWhole = distance > wall + 0.5 * step.norm() && inside.contains(x);
    if (worth > 0.0 && isWhole) sum += worth * step.prod();
  }
  return sum;
}

TEST(PositivePartBounds, AreThoseOfEachAloneWhateverWasAskedBefore) {
  LARGE_TEST();
  const double wall = 0.03;
  for (const TriangleMesh& shape : {bend(3), blob(8)}) {
    const TriangleMesh mesh = transformed(shape, someRotation());
    const TriangleTree surface(mesh.vertices, mesh.faces);
    const Vec3 middle = 0.5 * (surface.lower() + surface.upper());
    PositivePartBounds many(surface, wall);
    Random random(11);
    for (int i = 0; i < 40; ++i) {
      const Vec3 u = random.vector().normalized();
      const double t = u.dot(middle) + 0.1 * random();
      Moments plane = Moments::Zero();
      plane.head<4>() << -t, u;
      const std::size_t most = i % 2 == 0 ? 3000 : 30000;
      const double bound = many.of({{}, {plane}}, 0.0, most);
      EXPECT_EQ(bound, PositivePartBounds(surface, wall).of({{}, {plane}}, 0.0, most)) << i;
      EXPECT_GE(bound, leastSum(u, t, surface, wall)) << i;
    }
  }
}

TEST(PositivePartBounds, ShareTheirCubesWithQuadricsAndLayers) {
  const TriangleMesh cube = standingCube();
  const TriangleTree surface(cube.vertices, cube.faces);
  Moments one = Moments::Zero();
  one[0] = 1.0;
  Moments saddle = Moments::Zero();
  saddle[0] = -0.25;
  saddle[3] = saddle[4] = 1.0;
  saddle[6] = -1.0;
  const LayeredQuadric all[] = {{{}, {saddle}}, {{0.4}, {one, -1.0 * one}}, {{}, {one}}};
  PositivePartBounds many(surface, 0.1);
  for (int round = 0; round < 2; ++round) {
    for (const LayeredQuadric& q : all) {
      EXPECT_EQ(many.of(q, 0.0, 20000), PositivePartBounds(surface, 0.1).of(q, 0.0, 20000));
    }
  }
}

} // namespace
} // namespace massprops::testing
