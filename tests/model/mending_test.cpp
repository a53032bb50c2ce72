// What no slicer minds is mended: each step alone, the way through them, and clean solids that were
// broken at random.
#include "core/model/mending.h"

#include "core/mesh/components.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/signed_volume.h"
#include "core/model/closed_holes.h"
#include "core/model/empty_shells.h"
#include "core/model/local_crossings.h"
#include "core/model/loose_sheets.h"
#include "core/model/manifold_split.h"
#include "core/model/seams.h"
#include "core/model/shell_orientation.h"
#include "core/model/solid.h"
#include "core/model/united_bodies.h"
#include "core/model/wrapping.h"
#include "core/pipeline.h"
#include "judge/checks.h"
#include "large_test.h"
#include "shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace massprops::testing {
namespace {

double volume(const TriangleMesh& mesh) {
  return signedVolume(mesh.vertices, mesh.faces);
}

double diagonal(const TriangleMesh& mesh) {
  return diagonalOf(mesh.vertices);
}

MendingTask taskFor(const TriangleMesh& mesh) {
  MendingTask task;
  task.wall = 0.01 * diagonal(mesh);
  return task;
}

TriangleMesh withoutFaces(const TriangleMesh& mesh, const std::function<bool(const Vec3&)>& goes) {
  TriangleMesh result = mesh;
  Eigen::Index kept = 0;
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    Vec3 middle = Vec3::Zero();
    for (const int v : mesh.faces.row(f)) middle += mesh.vertices.row(v).transpose() / 3.0;
    if (!goes(middle)) result.faces.row(kept++) = mesh.faces.row(f);
  }
  return submesh(mesh.vertices, result.faces.topRows(kept)).mesh;
}

/// Vertices at the same place are one, whatever that makes of the surface.
TriangleMesh withMergedPlaces(const TriangleMesh& mesh) {
  return mergedAndCompacted(unwelded(mesh)).mesh;
}

void expectClosed(const TriangleMesh& mesh) {
  EXPECT_TRUE(isClosedAndOriented(mesh));
  EXPECT_EQ(intersectingPairs(mesh), 0U);
}

// ---------------------------------------------------------------- the steps

TEST(JoinedSeams, MergesBordersThatLieApartByRounding) {
  const TriangleMesh body = blob(6);
  const TriangleMesh loose = jittered(unwelded(body), 2e-6 * diagonal(body), 3);
  const MendedMesh result = joinedSeams(loose, taskFor(body));
  EXPECT_TRUE(isClosedAndOriented(result.mesh));
  EXPECT_EQ(result.mesh.faces.rows(), body.faces.rows());
  EXPECT_NE(result.done.find("merged"), std::string::npos);
  EXPECT_NEAR(volume(result.mesh), volume(body), 1e-4 * volume(body));
}

TEST(JoinedSeams, ClosesTJunctions) {
  // The top is cut finer than the sides that it meets.
  const TriangleMesh coarse = box({2, 2, 2}, 1);
  const TriangleMesh fine = box({2, 2, 2}, 3);
  const auto isTop = [](const Vec3& p) { return p.z() > 0.999; };
  const TriangleMesh mixed = joined(withoutFaces(coarse, isTop),
                                    withoutFaces(fine, [&](const Vec3& p) { return !isTop(p); }));
  const TriangleMesh welded = mergedAndCompacted(mixed).mesh;
  ASSERT_GT(countEdges(welded.vertices.rows(), welded.faces).boundary, 0U);
  const MendedMesh result = joinedSeams(welded, taskFor(coarse));
  EXPECT_TRUE(isClosedAndOriented(result.mesh)) << result.done;
  EXPECT_NE(result.done.find("8 T-junctions closed"), std::string::npos) << result.done;
  EXPECT_NEAR(volume(result.mesh), 8.0, 1e-9);
}

TEST(JoinedSeams, LeavesAGoodSurfaceAlone) {
  const TriangleMesh body = blob(5);
  const MendedMesh result = joinedSeams(body, taskFor(body));
  EXPECT_TRUE(result.done.empty());
  EXPECT_EQ(result.mesh.faces, body.faces);
}

TEST(OrientedShells, TurnsFacesOverThatDisagree) {
  const TriangleMesh body = blob(5);
  TriangleMesh mixed = body;
  for (Eigen::Index f = 0; f < mixed.faces.rows(); f += 3) {
    std::swap(mixed.faces(f, 0), mixed.faces(f, 1));
  }
  const MendedMesh result = orientedShells(mixed, taskFor(body));
  EXPECT_TRUE(isClosedAndOriented(result.mesh));
  EXPECT_NEAR(volume(result.mesh), volume(body), 1e-12);
}

TEST(OrientedShells, TellsPatchesThatEndAtManyFacesWhereOutsideIs) {
  // Two cubes that share an edge, one inside out: each is a patch of its own.
  const TriangleMesh one = box({1, 1, 1});
  TriangleMesh mixed = withMergedPlaces(joined(one, reversed(shifted(one, {1, 1, 0}))));
  std::swap(mixed.faces(0, 0), mixed.faces(0, 1));
  const MendedMesh result = orientedShells(mixed, taskFor(mixed));
  EXPECT_NEAR(volume(result.mesh), 2.0, 1e-12);
}

