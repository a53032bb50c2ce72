// Graphs, distances, exact checks and the parts of the cavity, on shapes where the answer is known.
#include "core/mesh/degenerate_faces.h"
#include "core/mesh/lipschitz.h"
#include "core/mesh/vertex_adjacency.h"
#include "core/query/point_in_mesh.h"
#include "core/query/self_intersection.h"
#include "core/query/surface_distance.h"
#include "core/reduced/cavity.h"
#include "core/reduced/offset_field.h"
#include "core/reduced/skeleton.h"

#include "core/model/frame.h"

#include "judge/checks.h"
#include "shapes.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>
#include <utility>
#include <vector>

namespace massprops::testing {
namespace {

VertexAdjacency neighboursOf(const TriangleMesh& mesh) {
  return vertexAdjacency(mesh.vertices.rows(), mesh.faces);
}

// ---------------------------------------------------------------- graph

TEST(VertexNeighbours, AreSymmetricAscendingAndSixOnARegularMesh) {
  const VertexAdjacency neighbours = neighboursOf(sphere(4));
  int five = 0;
  for (std::size_t v = 0; v < neighbours.size(); ++v) {
    EXPECT_TRUE(std::is_sorted(neighbours[v].begin(), neighbours[v].end()));
    five += neighbours[v].size() == 5 ? 1 : 0;
    for (const int w : neighbours[v]) {
      const auto& back = neighbours[static_cast<std::size_t>(w)];
      EXPECT_TRUE(std::binary_search(back.begin(), back.end(), static_cast<int>(v)));
    }
  }
  EXPECT_EQ(five, 12); // the corners of the icosahedron
}

TEST(Lipschitz, FunctionsAreTheTightestOnesThatKeepTheSlope) {
  const TriangleMesh mesh = blob(6);
  const VertexAdjacency neighbours = neighboursOf(mesh);
  const Vector values = Random(51).vector(mesh.vertices.rows());
  const double slope = 0.8;
  const Vector below = lipschitzBelow(mesh.vertices, neighbours, values, slope);
  const Vector above = lipschitzAbove(mesh.vertices, neighbours, values, slope);
  EXPECT_LE((below - values).maxCoeff(), 0.0);
  EXPECT_GE((above - values).minCoeff(), 0.0);
  for (std::size_t v = 0; v < neighbours.size(); ++v) {
    const auto i = static_cast<Eigen::Index>(v);
    // Tight: no vertex can be raised without breaking its own value or the slope to a neighbour.
    double highest = values[i];
    for (const int w : neighbours[v]) {
      const double length = (mesh.vertices.row(i) - mesh.vertices.row(w)).norm();
      EXPECT_LE(std::abs(below[i] - below[w]), slope * length + 1e-14);
      EXPECT_LE(std::abs(above[i] - above[w]), slope * length + 1e-14);
      highest = std::min(highest, below[w] + slope * length);
    }
    EXPECT_NEAR(below[i], highest, 1e-14);
  }
}

// ---------------------------------------------------------------- distances

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
      least = std::min(least, tree.squaredDistance(p, static_cast<int>(f)));
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

TEST(SurfaceDistances, OfConcentricBoxesAreTheirGap) {
  const TriangleMesh outer = box({1.2, 1.4, 1.6}, 2);
  const TriangleMesh inner = box({1, 1, 1}, 3);
  const Vector distances =
      surfaceDistances(inner.vertices, inner.faces, outer.vertices, outer.faces, 0.5);
  EXPECT_NEAR(distances.minCoeff(), 0.1, 1e-12);
}

TEST(SurfaceDistances, SeeCrossingEdgesWhoseEndsAreFar) {
  const double quarter = std::acos(-1.0) / 4;
  const TriangleMesh barX = transformed(box({4, 1, 1}, 1), rotation(Vec3::UnitX(), quarter));
  const TriangleMesh barY =
      transformed(transformed(box({1, 4, 1}, 1), rotation(Vec3::UnitY(), quarter)),
                  Mat3::Identity(), {0, 0, 2});
  const Vector distances =
      surfaceDistances(barX.vertices, barX.faces, barY.vertices, barY.faces, 1.0);
  EXPECT_NEAR(distances.minCoeff(), 2 - std::sqrt(2.0), 1e-12);
}

TEST(SurfaceDistances, HaveTheLeastDistanceOfAnyTwoTriangles) {
  const TriangleMesh outer = blob(6);
  const TriangleMesh inner = transformed(blob(5), 0.8 * Mat3::Identity(), {0.03, 0.02, -0.05});
  const Vector distances =
      surfaceDistances(inner.vertices, inner.faces, outer.vertices, outer.faces, 0.5);
  EXPECT_NEAR(distances.minCoeff(), leastDistance(inner, outer), 1e-12);
}

class RememberedClearance : public ::testing::TestWithParam<double> {};

TEST_P(RememberedClearance, IsThatOfAMeasurementWithoutMemory) {
  const TriangleMesh other = blob(12);
  const TriangleTree tree(other.vertices, other.faces);
  TriangleMesh moving = transformed(blob(5), GetParam() * Mat3::Identity(), {0.01, 0.02, -0.01});
  const double horizon =
      1.4 * clearanceOf(moving.vertices, moving.faces, tree, 1.0).distance.minCoeff();
  ClearanceMemory memory;
  std::size_t below = 0;
  // Some vertices move a little, some more, most rest; faces go, and one comes.
  for (int round = 0; round < 12; ++round) {
    const Clearance seen = clearanceOf(moving.vertices, moving.faces, tree, horizon, &memory);
    const Clearance fresh = clearanceOf(moving.vertices, moving.faces, tree, horizon);
    EXPECT_NEAR(seen.least, fresh.least, 1e-14);
    for (Eigen::Index v = 0; v < moving.vertices.rows(); ++v) {
      if (fresh.distance[v] >= horizon) {
        EXPECT_GE(seen.distance[v], horizon * (1.0 - 1e-12));
      } else {
        EXPECT_NEAR(seen.distance[v], fresh.distance[v], 1e-14);
        ++below;
      }
    }
    for (Eigen::Index v = round; v < moving.vertices.rows(); v += 5) {
      moving.vertices.row(v) *= 1.0 + (v % 2 == 0 ? 1e-4 : 0.02) * std::sin(static_cast<double>(v));
    }
    moving.faces.conservativeResize(moving.faces.rows() - 3, 3);
    moving.faces.row(7 * round) = moving.faces.row(7 * round).reverse().eval();
  }
  EXPECT_GT(below, 60U);
}

// Inside of the other surface corners are nearest, around it the insides of faces.
INSTANTIATE_TEST_SUITE_P(Geometry, RememberedClearance, ::testing::Values(0.8, 1.3));

// ---------------------------------------------------------------- exact checks

TEST(SelfIntersectingFaces, AgreeWithTheCheckPairByPair) {
  EXPECT_TRUE(selfIntersectingFaces(blob(6).vertices, blob(6).faces).empty());
  TriangleMesh pierced = sphere(5);
  pierced.vertices.row(0) *= -1.5;
  EXPECT_FALSE(selfIntersectingFaces(pierced.vertices, pierced.faces).empty());
  EXPECT_GT(intersectingPairs(pierced), 0U);
}

TEST(Clearance, NamesTheFacesThatMeetTheOtherSurface) {
  const TriangleMesh outer = sphere(6);
  const TriangleMesh inside = scaled(outer, 0.5);
  const TriangleTree tree(outer.vertices, outer.faces);
  EXPECT_TRUE(clearanceOf(inside.vertices, inside.faces, tree, 0.1).crossing.empty());
  const TriangleMesh across = transformed(inside, Mat3::Identity(), {0.7, 0, 0});
  const std::vector<int> crossing = clearanceOf(across.vertices, across.faces, tree, 0.1).crossing;
  ASSERT_FALSE(crossing.empty());
  // Each of them has corners near the outer sphere, within an edge length.
  for (const int f : crossing) {
    const double radius = across.vertices.row(across.faces(f, 0)).norm();
    EXPECT_NEAR(radius, 1.0, 0.15);
  }
}

TEST(SelfIntersectingFaces, AreFoundBesideFacesWithoutArea) {
  // A face's edge is broken at its middle, with a flat face in between; then two bodies overlap.
  TriangleMesh mesh = box({1, 1, 1}, 2);
  const Eigen::RowVector3i old = mesh.faces.row(0);
  const int middle = static_cast<int>(mesh.vertices.rows());
  mesh.vertices.conservativeResize(middle + 1, 3);
  mesh.vertices.row(middle) = 0.5 * (mesh.vertices.row(old[0]) + mesh.vertices.row(old[1]));
  const Eigen::Index count = mesh.faces.rows();
  mesh.faces.conservativeResize(count + 2, 3);
  mesh.faces.row(0) << old[0], middle, old[2];
  mesh.faces.row(count) << middle, old[1], old[2];
  mesh.faces.row(count + 1) << old[0], old[1], middle;
  EXPECT_EQ(facesWithoutArea(mesh), 1U);
  const std::size_t atTheFlatFace = selfIntersectingFaces(mesh.vertices, mesh.faces).size();
  const TriangleMesh two = joined(mesh, transformed(mesh, Mat3::Identity(), {0.5, 0.1, 0.2}));
  EXPECT_GT(selfIntersectingFaces(two.vertices, two.faces).size(), 2 * atTheFlatFace + 8);
}

std::vector<bool> insideOf(const Points& points, const TriangleMesh& mesh) {
  const TriangleTree tree(mesh.vertices, mesh.faces);
  std::vector<bool> inside;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    inside.push_back(massprops::isInside(Vec3(points.row(i).transpose()), tree));
  }
  return inside;
}

TEST(InsideOf, SeparatesTheInsideOfARing) {
  const TriangleMesh ring = torus(2, 0.5, 24, 12);
  Points points(4, 3);
  points << 2, 0, 0, 0, 0, 0, -2, 0.1, 0.2, 9, 0, 0;
  EXPECT_EQ(insideOf(points, ring), (std::vector<bool>{true, false, true, false}));
}

TEST(InsideOf, AgreesWithTheWindingNumberBehindEdgesAndCorners) {
  // On this grid every way along an axis meets edges or corners.
  const TriangleMesh steps = polycube({{0, 0, 0}, {1, 0, 0}, {1, 0, 1}}, 2);
  const Vec3 low = steps.vertices.colwise().minCoeff();
  const Vec3 high = steps.vertices.colwise().maxCoeff();
  Points points(11 * 11 * 11, 3);
  for (int i = 0; i < points.rows(); ++i) {
    const Vec3 share = Vec3(i % 11, i / 11 % 11, i / 121) / 8.0 - Vec3::Constant(1.0 / 8.0);
    points.row(i) = (low + share.cwiseProduct(high - low)).transpose();
  }
  const std::vector<bool> inside = insideOf(points, steps);
  const TriangleTree tree(steps.vertices, steps.faces);
  int count = 0;
  for (int i = 0; i < points.rows(); ++i) {
    const Vec3 p = points.row(i).transpose();
    const bool isOnSurface = tree.nearest(p).squaredDistance == 0.0;
    const bool expected = !isOnSurface && windingNumber(steps, p) > 0.5;
    EXPECT_EQ(inside[static_cast<std::size_t>(i)], expected) << p.transpose();
    EXPECT_TRUE(isOnSurface || massprops::isInside(p, tree.nearest(p), tree) == expected);
    count += expected ? 1 : 0;
  }
  EXPECT_GT(count, 100);
}

TEST(InsideOf, ComesToAnEndInASheetOfAlmostNoThickness) {
  TriangleMesh sheet = sphere(3);
  sheet.vertices.col(1) *= 1e-30;
  Points points(2, 3);
  points << 0.1, 0, 0.2, 0.1, 1e-25, 0.2;
  EXPECT_EQ(insideOf(points, sheet), (std::vector<bool>{true, false}));
}

// ---------------------------------------------------------------- cavity surface

TEST(CavitySurface, IsTheWholeSurfaceWhereNothingIsSolid) {
  const TriangleMesh mesh = blob(5);
  const std::vector<char> none(static_cast<std::size_t>(mesh.vertices.rows()), 0);
  const CavitySurface cavity = cavitySurface(mesh.vertices, mesh.faces, none);
  EXPECT_EQ(cavity.faces, mesh.faces);
  EXPECT_EQ(cavity.solid, none);
}

TEST(CavitySurface, IsEmptyWhereEverythingIsSolid) {
  const TriangleMesh mesh = blob(5);
  const std::vector<char> all(static_cast<std::size_t>(mesh.vertices.rows()), 1);
  EXPECT_EQ(cavitySurface(mesh.vertices, mesh.faces, all).faces.rows(), 0);
}

/// What is left of the vertices that the faces use, as a mesh.
TriangleMesh used(const Points& vertices, const Faces& faces) {
  std::vector<int> index(static_cast<std::size_t>(vertices.rows()), -1);
  std::vector<int> kept;
  TriangleMesh mesh;
  mesh.faces = faces;
  for (Eigen::Index i = 0; i < mesh.faces.size(); ++i) {
    int& v = mesh.faces.data()[i];
    int& at = index[static_cast<std::size_t>(v)];
    if (at < 0) {
      at = static_cast<int>(kept.size());
      kept.push_back(v);
    }
    v = at;
  }
  mesh.vertices.resize(static_cast<Eigen::Index>(kept.size()), 3);
  for (std::size_t i = 0; i < kept.size(); ++i)
    mesh.vertices.row(static_cast<Eigen::Index>(i)) = vertices.row(kept[i]);
  return mesh;
}

TEST(CavitySurface, IsClosedByCapsWhereTheSolidPartsBegin) {
  // Solid at random, at one end, and in a belt that cuts the cavity in two.
  const TriangleMesh mesh = ellipsoid({1, 1, 3}, 10);
  for (int kind = 0; kind < 3; ++kind) {
    std::vector<char> solid(static_cast<std::size_t>(mesh.vertices.rows()), 0);
    Random random(61);
    for (std::size_t v = 0; v < solid.size(); ++v) {
      const double z = mesh.vertices(static_cast<Eigen::Index>(v), 2);
      const bool marked = kind == 0 ? random() > 0.9 : kind == 1 ? z > 1.5 : std::abs(z) < 0.5;
      solid[v] = marked ? 1 : 0;
    }
    const CavitySurface cavity = cavitySurface(mesh.vertices, mesh.faces, solid);
    ASSERT_GT(cavity.faces.rows(), 0) << kind;
    const TriangleMesh surface = used(mesh.vertices, cavity.faces);
    EXPECT_TRUE(isClosedAndOriented(surface)) << kind;
    EXPECT_GT(quadratureMoments(surface)[0], 0.0) << kind;
    for (std::size_t v = 0; v < solid.size(); ++v) {
      EXPECT_GE(cavity.solid[v], solid[v]); // solid stays solid
    }
    for (Eigen::Index i = 0; i < cavity.faces.size(); ++i) {
      EXPECT_EQ(cavity.solid[static_cast<std::size_t>(cavity.faces.data()[i])], 0);
    }
    if (kind == 2) {
      EXPECT_EQ(eulerCharacteristic(surface), 4); // two spheres
    }
  }
}

// ---------------------------------------------------------------- skeleton and directions

TriangleMesh working(const TriangleMesh& mesh) {
  const double size =
      (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).norm();
  TriangleMesh result = scaled(mesh, 1 / size);
  result.vertices = snapped(result.vertices);
  return result;
}

TEST(MeanCurvatureSkeleton, OfACapsuleIsItsAxis) {
  const TriangleMesh mesh = working(capsule(0.5, 4, 24));
  const Points skeleton = meanCurvatureSkeleton(mesh.vertices, mesh.faces).points;
  ASSERT_EQ(skeleton.rows(), mesh.vertices.rows());
  EXPECT_TRUE(skeleton.allFinite());
  const double radius = 0.5 / 4.97; // of the diagonal
  EXPECT_LT(skeleton.leftCols(2).rowwise().norm().maxCoeff(), 0.25 * radius);
  // A point of the side belongs to the point of the axis at about its own height.
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    if (std::abs(mesh.vertices(v, 2)) < 0.3) {
      EXPECT_NEAR(skeleton(v, 2), mesh.vertices(v, 2), radius);
    }
  }
}

