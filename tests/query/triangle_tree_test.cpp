// Rays and nearest points, and what is found far from the origin.
#include "core/query/triangle_tree.h"

#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <random>
#include <utility>
#include <vector>

namespace massprops::testing {
namespace {

constexpr double kAnywhere = std::numeric_limits<double>::infinity();

TEST(Chords, ThroughABallHaveTheLengthOfTheChord) {
  const TriangleMesh ball = sphere(12);
  const TriangleTree tree(ball.vertices, ball.faces);
  Points towards = -ball.vertices;
  // Through the centre: 2, up to the depth of the polyhedron's faces.
  const Vector diameters = chords(tree, ball.vertices, towards);
  EXPECT_NEAR(diameters.minCoeff(), 2.0, 0.01);
  EXPECT_NEAR(diameters.maxCoeff(), 2.0, 1e-12);
  EXPECT_TRUE((chords(tree, ball.vertices, ball.vertices).array() ==
               std::numeric_limits<double>::infinity())
                  .all()); // outwards nothing is hit
}

class NearestPoint : public ::testing::TestWithParam<std::pair<double, Vec3>> {};

TEST_P(NearestPoint, IsThatOfAllTriangles) {
  const auto [size, origin] = GetParam();
  const TriangleMesh mesh = transformed(blob(6), size * Mat3::Identity(), origin);
  const TriangleTree tree(mesh.vertices, mesh.faces);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-2.0, 2.0);
  for (int i = 0; i < 200; ++i) {
    const double far = i % 10 == 0 ? 1e6 : 1.0;
    const Vec3 p = origin + far * size * Vec3(place(random), place(random), place(random));
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
      least = std::min(least, tree.nearestOn(static_cast<int>(f), p).squaredDistance);
    }
    const TriangleTree::Hit hit = tree.nearest(p);
    ASSERT_GE(hit.face, 0);
    EXPECT_EQ(hit.squaredDistance, least);
    EXPECT_EQ(tree.nearest(p, least).face, -1) << "nothing is nearer";
    EXPECT_EQ(tree.nearest(p, least * (1.0 + 1e-14)).squaredDistance, least);
  }
}

// Boxes are floats, which are exhausted by squares of such lengths and by such origins.
INSTANTIATE_TEST_SUITE_P(
    Sizes, NearestPoint,
    ::testing::Values(std::pair(1.0, Vec3(0, 0, 0)), std::pair(1e25, Vec3(0, 0, 0)),
                      std::pair(1e-25, Vec3(0, 0, 0)), std::pair(1e-21, Vec3(0, 0, 0)),
                      std::pair(1.0, Vec3(1e5, -3e6, 0)), std::pair(1e-3, Vec3(0, 0, 1e5))));

/// The distance of a triangle, to a billionth, is the same whatever is known of where it was.
TEST_P(NearestPoint, OfATriangleIsThatOfAnyTriangleWhereverItComesFrom) {
  const double size = GetParam().first;
  const Vec3 origin = GetParam().second;
  const TriangleMesh mesh = transformed(blob(16), size * Mat3::Identity(), origin);
  const TriangleTree tree(mesh.vertices, mesh.faces);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(-1.0, 1.0);
  const auto within = [&](double length) -> Vec3 {
    return length * size * Vec3(place(random), place(random), place(random));
  };
  int nearer = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec3 middle = within(0.8);
    // Most ways lead about the same way, up or down.
    const Vec3 common = place(random) * (i % 3 == 0 ? 0.1 : 0.03) * middle;
    EarlierTriangle earlier;
    Vec3 now[3];
    for (int k = 0; k < 3; ++k) {
      earlier.corners[k] = origin + middle + within(0.01);
      now[k] = earlier.corners[k] + (i % 5 == k ? Vec3(0, 0, 0) : Vec3(common + within(0.001)));
    }
    const Vec3* const was = earlier.corners;
    const double before = tree.squaredDistance(was[0], was[1], was[2], kAnywhere);
    const double whole = tree.squaredDistance(now[0], now[1], now[2], kAnywhere);
    if (whole < before) ++nearer;
    for (const double share : {1.0, 0.9, 0.0}) {
      earlier.distance = share * std::sqrt(before);
      for (const double bound : {kAnywhere, 1.0 * before, 1.1 * before}) {
        const double expected = std::min(whole, bound);
        EXPECT_NEAR(tree.squaredDistance(now[0], now[1], now[2], bound, &earlier), expected,
                    1e-8 * expected);
      }
    }
  }
  EXPECT_GT(nearer, 20);
  EXPECT_LT(nearer, 180);
}