TEST(SplitToManifold, PartsTwoCubesThatShareAnEdge) {
  const TriangleMesh one = box({1, 1, 1}, 2);
  const TriangleMesh touching = withMergedPlaces(joined(one, shifted(one, {1, 1, 0})));
  ASSERT_GT(countEdges(touching.vertices.rows(), touching.faces).nonManifold, 0U);
  const MendedMesh result = splitToManifold(touching, taskFor(touching));
  expectClosed(result.mesh);
  EXPECT_EQ(connectedComponents(result.mesh.vertices.rows(), result.mesh.faces).size(), 2U);
  EXPECT_NEAR(volume(result.mesh), 2.0, 1e-3);
  EXPECT_LE(result.distance, 1e-4 * diagonal(touching));
  EXPECT_NE(result.done.find("2 non-manifold edges"), std::string::npos) << result.done;
}

TEST(SplitToManifold, PartsAnEdgeWhoseEndsStayTogether) {
  // A square frame of four bars whose ends meet, and a bar on the inner edge of one of them: both
  // bodies touch along that edge only.
  const TriangleMesh ring = polycube({{0, 0, 0},
                                      {1, 0, 0},
                                      {2, 0, 0},
                                      {2, 1, 0},
                                      {2, 2, 0},
                                      {1, 2, 0},
                                      {1, 2, 1},
                                      {1, 1, 1},
                                      {0, 1, 1},
                                      {0, 0, 1}},
                                     1);
  const TriangleMesh touching = withMergedPlaces(ring);
  const EdgeCounts edges = countEdges(touching.vertices.rows(), touching.faces);
  const MendedMesh result = splitToManifold(touching, taskFor(touching));
  EXPECT_TRUE(isClosedAndOriented(result.mesh)) << edges.nonManifold;
  EXPECT_NEAR(volume(result.mesh), 10.0, 1e-2);
}

TEST(SplitToManifold, PartsTwoBodiesThatShareAVertex) {
  const TriangleMesh one = box({1, 1, 1});
  const TriangleMesh touching = withMergedPlaces(joined(one, shifted(one, {1, 1, 1})));
  const MendedMesh result = splitToManifold(touching, taskFor(touching));
  expectClosed(result.mesh);
  EXPECT_NEAR(volume(result.mesh), 2.0, 1e-3);
}

TEST(SplitToManifold, PartsBodiesThatMeetAtManyEdges) {
  // Every second cube of eight: each touches the other three along edges, and all in the middle.
  const TriangleMesh one = box({1, 1, 1});
  const TriangleMesh four =
      withMergedPlaces(joined(joined(one, shifted(one, {1, 1, 0})),
                              joined(shifted(one, {1, 0, 1}), shifted(one, {0, 1, 1}))));
  const MendedMesh result = splitToManifold(four, taskFor(four));
  expectClosed(result.mesh);
  EXPECT_EQ(connectedComponents(result.mesh.vertices.rows(), result.mesh.faces).size(), 4U);
  EXPECT_NEAR(volume(result.mesh), 4.0, 1e-3);
}

TEST(SplitToManifold, PartsAFaceThatLiesOnAnother) {
  // At the same angle but for rounding, whichever of the two it tells to be nearer.
  const TriangleMesh body = blob(4);
  TriangleMesh model = body;
  model.vertices.conservativeResize(body.vertices.rows() + 1, 3);
  model.faces.conservativeResize(body.faces.rows() + 1, 3);
  for (Eigen::Index f = 0; f < body.faces.rows(); ++f) {
    const auto corner = [&](int k) { return body.vertices.row(body.faces(f, k)); };
    for (const double share : {0.5, 0.7, 0.9, 1.1, 1.3}) {
      model.vertices.bottomRows(1) =
          corner(0) + share * (corner(2) - corner(0)) + 0.1 * (corner(1) - corner(0));
      model.faces.bottomRows(1) << body.faces(f, 0), body.faces(f, 1),
          static_cast<int>(body.vertices.rows());
      const TriangleMesh result = splitToManifold(model, taskFor(body)).mesh;
      EXPECT_EQ(countEdges(result.vertices.rows(), result.faces).nonManifold, 0U);
    }
  }
}

/// Two cubes with one wall between them.
TriangleMesh withAWall() {
  const TriangleMesh left = shifted(box({1, 1, 1}, 2), {-0.5, 0, 0});
  const TriangleMesh right = shifted(box({1, 1, 1}, 2), {0.5, 0, 0});
  const auto isWall = [](const Vec3& p) { return p.x() < 1e-9; };
  return withMergedPlaces(joined(left, withoutFaces(right, isWall)));
}

TEST(LooseSheets, AreLeftOutWithinABody) {
  const TriangleMesh model = withAWall();
  ASSERT_GT(countEdges(model.vertices.rows(), model.faces).nonManifold, 0U);
  const MendedMesh result = withoutLooseSheets(model, taskFor(model));
  EXPECT_TRUE(isClosedAndOriented(result.mesh));
  EXPECT_NEAR(volume(result.mesh), 2.0, 1e-12);
  EXPECT_EQ(result.done, "1 sheet that bound no material left out");
}

TEST(LooseSheets, AreLeftOutOutsideOfIt) {
  const TriangleMesh body = box({1, 1, 1}, 2);
  TriangleMesh fin{Points(3, 3), Faces(1, 3)};
  fin.vertices << 0.5, 0.5, 0.0, 0.5, 0.5, 0.5, 0.9, 0.9, 0.2;
  fin.faces << 0, 1, 2;
  const TriangleMesh model = withMergedPlaces(joined(body, fin));
  ASSERT_EQ(countEdges(model.vertices.rows(), model.faces).nonManifold, 1U);
  const MendedMesh result = withoutLooseSheets(model, taskFor(model));
  EXPECT_TRUE(isClosedAndOriented(result.mesh));
  EXPECT_NEAR(volume(result.mesh), 1.0, 1e-12);
}

