// The largest ball within surfaces of which it is known.
#include "core/contour/inscribed_ball.h"
#include "core/query/point_in_mesh.h"
#include "shapes.h"
#include "thread_count.h"

#include <gtest/gtest.h>

#include <cmath>

namespace massprops::testing {
namespace {

constexpr double kApart = 0.01;
constexpr double kNearly = 0.995; // of the largest

const Mat3 kAskew = Eigen::AngleAxisd(0.6, Vec3(3, 1, 2).normalized()).toRotationMatrix();

/// Between `least` and `most`.
void expectRadius(const TriangleMesh& mesh, double least, double most) {
  const TriangleTree tree(mesh.vertices, mesh.faces);
  const InscribedBall ball = largestInscribedBall(tree, kApart);
  EXPECT_TRUE(PointInMesh(tree).contains(ball.centre));
  EXPECT_NEAR(std::sqrt(tree.nearest(ball.centre).squaredDistance), ball.radius, 1e-12);
  EXPECT_GE(ball.radius, kNearly * least);
  EXPECT_LE(ball.radius, most + 1e-9);
}

void expectRadius(const TriangleMesh& mesh, double radius) {
  expectRadius(mesh, radius, radius);
}

TEST(InscribedBall, IsThatOfBoxesBallsAndShells) {
  for (const double least : {0.4, 0.03, 0.001})
    expectRadius(transformed(box({1.0, 0.7, least}), kAskew), 0.5 * least);
  const TriangleMesh ball = sphere(24);
  const TriangleTree tree(ball.vertices, ball.faces);
  const double inner = std::sqrt(tree.nearest(Vec3::Zero()).squaredDistance); // of its facets
  expectRadius(ball, inner);
  const TriangleMesh shell = joined(ball, reversed(scaled(ball, 0.8)));
  expectRadius(shell, 0.1 * inner, 0.1);
}

TEST(InscribedBall, IsInTheOneThickPlaceOfALargeSheet) {
  // A 4,000th of the area, and hardly thicker than the sheet.
  constexpr double kSide = 6.0;
  constexpr double kCube = 0.055;
  const TriangleMesh cube = transformed(box({kCube, kCube, kCube}), kAskew);
  expectRadius(joined(box({kSide, kSide, 0.05}), shifted(cube, {4.0, 0.0, 0.0})), 0.5 * kCube);
}

TEST(InscribedBall, EndsWhereFacesCoincide) {
  const TriangleMesh cube = box({1, 1, 1}, 4);
  expectRadius(joined(cube, shifted(cube, {1.0, 0.0, 0.0})), 0.5);
}

TEST(InscribedBall, KeepsClearOfWhatIsKeptOut) {
  const TriangleMesh cube = box({1, 1, 1}, 4);
  const TriangleMesh side = box({2.0, 2.0, 1e-3});
  TriangleTree tree(cube.vertices, cube.faces);
  const double top = tree.upper().z();
  const TriangleMesh above =
      shifted(side, {0.0, 0.0, top + 0.01 - side.vertices.col(2).minCoeff()});
  const TriangleTree kept(above.vertices, above.faces);
  tree.keepOut(kept, 0.21); // 0.2 below the top
  const InscribedBall ball = largestInscribedBall(tree, kApart);
  EXPECT_GE(ball.radius, kNearly * 0.4);
  EXPECT_LE(ball.radius, 0.4 + 1e-9);
}

TEST(InscribedBall, IsTheSameOnAnyNumberOfThreads) {
  const TriangleMesh mesh = blob(16);
  const TriangleTree tree(mesh.vertices, mesh.faces);
  const auto on = [&](int threads) {
    const ThreadCount count(threads);
    return largestInscribedBall(tree, kApart);
  };
  const InscribedBall one = on(1);
  const InscribedBall three = on(3);
  EXPECT_EQ(one.centre, three.centre);
  EXPECT_EQ(one.radius, three.radius);
}

} // namespace
} // namespace massprops::testing