TEST(NearestPoint, IsNotFartherAwayThanTheSlackAllows) {
  const TriangleMesh ball = sphere(40);
  const TriangleTree tree(ball.vertices, ball.faces);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-0.5, 0.5);
  std::uniform_int_distribution<int> face(0, static_cast<int>(ball.faces.rows()) - 1);
  int farther = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 p(place(random), place(random), place(random));
    const double least = std::sqrt(tree.nearest(p).squaredDistance);
    const int hint = face(random);
    for (const double slack : {0.0, 0.002, 0.03}) {
      // Beyond 0.8 it may be 5 % whatever the slack.
      const TriangleTree::Hit hit = tree.nearest(p, kAnywhere, hint, 0.64, slack);
      const double found = std::sqrt(hit.squaredDistance);
      EXPECT_NEAR(found, (p - hit.point).norm(), 1e-12);
      EXPECT_GE(found, least - 1e-12);
      const double allowed = found > 0.8 ? TriangleTree::kSlack : 1.0 + slack;
      EXPECT_LE(found, allowed * least + 1e-12);
      if (found > least + 1e-12) ++farther;
    }
  }
  EXPECT_GT(farther, 100); // or it saves nothing
}

TEST(Clearance, IsThatOfTheSurfaceAndOfAllWithinARadiusOfWhatIsKeptOut) {
  const TriangleMesh ball = sphere(6);
  const TriangleMesh patch{ball.vertices, ball.faces.topRows(20)};
  const TriangleTree kept(patch.vertices, patch.faces);
  const TriangleTree plain(ball.vertices, ball.faces);
  TriangleTree tree(ball.vertices, ball.faces);
  const double radius = 0.4;
  tree.keepOut(kept, radius);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place(-1.2, 1.2);
  int keptOut = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 p(place(random), place(random), place(random));
    const double fromKept = std::sqrt(kept.nearest(p).squaredDistance) - radius;
    const double expected =
        std::min(std::sqrt(plain.nearest(p).squaredDistance), std::max(fromKept, 0.0));
    const TriangleTree::Hit hit = tree.clearance(p);
    EXPECT_NEAR(std::sqrt(hit.squaredDistance), expected, 1e-11);
    EXPECT_NEAR((p - hit.point).norm(), expected, 1e-11);
    EXPECT_EQ(tree.nearest(p).squaredDistance, plain.nearest(p).squaredDistance);
    if (fromKept <= 0.0) ++keptOut;

    const Vec3 q = p + 0.1 * Vec3(place(random), place(random), place(random));
    const Vec3 r = p + 0.1 * Vec3(place(random), place(random), place(random));
    constexpr double kFar = 100.0;
    const double whole = std::sqrt(tree.squaredClearance(p, q, r, kFar));
    const double ofKept = std::sqrt(kept.squaredDistance(p, q, r, kFar)) - radius;
    EXPECT_NEAR(whole,
                std::min(std::sqrt(plain.squaredDistance(p, q, r, kFar)), std::max(ofKept, 0.0)),
                1e-8);
  }
  EXPECT_GT(keptOut, 10);
  EXPECT_LT(keptOut, 200);
}

TEST(TriangleTree, HasAllTrianglesHoweverManyThereAre) {
  // From one leaf to several roots with levels below them.
  const TriangleMesh mesh = blob(8);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  for (const int count : {1,  2,  4,  5,   9,   13,  16,  17,  31,  33,  47,  60, 63,
                          64, 65, 70, 100, 130, 190, 250, 257, 300, 380, 450, 511}) {
    const Faces some = mesh.faces.topRows(count);
    const TriangleTree tree(mesh.vertices, some);
    std::vector<int> seen(static_cast<std::size_t>(count), 0);
    for (int i = 0; i < count; ++i) ++seen[static_cast<std::size_t>(tree.faceAt(i))];
    EXPECT_EQ(seen, std::vector<int>(static_cast<std::size_t>(count), 1)) << count;
    int visited = 0;
    tree.forOverlaps(tree.lower(), tree.upper(), 0, [&](Eigen::Index) { ++visited; });
    EXPECT_EQ(visited, count);
    for (int i = 0; i < 20; ++i) {
      const Vec3 p(place(random), place(random), place(random));
      double least = std::numeric_limits<double>::infinity();
      for (int f = 0; f < count; ++f) least = std::min(least, tree.nearestOn(f, p).squaredDistance);
      EXPECT_EQ(tree.nearest(p).squaredDistance, least) << count;
    }
  }
}