TEST(LooseSheets, AreNoBodiesThatTouch) {
  const TriangleMesh one = box({1, 1, 1}, 2);
  const TriangleMesh touching = withMergedPlaces(joined(one, shifted(one, {1, 1, 0})));
  EXPECT_TRUE(withoutLooseSheets(touching, taskFor(touching)).done.empty());
}

TEST(ClosedHoles, FollowsTheSurfaceAroundASmallHole) {
  const TriangleMesh ball = sphere(16);
  const TriangleMesh open = withoutFaces(ball, [](const Vec3& p) { return p.x() > 0.96; });
  const MendedMesh result = closedHoles(open, taskFor(ball));
  expectClosed(result.mesh);
  EXPECT_EQ(result.done, "1 hole closed");
  // A flat lid would lose π h² (3 − h)/3 of 4π/3 with h = 0.04: 0.1 %.
  EXPECT_NEAR(volume(result.mesh), volume(ball), 3e-4 * volume(ball));
}

TEST(ClosedHoles, ClosesTheBaseOfAScanLevel) {
  const TriangleMesh scan = withoutFaces(sphere(12), [](const Vec3& p) { return p.z() < -0.8; });
  double lowest = 1.0;
  for (const int v : scan.faces.reshaped()) lowest = std::min(lowest, scan.vertices(v, 2));
  const TriangleMesh open = submesh(scan.vertices, scan.faces).mesh;
  const MendedMesh result = closedHoles(open, taskFor(open));
  expectClosed(result.mesh);
  EXPECT_GE(result.mesh.vertices.col(2).minCoeff(), lowest - 1e-9);
}

TEST(ClosedHoles, RefusesAVase) {
  const TriangleMesh vase = withoutFaces(sphere(12), [](const Vec3& p) { return p.z() > 0.6; });
  try {
    closedHoles(submesh(vase.vertices, vase.faces).mesh, taskFor(vase));
    ADD_FAILURE() << "closed";
  } catch (const InvalidInput& e) {
    EXPECT_NE(std::string(e.what()).find("open_surface"), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("1 opening is"), std::string::npos) << e.what();
  }
}

TEST(ClosedOpenings, CloseAVaseAsWell) {
  const TriangleMesh ball = sphere(10);
  const TriangleMesh vase = withoutFaces(ball, [](const Vec3& p) { return p.z() > 0.2; });
  const MendedMesh result = closedOpenings(vase, taskFor(vase));
  expectClosed(result.mesh);
  // Between the flat lid and the whole ball.
  EXPECT_GT(volume(result.mesh), 0.5 * volume(ball));
  EXPECT_LT(volume(result.mesh), 1.05 * volume(ball));
}

/// Two rods joined at one end by a bridge, pressed into each other over a part of their length.
TriangleMesh pressedFork() {
  const auto squeeze = [](const Vec3& p) {
    const double side = p.y() > 0.0 ? 1.0 : -1.0;
    return Vec3(p.x(), p.y() - 0.3 * side * std::max(0.0, p.x()), p.z() + 0.05 * side * p.x());
  };
  TriangleMesh fork = polycube({{0, 0, 0},
                                {1, 0, 0},
                                {2, 0, 0},
                                {3, 0, 0},
                                {0, 1, 0},
                                {0, 2, 0},
                                {1, 2, 0},
                                {2, 2, 0},
                                {3, 2, 0}},
                               2);
  for (Eigen::Index v = 0; v < fork.vertices.rows(); ++v) {
    const Vec3 p = fork.vertices.row(v).transpose() - Vec3(1.0, 1.5, 0.5);
    fork.vertices.row(v) = squeeze(p).transpose();
  }
  return fork;
}

TEST(LocalCrossings, ReplacesAFoldedPlace) {
  const TriangleMesh ball = sphere(12);
  TriangleMesh folded = ball;
  // A vertex pushed over its neighbour.
  const int v = ball.faces(40, 0);
  folded.vertices.row(v) += 1.9 * (ball.vertices.row(ball.faces(40, 1)) - ball.vertices.row(v));
  ASSERT_GT(intersectingPairs(folded), 0U);
  const MendedMesh result = withoutLocalCrossings(folded, taskFor(ball));
  expectClosed(result.mesh);
  EXPECT_NEAR(volume(result.mesh), volume(ball), 0.005 * volume(ball));
}

TEST(LocalCrossings, LeavesOverlappingBodiesToTheUnion) {
  const TriangleMesh two = joined(sphere(6), shifted(sphere(6), {1, 0.1, 0}));
  EXPECT_TRUE(withoutLocalCrossings(two, taskFor(two)).done.empty());
}

TEST(LocalCrossings, AreMendedPlaceByPlaceAfterAUnion) {
  // Overlaps, and has a vertex pushed over its neighbour where it does not.
  const TriangleMesh fork = pressedFork();
  TriangleMesh folded = subdivided(subdivided(fork));
  const std::size_t pressed = intersectingPairs(folded);
  Eigen::Index face = 0;
  while (folded.vertices(folded.faces(face, 0), 0) > -0.9 ||
         folded.vertices(folded.faces(face, 1), 0) > -0.9)
    ++face;
  const int v = folded.faces(face, 0);
  folded.vertices.row(v) +=
      1.9 * (folded.vertices.row(folded.faces(face, 1)) - folded.vertices.row(v)).eval();
  ASSERT_GT(intersectingPairs(folded), pressed);
  MendingTask task = taskFor(fork);
  task.wall = 0.04 * diagonal(fork);
  EXPECT_TRUE(withoutLocalCrossings(folded, task).done.empty());
  const MendedMesh result = withFewerCrossings(folded, task);
  EXPECT_TRUE(isClosedAndOriented(result.mesh));
  EXPECT_LE(intersectingPairs(result.mesh), pressed);
  EXPECT_GT(intersectingPairs(result.mesh), 0U);
  EXPECT_TRUE(task.wall.hides(result.distance));
}

