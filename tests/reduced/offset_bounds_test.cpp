// Whatever the coefficients, every offset stays between its bounds, and the bounds keep the wall.
#include "core/reduced/offset_bounds.h"

#include "core/mesh/decimation.h"
#include "core/reduced/harmonics.h"
#include "reduced/working_scale.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace massprops::testing {
namespace {

OffsetBounds randomBounds(int n, std::uint32_t seed) {
  Random random(seed);
  OffsetBounds bounds;
  bounds.lower = (random.vector(n).array() + 1.0) * 0.05;
  bounds.upper = bounds.lower.array() + (random.vector(n).array() + 1.001) * 0.1;
  return bounds;
}

TEST(BoundMap, StaysBetweenTheBoundsForEveryArgument) {
  const OffsetBounds bounds = randomBounds(500, 1);
  Random random(2);
  for (const double magnitude : {1e-3, 0.1, 1.0, 1e3, 1e12}) {
    const Vector t = magnitude * random.vector(500);
    const BoundedOffsets mapped = boundMap(bounds, t);
    // Saturated, the value is the bound itself up to its last bit.
    EXPECT_GE((mapped.offsets - bounds.lower).minCoeff(), -1e-16) << magnitude;
    EXPECT_GE((bounds.upper - mapped.offsets).minCoeff(), -1e-16) << magnitude;
    EXPECT_TRUE((mapped.slopes.array() >= 0.0).all());
    EXPECT_TRUE((mapped.slopes.array() <= 1.0).all());
  }
}

TEST(BoundMap, StaysBetweenTheBoundsForRandomCoefficients) {
  const TriangleMesh mesh = blob(8);
  const SparseMatrix L = cotanLaplacian(mesh.vertices, mesh.faces);
  Vector mass = vertexLumpedMass(mesh.vertices, mesh.faces);
  mass /= mass.sum();
  const HarmonicBasis basis = harmonicBasis(mesh.vertices, mesh.faces, L, mass, 36);
  const OffsetBounds bounds = randomBounds(static_cast<int>(mesh.vertices.rows()), 3);
  Random random(4);
  for (int trial = 0; trial < 20; ++trial) {
    const Vector alpha = std::pow(10.0, trial % 5 - 2) * random.vector(36);
    const BoundedOffsets mapped = boundMap(bounds, basis.functions * alpha);
    EXPECT_TRUE((mapped.offsets.array() >= bounds.lower.array()).all());
    EXPECT_TRUE((mapped.offsets.array() <= bounds.upper.array()).all());
  }
}

TEST(BoundMap, ReachesBothBoundsInTheLimit) {
  const OffsetBounds bounds = randomBounds(50, 5);
  const Vector far = Vector::Constant(50, 1e6);
  // u − φ ~ w³/(16 t²): far below rounding.
  EXPECT_LT((boundMap(bounds, far).offsets - bounds.upper).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_LT((boundMap(bounds, -far).offsets - bounds.lower).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(BoundMap, IsTheIdentityToFirstOrderInTheMiddle) {
  const OffsetBounds bounds = randomBounds(50, 6);
  const Vector middle = 0.5 * (bounds.lower + bounds.upper);
  const BoundedOffsets mapped = boundMap(bounds, middle);
  EXPECT_LT((mapped.offsets - middle).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_LT((mapped.slopes.array() - 1.0).abs().maxCoeff(), 1e-12);
}

TEST(BoundMap, HasTheSlopesOfItsValues) {
  const OffsetBounds bounds = randomBounds(200, 7);
  const Vector width = bounds.upper - bounds.lower;
  Random random(8);
  const Vector t =
      0.5 * (bounds.lower + bounds.upper) + 2.0 * width.cwiseProduct(random.vector(200));
  // A step of 1e-5 widths: truncation 1e-10, rounding 1e-16·0.2/1e-5/width.
  const Vector h = 1e-5 * width;
  const Vector difference =
      (boundMap(bounds, t + h).offsets - boundMap(bounds, t - h).offsets).cwiseQuotient(2 * h);
  EXPECT_LT((boundMap(bounds, t).slopes - difference).cwiseAbs().maxCoeff(), 1e-7);
}

TEST(BoundMap, IsStrictlyIncreasing) {
  const OffsetBounds one{Vector::Constant(101, 0.1), Vector::Constant(101, 0.3)};
  const Vector t = Vector::LinSpaced(101, -1.0, 1.0);
  const Vector offsets = boundMap(one, t).offsets;
  for (Eigen::Index i = 1; i < 101; ++i) EXPECT_GT(offsets[i], offsets[i - 1]);
}

TEST(BoundMap, DoesNotDependOnTheUnit) {
  const OffsetBounds mm = randomBounds(100, 9);
  const Vector t = Random(10).vector(100);
  const OffsetBounds inch{mm.lower / 25.4, mm.upper / 25.4};
  const Vector same = boundMap(inch, t / 25.4).offsets * 25.4;
  EXPECT_LT((same - boundMap(mm, t).offsets).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(BoundMap, HoldsWhatHasNoRoom) {
  const OffsetBounds fixed{Vector::Constant(3, 0.2), Vector::Constant(3, 0.2)};
  const BoundedOffsets mapped = boundMap(fixed, Vector::LinSpaced(3, -5, 5));
  EXPECT_EQ(mapped.offsets, fixed.lower);
  EXPECT_EQ(mapped.slopes, Vector::Zero(3));
}

/// Directions that lean away from the normals of a blob, with their true clearance.
OffsetField leaningField(const TriangleMesh& mesh) {
  OffsetField field;
  const Eigen::Index n = mesh.vertices.rows();
  field.directions.resize(n, 3);
  field.reach = Vector::Constant(n, 0.4);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vec3 x = mesh.vertices.row(i).transpose();
    field.directions.row(i) = (x - Vec3(0.2, 0.1, -0.1)).normalized().transpose();
  }
  field.clearance = clearances(mesh, field.directions);
  return field;
}

TEST(InnerBounds, KeepTheWallPerpendicularToEveryFace) {
  const TriangleMesh mesh = blob(8);
  const OffsetField field = leaningField(mesh);
  const double wall = 0.03;
  const OffsetBounds bounds = innerBounds(field, wall, 0.9);
  // At the lower bound every corner of an inner face is at least a wall below the outer one's
  // plane.
  double least = std::numeric_limits<double>::infinity();
  double plain = std::numeric_limits<double>::infinity();
  for (Eigen::Index f = 0; f < mesh.faces.rows(); ++f) {
    const Vec3 a = mesh.vertices.row(mesh.faces(f, 0)).transpose();
    const Vec3 b = mesh.vertices.row(mesh.faces(f, 1)).transpose();
    const Vec3 c = mesh.vertices.row(mesh.faces(f, 2)).transpose();
    const Vec3 normal = (b - a).cross(c - a).normalized();
    for (int k = 0; k < 3; ++k) {
      const int v = mesh.faces(f, k);
      const double clearance = normal.dot(field.directions.row(v).transpose());
      least = std::min(least, bounds.lower[v] * clearance);
      plain = std::min(plain, wall * clearance);
    }
  }
  EXPECT_GE(least, wall);
  EXPECT_LT(plain, 0.95 * wall); // the wall as the bound itself would be too little here
}

TEST(InnerBounds, EndAtTheFactorTimesTheReach) {
  const OffsetField field = leaningField(blob(4));
  EXPECT_LT((innerBounds(field, 0.01, 0.7).upper - 0.7 * field.reach).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(InnerBoundsOfACopy, KeepTheWallFromTheSurfaceAndLittleMore) {
  const TriangleMesh fine = sphere(60);
  const TriangleMesh copy = decimated(fine.vertices, fine.faces, {400, 400, 0.0}).mesh;
  // Directions away from a point beside the middle: slanted against the surface.
  const Points axis = Points::Zero(400, 3).rowwise() + Eigen::RowVector3d(0.5, 0.3, 0.0);
  const OffsetField field = offsetField(copy.vertices, copy.faces, axis);
  const TriangleTree surface(fine.vertices, fine.faces);
  const double wall = 0.05;
  const OffsetBounds bounds =
      keepingWall(copy.vertices, surface, field, innerBoundsOfCopy(field, wall, 1.0), wall);
  const OffsetBounds strict =
      keepingWall(copy.vertices, surface, field, innerBounds(field, wall, 1.0), wall);
  const auto depths = [&](const OffsetBounds& b) {
    // Of a ball of radius 1, whose facets are deeper by less than 3e-4.
    const Points inner = copy.vertices - b.lower.asDiagonal() * field.directions;
    return Vector(1.0 - inner.rowwise().norm().array());
  };
  EXPECT_GE(depths(bounds).minCoeff(), wall);
  EXPECT_LT(depths(bounds).mean(), 1.05 * wall);
  EXPECT_GT(depths(strict).mean(), 1.07 * wall);
}

TEST(TooThin, IsWhatHasNoRoomOrNoDirection) {
  OffsetField field;
  field.directions = Points::Zero(4, 3);
  field.reach = Vector::Constant(4, 0.1);
  field.clearance = Vector::Ones(4);
  field.reach[1] = 0.01;     // thinner than the wall
  field.clearance[2] = -0.2; // no direction leads inwards
  const std::vector<char> thin = tooThin(field, innerBounds(field, 0.02, 0.9));
  EXPECT_EQ(thin, (std::vector<char>{0, 1, 1, 0}));
}

TEST(OuterBounds, KeepTheModelAboveTheGroundAndOnItsFeet) {
  const TriangleMesh mesh = scaled(figure(3), 0.1);
  OffsetField field;
  const Eigen::Index n = mesh.vertices.rows();
  field.directions.resize(n, 3);
  Random random(12);
  for (Eigen::Index i = 0; i < n; ++i)
    field.directions.row(i) = random.vector().normalized().transpose();
  field.reach = Vector::Ones(n);
  field.clearance = Vector::Ones(n);
  const OffsetBounds bounds = outerBounds(mesh.vertices, field, 0.01, 0.1);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double height = mesh.vertices(i, 2) + bounds.upper[i] * field.directions(i, 2);
    EXPECT_GE(height, 0.5 * mesh.vertices(i, 2) - 1e-15); // joins no ground contact
    if (mesh.vertices(i, 2) == 0.0) {
      EXPECT_EQ(bounds.upper[i], 0.0);
    }
    EXPECT_LE(bounds.lower[i], bounds.upper[i]);
    EXPECT_LE(bounds.upper[i], 0.1);
  }
}

} // namespace
} // namespace massprops::testing