TEST(TriangleTree, OfManyTrianglesHasAllInNearlyFullLeaves) {
  const TriangleMesh mesh = sphere(190);
  std::mt19937 random(12);
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  for (const Eigen::Index count : {520000, 600000, 700000}) {
    ASSERT_LE(count, mesh.faces.rows());
    const Faces some = mesh.faces.topRows(count);
    const TriangleTree tree(mesh.vertices, some);
    std::vector<char> seen(static_cast<std::size_t>(count), 0);
    tree.forOverlaps(tree.lower(), tree.upper(), 0,
                     [&](Eigen::Index i) { ++seen[static_cast<std::size_t>(tree.faceAt(i))]; });
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1), count);
    for (int i = 0; i < 10; ++i) {
      const Vec3 p(place(random), place(random), place(random));
      double least = std::numeric_limits<double>::infinity();
      for (int f = 0; f < static_cast<int>(count); ++f)
        least = std::min(least, tree.nearestOn(f, p).squaredDistance);
      EXPECT_EQ(tree.nearest(p).squaredDistance, least);
    }
  }
}

/// How many triangles a search for those that meet each triangle's box looks at.
std::int64_t visits(const TriangleMesh& mesh, TriangleTree::Order order) {
  const TriangleTree tree(mesh.vertices, mesh.faces, order, TriangleTree::Queries::NoDistances);
  std::int64_t count = 0;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    Eigen::AlignedBox3d box;
    for (const int v : mesh.faces.row(f)) box.extend(Vec3(mesh.vertices.row(v).transpose()));
    tree.forOverlaps(box.min(), box.max(), 0, [&](Eigen::Index) { ++count; });
  }
  return count;
}

TEST(TriangleTree, LooksAtAsFewTrianglesFarFromTheOrigin) {
  // A float at 5 million steps by a half, as much as the whole body is wide.
  const TriangleMesh near = blob(10);
  const TriangleMesh far = transformed(near, Mat3::Identity(), {5e6, -5e6, 5e6});
  const std::int64_t few = visits(near, TriangleTree::Order::Any);
  const std::int64_t most = few + few / 20; // the coordinates were rounded
  EXPECT_LT(few, 60 * near.faces.rows());
  EXPECT_LE(visits(far, TriangleTree::Order::Any), most);
}

TEST(TriangleTree, FindsAllTrianglesThatMeetABoxFarFromTheOrigin) {
  const TriangleMesh far = transformed(blob(6), Mat3::Identity(), {5e6, 3.0, -1e7 / 3.0});
  const TriangleTree tree(far.vertices, far.faces);
  for (Eigen::Index f = 0; f < far.faces.rows(); ++f) {
    // The box of one corner is a point, whose triangles must be among those found.
    const Vec3 corner = far.vertices.row(far.faces(f, 0)).transpose();
    bool isFound = false;
    tree.forOverlaps(corner, corner, 0,
                     [&](Eigen::Index i) { isFound = isFound || tree.faceAt(i) == f; });
    EXPECT_TRUE(isFound) << f;
  }
  const Vec3 lowest = far.vertices.colwise().minCoeff().transpose();
  const Vec3 highest = far.vertices.colwise().maxCoeff().transpose();
  EXPECT_TRUE((tree.lower().array() <= lowest.array()).all());
  EXPECT_TRUE((tree.upper().array() >= highest.array()).all());
}

TEST(SpatialOrder, LooksAtNoVertexWithoutAFace) {
  // Else many components, each a part of all vertices, would take quadratic time.
  const TriangleMesh mesh = blob(5);
  TriangleMesh more = mesh;
  more.vertices.conservativeResize(mesh.vertices.rows() + 1, 3);
  more.vertices.bottomRows(1).setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(spatialOrder(more.vertices, more.faces), spatialOrder(mesh.vertices, mesh.faces));
}

} // namespace
} // namespace massprops::testing