TEST(EmptyShells, GoAndLeaveTheBodies) {
  TriangleMesh sheet = transformed(box({1, 1, 1}, 2), Vec3(1, 1, 0).asDiagonal(), {5, 0, 0});
  const TriangleMesh both = joined(blob(4), sheet);
  const MendedMesh result = withoutEmptyShells(both, taskFor(both));
  EXPECT_EQ(result.mesh.faces.rows(), blob(4).faces.rows());
  EXPECT_EQ(result.done, "1 component without volume left out");
}

/// Volume that two unit balls have together whose centres lie `d` apart.
double volumeOfTwoBalls(double d) {
  const double pi = std::acos(-1.0);
  return 8.0 / 3.0 * pi - pi * (4.0 + d) * (2.0 - d) * (2.0 - d) / 12.0;
}

TEST(EmptyShells, MayBeOpenWhereTheyAreLittle) {
  const TriangleMesh body = box({2, 2, 2}, 3);
  const TriangleMesh leaf =
      withoutFaces(box({0.3, 0.3, 0.3}), [](const Vec3& p) { return p.z() < 0.149; });
  const MendedMesh result =
      withoutEmptyShells(joined(body, shifted(leaf, {0, 0, 2})), taskFor(body));
  EXPECT_EQ(result.mesh.faces.rows(), body.faces.rows());
  const MendedMesh sheet = withoutEmptyShells(joined(body, scaled(leaf, 10.0)), taskFor(body));
  EXPECT_TRUE(sheet.done.empty());
}

TEST(EmptyShells, MayBeOpenScrapsOfAUnion) {
  const TriangleMesh body = box({2, 2, 2}, 3);
  // Thinner than what has a place of its own; open, but bulging.
  const TriangleMesh scrap = shifted(
      withoutFaces(scaled(box({1, 1, 1}), 1e-5), [](const Vec3& p) { return p.z() > 4e-6; }),
      {1, 1, 1});
  const MendedMesh result = withoutEmptyShells(joined(body, scrap), taskFor(body));
  EXPECT_EQ(result.mesh.faces.rows(), body.faces.rows());
  EXPECT_EQ(result.done, "1 component without volume left out");
}

TEST(UnitedBodies, HaveTheVolumeOfTheUnion) {
  const TriangleMesh two = joined(sphere(20), shifted(sphere(20), {1.0, 0.1, 0.2}));
  const MendedMesh result = unitedBodies(two, taskFor(two));
  expectClosed(result.mesh);
  const double expected = volumeOfTwoBalls(std::sqrt(1.05));
  EXPECT_NEAR(volume(result.mesh), expected, 0.005 * expected); // of the chords
  EXPECT_NE(result.done.find("crossing faces united"), std::string::npos);
}

TEST(UnitedBodies, KeepCavitiesAndLeaveOutWhatIsInTheMaterial) {
  const TriangleMesh two = joined(sphere(8), shifted(sphere(8), {1.0, 0.1, 0.2}));
  const TriangleMesh small = transformed(sphere(3), 0.1 * Mat3::Identity(), {-0.5, 0, 0});
  const double united = volume(unitedBodies(two, taskFor(two)).mesh);
  EXPECT_NEAR(volume(unitedBodies(joined(two, reversed(small)), taskFor(two)).mesh),
              united - volume(small), 1e-9);
  EXPECT_NEAR(volume(unitedBodies(joined(two, small), taskFor(two)).mesh), united, 1e-9);
}

TEST(UnitedBodies, MayCrossThemselves) {
  const TriangleMesh fork = pressedFork();
  ASSERT_GT(intersectingPairs(fork), 0U);
  const MendedMesh result = unitedBodies(fork, taskFor(fork));
  expectClosed(result.mesh);
  // What is counted twice, at cubes.
  double twice = 0.0;
  constexpr double kStep = 0.08;
  for (int i = 0; i < 37 * 20 * 20; ++i) {
    const Vec3 place(i / 400, i / 20 % 20, i % 20);
    const Vec3 x = Vec3(0.04, -0.76, -0.76) + kStep * place;
    twice += windingNumber(fork, x) > 1.5 ? kStep * kStep * kStep : 0.0;
  }
  EXPECT_GT(twice, 0.1);
  EXPECT_NEAR(volume(result.mesh), volume(fork) - twice, 0.1 * twice);
}

TEST(UnitedBodies, MayLieOnEachOther) {
  // Sides in one plane, cut differently.
  const TriangleMesh two = joined(box({2, 1, 1}, 3), shifted(box({2, 1, 1}, 2), {1, 0, 0}));
  const MendedMesh result = unitedBodies(two, taskFor(two));
  expectClosed(result.mesh);
  EXPECT_NEAR(volume(result.mesh), 3.0, 1e-9);
}