TEST(MeanCurvatureSkeleton, IsTheSameBitForBitTheSecondTime) {
  const TriangleMesh mesh = working(figure(2));
  const Points first = meanCurvatureSkeleton(mesh.vertices, mesh.faces).points;
  std::vector<std::unique_ptr<char[]>> blocks;
  for (int i = 0; i < 20000; ++i)
    if (i % 3 != 0)
      blocks.push_back(std::make_unique<char[]>(static_cast<std::size_t>(24 + i % 97)));
  EXPECT_EQ(meanCurvatureSkeleton(mesh.vertices, mesh.faces).points, first);
}

TEST(OffsetField, LeadsInwardsFromAllFacesAndEndsWithinTheBody) {
  const TriangleMesh mesh = working(figure(3));
  const SparseMatrix L = cotanLaplacian(mesh.vertices, mesh.faces);
  const Vector mass = vertexLumpedMass(mesh.vertices, mesh.faces);
  const Points skeleton = meanCurvatureSkeleton(mesh.vertices, mesh.faces).points;
  const OffsetField field = offsetField(mesh.vertices, mesh.faces, skeleton, L, mass, 0.02);
  EXPECT_LT((field.directions.rowwise().norm().array() - 1.0).abs().maxCoeff(), 1e-12);
  EXPECT_GT(field.reach.minCoeff(), 0.0);

  // The clearance is what it says.
  Vector clearance = Vector::Ones(mesh.vertices.rows());
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    const Vec3 a = mesh.vertices.row(mesh.faces(f, 0)).transpose();
    const Vec3 b = mesh.vertices.row(mesh.faces(f, 1)).transpose();
    const Vec3 c = mesh.vertices.row(mesh.faces(f, 2)).transpose();
    const Vec3 normal = (b - a).cross(c - a).normalized();
    for (int k = 0; k < 3; ++k) {
      const int v = mesh.faces(f, k);
      clearance[v] = std::min(clearance[v], normal.dot(field.directions.row(v).transpose()));
    }
  }
  EXPECT_LT((clearance - field.clearance).cwiseAbs().maxCoeff(), 1e-12);

  // All ends of the offsets lie inside of the body where there is a way inwards.
  int outside = 0;
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    if (field.clearance[v] <= 0.0) continue;
    const Vec3 end =
        (mesh.vertices.row(v) - 0.9 * field.reach[v] * field.directions.row(v)).transpose();
    if (windingNumber(mesh, end) < 0.5) ++outside;
  }
  EXPECT_EQ(outside, 0);
}

TEST(OffsetField, OfABallPointsAwayFromItsCentre) {
  const TriangleMesh mesh = working(sphere(8));
  const SparseMatrix L = cotanLaplacian(mesh.vertices, mesh.faces);
  const Vector mass = vertexLumpedMass(mesh.vertices, mesh.faces);
  const Points centre = Points::Zero(mesh.vertices.rows(), 3);
  const OffsetField field = offsetField(mesh.vertices, mesh.faces, centre, L, mass, 0.02);
  const double radius = mesh.vertices.row(0).norm();
  EXPECT_LT((field.directions - mesh.vertices / radius).rowwise().norm().maxCoeff(), 1e-7);
  // Half of the chord through a polyhedron is up to 1 % short of the radius here.
  EXPECT_NEAR(field.reach.maxCoeff(), radius, 1e-7);
  EXPECT_GT(field.reach.minCoeff(), 0.98 * radius);
}

} // namespace
} // namespace massprops::testing