TEST(Wrapped, KeepsTheVolumeOfASoup) {
  LARGE_TEST();
  const TriangleMesh body = blob(12);
  TriangleMesh soup = unwelded(body);
  Eigen::Index kept = 0;
  for (Eigen::Index f = 0; f < soup.faces.rows(); ++f) {
    if (f % 29 != 0) soup.faces.row(kept++) = Eigen::RowVector3i(soup.faces.row(f));
  }
  soup.faces.conservativeResize(kept, 3);
  const MendedMesh result = wrapped(submesh(soup.vertices, soup.faces).mesh, taskFor(body));
  expectClosed(result.mesh);
  EXPECT_NEAR(volume(result.mesh), volume(body), 0.03 * volume(body));
  EXPECT_TRUE(taskFor(body).wall.hides(result.distance));
  EXPECT_EQ(result.warning, "");
  EXPECT_NE(result.done.find("wrapped, volume "), std::string::npos);
}

TEST(Wrapped, TakesFacesWithoutArea) {
  LARGE_TEST();
  TriangleMesh body = box({2, 2, 2}, 4);
  // Along an edge and across it, some of them where the wrap goes.
  const Eigen::Index faces = body.faces.rows();
  body.faces.conservativeResize(2 * faces, 3);
  for (Eigen::Index f = 0; f < faces; ++f)
    body.faces.row(faces + f) << body.faces(f, 0), body.faces(f, 1), body.faces(f, 0);
  const MendedMesh result = wrapped(body, taskFor(body));
  expectClosed(result.mesh);
  EXPECT_NEAR(volume(result.mesh), 8.0, 0.03 * 8.0);
}

TEST(Wrapped, TakesABallThatFollowsFromTheHoles) {
  LARGE_TEST();
  // One that a fine ball would get through.
  const TriangleMesh body = box({2, 2, 2}, 16);
  const TriangleMesh open = withoutFaces(body, [](const Vec3& p) {
    return p.z() > 0.999 && std::max(std::abs(p.x()), std::abs(p.y())) < 0.125;
  });
  const MendedMesh coarse = wrapped(open, taskFor(body));
  expectClosed(coarse.mesh);
  EXPECT_NEAR(volume(coarse.mesh), 8.0, 0.03 * 8.0);
  // Without a hole the ball is fine, and so is what comes of it.
  const MendedMesh fine = wrapped(body, taskFor(body));
  expectClosed(fine.mesh);
  EXPECT_GT(fine.mesh.faces.rows(), 4 * coarse.mesh.faces.rows());
}

TEST(Wrapped, SaysWhereTheModelIsAnother) {
  LARGE_TEST();
  // A slot that no ball gets into takes 9 % of the box.
  TriangleMesh slotted =
      joined(box({2, 2, 2}, 4), reversed(shifted(box({1.8, 0.4, 1.0}, 4), {0, 0, 0.2})));
  const MendedMesh result = wrapped(slotted, taskFor(slotted));
  EXPECT_NE(result.warning.find("volume changed by +"), std::string::npos) << result.done;
}

TEST(Wrapped, ClosesBodiesAmongSheetsThatEncloseNothing) {
  // Two sheets one above the other, of which lines through them tell nothing.
  const TriangleMesh sheet =
      withoutFaces(box({2, 2, 2}, 4), [](const Vec3& p) { return p.z() < 0.999; });
  TriangleMesh both = joined(shifted(sheet, {0, 0, 1}), shifted(sheet, {0, 0, 1.01}));
  both = joined(box({2, 2, 2}, 4), submesh(both.vertices, both.faces).mesh);
  const MendedMesh result = wrapped(both, taskFor(both));
  expectClosed(result.mesh);
  EXPECT_NEAR(volume(result.mesh), 8.0, 0.05 * 8.0);
  EXPECT_EQ(result.warning, "");
}

TEST(Wrapped, LeavesWhatEnclosesNothing) {
  const TriangleMesh sheet =
      withoutFaces(box({1, 1, 1}, 4), [](const Vec3& p) { return p.z() < 0.4; });
  EXPECT_TRUE(wrapped(submesh(sheet.vertices, sheet.faces).mesh, taskFor(sheet)).done.empty());
}

// ---------------------------------------------------------------- the way through them

TEST(Mending, DoesNothingToAGoodModel) {
  const TriangleMesh body = blob(6);
  const std::optional<Solid> result = mended(body, taskFor(body));
  ASSERT_TRUE(result);
  EXPECT_EQ(result->repairs().describe(), "none");
  EXPECT_EQ(result->vertices(), body.vertices);
  EXPECT_EQ(result->faces(), body.faces);
}

TEST(Mending, KeepsTheOpeningsOfAShell) {
  const TriangleMesh ball = sphere(8);
  TriangleMesh vase = withoutFaces(ball, [](const Vec3& p) { return p.z() > 0.6; });
  std::swap(vase.faces(5, 0), vase.faces(5, 1));
  MendingTask task = taskFor(vase);
  task.keepsOpenings = true;
  const std::optional<Solid> result = mended(vase, task);
  ASSERT_TRUE(result);
  EXPECT_EQ(result->repairs().mended, "1 face turned over");
  EXPECT_EQ(std::count(result->isLid().begin(), result->isLid().end(), 0), vase.faces.rows());
}

TEST(Mending, ClosesAnOpeningWhereNoShellCanBeMade) {
  LARGE_TEST();
  // A rod stands out of the bowl.
  const TriangleMesh ball = sphere(10);
  const TriangleMesh bowl = withoutFaces(ball, [](const Vec3& p) { return p.z() > 0.5; });
  const TriangleMesh rod = shifted(box({0.2, 0.2, 1.6}, 2), {0, 0, 0.4});
  const std::optional<Solid> result = mended(joined(bowl, rod), taskFor(ball));
  ASSERT_TRUE(result);
  EXPECT_NE(result->repairs().warning.find("opening"), std::string::npos);
  const TriangleMesh body{result->vertices(), result->faces()};
  EXPECT_EQ(intersectingPairs(body), 0U);
  EXPECT_EQ(connectedComponents(body.vertices.rows(), body.faces).size(), 1U);
  // As a bowl it would be refused.
  EXPECT_THROW(mended(bowl, taskFor(ball)), InvalidInput);
}

/// Stands as a hollow body only; a hole in its side.
TriangleMesh brokenPillar() {
  const TriangleMesh pillar = transformed(roundedBox({1, 1, 2}, 0.15, 6, 2), shear(0.45));
  const TriangleMesh open = withoutFaces(pillar, [&](const Vec3& p) {
    return p.x() > 0.3 && std::abs(p.y()) < 0.12 && p.z() > 0.0 && p.z() < 0.3;
  });
  return submesh(open.vertices, open.faces).mesh;
}

TEST(Mending, DeliversTheMendedSurfaceWithItsCavity) {
  LARGE_TEST();
  const TriangleMesh model = brokenPillar();
  const Result result = optimizeMassProperties(model, {});
  EXPECT_EQ(std::get<std::string>(result.report.at("repairs")), "1 hole closed");
  const double moved = std::get<double>(result.report.at("repair_distance"));
  EXPECT_GT(moved, 0.0);
  EXPECT_LT(moved, 0.1 * diagonal(model));
  ASSERT_TRUE(result.outer.has_value());
  ASSERT_GT(result.inner.faces.rows(), 0);
  expectClosed(*result.outer);
  expectClosed(result.inner);
  EXPECT_EQ(intersectingPairs(result.inner, *result.outer), 0U);
  EXPECT_TRUE(isInside(result.inner, *result.outer));
  EXPECT_GE(leastDistance(result.inner, *result.outer), 0.01 * diagonal(*result.outer));
}

TEST(Mending, IsSwitchedOffByItsOption) {
  Options options;
  options.mend = false;
  EXPECT_THROW(optimizeMassProperties(brokenPillar(), options), DefectiveSurface);
}

TEST(Mending, GivesTheSameBytesAgain) {
  LARGE_TEST();
  const TriangleMesh two = joined(blob(8), shifted(blob(7), {0.9, 0.3, 0.1}));
  const std::optional<Solid> one = mended(two, taskFor(two));
  const std::optional<Solid> other = mended(two, taskFor(two));
  ASSERT_TRUE(one && other);
  EXPECT_EQ(one->vertices(), other->vertices());
  EXPECT_EQ(one->faces(), other->faces());
}

TEST(Mending, IsTheSameForWallsThatAreAlike) {
  LARGE_TEST();
  const TriangleMesh two = joined(blob(8), shifted(blob(7), {0.9, 0.3, 0.1}));
  MendingTask task = taskFor(two);
  const std::optional<Solid> solid = mended(two, task);
  ASSERT_TRUE(solid);
  int alike = 0;
  for (const double share : {0.005, 0.02, 0.1}) {
    MendingTask other;
    other.wall = share * diagonal(two);
    if (!task.wall.isLike(share * diagonal(two))) continue;
    ++alike;
    const std::optional<Solid> again = mended(two, other);
    ASSERT_TRUE(again);
    EXPECT_EQ(again->vertices(), solid->vertices()) << share;
    EXPECT_EQ(again->faces(), solid->faces()) << share;
  }
  EXPECT_GT(alike, 0);
}

TEST(FeltWall, IsLikeThoseThatHideAndShowTheSame) {
  const FeltWall wall(1.0);
  EXPECT_TRUE(wall.isLike(1e9));
  EXPECT_TRUE(wall.hides(0.5));
  EXPECT_TRUE(wall.hides(1.0));
  EXPECT_FALSE(wall.hides(3.0));
  EXPECT_TRUE(wall.isLike(1.0));
  EXPECT_TRUE(wall.isLike(2.9));
  EXPECT_FALSE(wall.isLike(0.9));
  EXPECT_FALSE(wall.isLike(3.0));
  EXPECT_EQ(wall.exactly(), 1.0);
  EXPECT_TRUE(wall.isLike(1.0));
  EXPECT_FALSE(wall.isLike(1.1));
}

TEST(Mending, MakesTheSameSolidInHostsOfFloatsAndOfDoubles) {
  // Far away a float is too coarse for that.
  for (const double away : {0.0, 300.0}) {
    const TriangleMesh two =
        shifted(joined(blob(8), shifted(blob(7), {0.9, 0.3, 0.1})), {away, 0.0, 0.0});
    Options options;
    options.goal = GoalKind::Mass;
    const Result doubles = optimizeMassProperties(two, options);
    options.representable = [](const Points& points) {
      return Points(points.cast<float>().cast<double>());
    };
    TriangleMesh stored = two;
    stored.vertices = options.representable(two.vertices);
    const Result floats = optimizeMassProperties(stored, options);
    ASSERT_TRUE(doubles.outer && floats.outer);
    EXPECT_EQ(doubles.outer->vertices == floats.outer->vertices, away == 0.0);
    const auto saved = [](const Result& result) {
      return std::get<double>(result.report.at("mass_before")) -
             std::get<double>(result.report.at("mass_after"));
    };
    EXPECT_NEAR(saved(floats), saved(doubles), 0.02 * saved(doubles));
  }
}

// ---------------------------------------------------------------- broken at random

/// A clean solid and what was made of it.
struct Broken {
  std::string how;
  TriangleMesh clean, broken;
};

class Breaker {
public:
  explicit Breaker(std::uint32_t seed) : random_(seed) {
    for (int i = 0; i < 5; ++i) random_();
  }

  Broken make(int defect) {
    switch (defect) {
    case 0: {
      const TriangleMesh body = solid();
      return {"unwelded", body, jittered(unwelded(body), 2e-6 * diagonal(body), 7)};
    }
    case 1: {
      const TriangleMesh body = solid();
      TriangleMesh mixed = body;
      for (Eigen::Index f = 0; f < mixed.faces.rows(); ++f) {
        if (random_() > 0.6) std::swap(mixed.faces(f, 0), mixed.faces(f, 1));
      }
      return {"turned faces", body, mixed};
    }
    case 2: {
      const TriangleMesh body = solid();
      std::vector<Vec3> holes;
      for (int i = between(1, 4); i > 0; --i) holes.emplace_back(somewhereOn(body));
      const double radius = 0.05 * diagonal(body);
      const TriangleMesh open = withoutFaces(body, [&](const Vec3& p) {
        return std::any_of(holes.begin(), holes.end(),
                           [&](const Vec3& hole) { return (p - hole).norm() < radius; });
      });
      return {"holes", body, submesh(open.vertices, open.faces).mesh};
    }
    case 3: {
      const TriangleMesh body = solid();
      TriangleMesh folded = body;
      for (int i = between(1, 3); i > 0; --i) {
        const Eigen::Index f = between(0, static_cast<int>(body.faces.rows()) - 1);
        const Vec3 edge =
            (body.vertices.row(body.faces(f, 1)) - body.vertices.row(body.faces(f, 0))).transpose();
        folded.vertices.row(body.faces(f, 0)) += 1.9 * edge.transpose();
      }
      return {"folded vertices", body, folded};
    }
    case 4: {
      // A spike on an edge that two faces have already.
      const TriangleMesh body = solid();
      const Vec3 a = body.vertices.row(body.faces(0, 0)).transpose();
      const Vec3 b = body.vertices.row(body.faces(0, 1)).transpose();
      const Vec3 out =
          (b - a).cross(Vec3(body.vertices.row(body.faces(0, 2)).transpose()) - a).normalized();
      const Vec3 c = 0.5 * (a + b) + 0.1 * (b - a).norm() * out;
      const Vec3 d = c + 0.1 * (b - a).norm() * out + 0.05 * out.cross(b - a);
      TriangleMesh spike = tetrahedron(a, b, c, d);
      if (volume(spike) < 0.0) spike = reversed(spike);
      return {"spike on an edge", body, withMergedPlaces(joined(body, spike))};
    }
    case 5: {
      // Two lengths of one bar, which overlap.
      const Vec3 size(2.0, 0.4 + 0.4 * share(), 0.4 + 0.4 * share());
      const double cut = 0.6 * share();
      const auto bar = [&](double from, double to) {
        return shifted(box({to - from, size.y(), size.z()}, 3), {0.5 * (from + to), 0, 0});
      };
      const Mat3 turn = rotation(random_.vector().normalized(), 2.0 * share());
      return {"overlapping lengths of a bar", transformed(box(size, 3), turn),
              transformed(joined(bar(-1.0, cut), bar(cut - 0.5, 1.0)), turn)};
    }
    case 6: {
      // A part that sticks in the body, with another tessellation, and one that lies within.
      const TriangleMesh body = sphere(10);
      const TriangleMesh knob =
          transformed(sphere(3), 0.15 * Mat3::Identity(), 1.0 * random_.vector().normalized());
      const TriangleMesh within = transformed(sphere(3), 0.2 * Mat3::Identity());
      return {"parts in the body", body, joined(joined(body, knob), within)};
    }
    case 7: {
      const TriangleMesh body = solid();
      return {"T-junctions", body, withTJunctions(body)};
    }
    case 8: {
      // Faces twice, faces that use a corner twice, and faces without area.
      const TriangleMesh body = solid();
      TriangleMesh more = withTJunctions(body);
      const Eigen::Index rows = more.faces.rows();
      const int extra = between(5, 40);
      more.faces.conservativeResize(rows + 2 * extra, 3);
      for (int i = 0; i < extra; ++i) {
        const auto face = more.faces.row(between(0, static_cast<int>(rows) - 1)).eval();
        more.faces.row(rows + 2 * i) = face;
        more.faces.row(rows + 2 * i + 1) << face[0], face[1], face[0];
      }
      return {"faces twice and without area", body, more};
    }
    case 9: {
      // A part that touches the body in one vertex.
      const TriangleMesh body = solid();
      const Vec3 place = somewhereOn(body);
      TriangleMesh part = transformed(tetrahedron({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}),
                                      0.02 * diagonal(body) * Mat3::Identity());
      const Vec3 middle =
          0.5 *
          (body.vertices.colwise().maxCoeff() + body.vertices.colwise().minCoeff()).transpose();
      const Vec3 out = (place - middle).normalized();
      part =
          transformed(part, Eigen::Quaterniond::FromTwoVectors(Vec3(1, 1, 1), out).matrix(), place);
      return {"part on a vertex", body, withMergedPlaces(joined(body, part))};
    }
    case 10: {
      // What a scanner on a turntable does not see.
      TriangleMesh body = transformed(blob(12), rotation(random_.vector().normalized(), share()));
      const double low = body.vertices.col(2).minCoeff();
      const double ground = low + (0.05 + 0.1 * share()) * (body.vertices.col(2).maxCoeff() - low);
      body.vertices.col(2) = body.vertices.col(2).cwiseMax(ground);
      return {"open base", body,
              withoutFaces(body, [&](const Vec3& p) { return p.z() < ground + 1e-9; })};
    }
    case 11: {
      const TriangleMesh body = solid();
      TriangleMesh mixed = withTJunctions(body);
      const Vec3 hole = somewhereOn(body);
      const double radius = 0.04 * diagonal(body);
      mixed = withoutFaces(mixed, [&](const Vec3& p) { return (p - hole).norm() < radius; });
      for (Eigen::Index f = 0; f < mixed.faces.rows(); ++f) {
        if (random_() > 0.8) std::swap(mixed.faces(f, 0), mixed.faces(f, 1));
      }
      return {"several defects", body, jittered(unwelded(mixed), 1e-6 * diagonal(body), 9)};
    }
    default: {
      const TriangleMesh body = solid();
      TriangleMesh soup = unwelded(body);
      Eigen::Index kept = 0;
      for (Eigen::Index f = 0; f < soup.faces.rows(); ++f) {
        if (random_() > -0.94) soup.faces.row(kept++) = Eigen::RowVector3i(soup.faces.row(f));
      }
      soup.faces.conservativeResize(kept, 3);
      soup = jittered(submesh(soup.vertices, soup.faces).mesh, 5e-4 * diagonal(body), 11);
      return {"soup", body, soup};
    }
    }
  }

private:
  /// Some edges are cut in two on one side only.
  TriangleMesh withTJunctions(const TriangleMesh& mesh) {
    TriangleMesh result = mesh;
    const int cuts = between(3, 30);
    for (int i = 0; i < cuts; ++i) {
      const Eigen::Index f = between(0, static_cast<int>(mesh.faces.rows()) - 1);
      const Eigen::RowVector3i face = result.faces.row(f);
      const Eigen::Index v = result.vertices.rows();
      const Eigen::Index row = result.faces.rows();
      result.vertices.conservativeResize(v + 1, 3);
      result.vertices.row(v) = 0.5 * (result.vertices.row(face[0]) + result.vertices.row(face[1]));
      result.faces.row(f) << face[0], static_cast<int>(v), face[2];
      result.faces.conservativeResize(row + 1, 3);
      result.faces.row(row) << static_cast<int>(v), face[1], face[2];
    }
    return result;
  }
  double share() { return 0.5 * (1.0 + random_()); }
  int between(int low, int high) {
    return std::min(high, low + static_cast<int>(share() * (high - low + 1)));
  }
  Vec3 somewhereOn(const TriangleMesh& mesh) {
    return mesh.vertices.row(between(0, static_cast<int>(mesh.vertices.rows()) - 1)).transpose();
  }
  TriangleMesh solid() {
    const Mat3 turn = rotation(random_.vector().normalized(), 3.0 * share());
    switch (between(0, 5)) {
    case 0:
      return transformed(blob(10), turn);
    case 1:
      return transformed(roundedBox({1, 0.6 + share(), 1.5}, 0.2, 8, 3), turn);
    case 2:
      return transformed(torus(1.0, 0.4, 30, 16), turn);
    case 3:
      return transformed(capsule(0.4, 1.0 + share(), 24), turn);
    case 4:
      return transformed(ellipsoid({1.0, 0.8, 0.6}, 10), turn);
    default:
      return transformed(smoothed(figure(4), 1), turn);
    }
  }

  Random random_;
};

class BrokenAtRandom : public ::testing::TestWithParam<int> {};

TEST_P(BrokenAtRandom, IsMendedToTheSolidThatItWas) {
  // Of the kinds of damage three are small.
  if (GetParam() != 0 && GetParam() != 2 && GetParam() != 3) LARGE_TEST();
  // Bars of which the sides lie in one plane but for rounding, and soups, may have to be wrapped,
  // which takes seconds.
  constexpr int kBars = 5;
  constexpr int kSoup = 12;
  const int cases = GetParam() == kBars || GetParam() == kSoup ? 2 : 12;
  for (int number = 0; number < cases; ++number) {
    const auto seed = static_cast<std::uint32_t>(1000 * GetParam() + number);
    const Broken model = Breaker(seed).make(GetParam());
    SCOPED_TRACE(model.how + ", seed " + std::to_string(seed));
    const std::optional<Solid> solid = mended(model.broken, taskFor(model.clean));
    ASSERT_TRUE(solid);
    SCOPED_TRACE(solid->repairs().describe());
    EXPECT_NE(solid->repairs().describe(), "none");
    EXPECT_EQ(intersectingPairs({solid->vertices(), solid->faces()}), 0U);
    const Body clean = bodyOf(quadratureMoments(model.clean));
    const Body body = bodyOf(quadratureMoments({solid->vertices(), solid->faces()}));
    const bool isWrapped = solid->repairs().mended.find("wrapped") != std::string::npos;
    EXPECT_NEAR(body.mass, clean.mass, (isWrapped ? 0.03 : 0.01) * clean.mass);
    EXPECT_LE((body.centre - clean.centre).norm(), 0.005 * diagonal(model.clean));
  }
}

INSTANTIATE_TEST_SUITE_P(Mending, BrokenAtRandom, ::testing::Range(0, 13));

} // namespace
} // namespace massprops::testing
