// How low the objective of a spinning body can be, against brute force and closed forms.
#include "core/optimum/spinning_bound.h"

#include "cells.h"
#include "core/goals/spin.h"
#include "core/goals/yo_yo.h"
#include "core/optimum/extreme_bodies.h"
#include "core/optimum/optimal_bound.h"
#include "core/optimum/ratio_bound.h"
#include "core/physics/moments.h"
#include "core/query/triangle_tree.h"
#include "shapes.h"
#include "translated_moments.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <vector>

namespace massprops::testing {
namespace {

Moments boxMoments(const Vec3& size, const Vec3& centre) {
  const double volume = size.prod();
  Moments m = Moments::Zero();
  m[0] = volume;
  m.segment<3>(4) = volume / 12.0 * size.cwiseAbs2();
  return translated(m, centre);
}

/// A box that stands on the origin; what lies deeper than a wall is cut into 4 × 4 × 4 cells.
struct BlockOfCells {
  BlockOfCells(const Vec3& boxSize, double wall)
      : size(boxSize), solid(boxMoments(size, {0, 0, 0.5 * size.z()})), cells(64, 10) {
    const Vec3 edge = (size - Vec3::Constant(2.0 * wall)) / 4.0;
    for (int c = 0; c < 64; ++c) {
      const Vec3 index(c % 4, c / 4 % 4, c / 16);
      const Vec3 centre = (index - Vec3::Constant(1.5)).cwiseProduct(edge);
      cells.row(c) = boxMoments(edge, centre + Vec3(0, 0, 0.5 * size.z())).transpose();
    }
  }

  /// The cell that half a turn about the vertical, or the middle plane, takes this one to.
  static int opposite(int c) { return c / 16 * 16 + 15 - c % 16; }
  static int mirrored(int c) { return (3 - c / 16) * 16 + c % 16; }

  Moments body(const Vector& shares, double fillDensity) const {
    return solid + (fillDensity - 1.0) * (cells.transpose() * shares);
  }

  Vec3 size;
  Moments solid;
  AdmissibleCells cells;
};

/// Shares that leave the centre of mass on the axis, and the axis a principal one; in the middle of
/// the box where it is to be centred.
Vector symmetric(Vector shares, bool isCentred) {
  for (int c = 0; c < 64; ++c) {
    shares[BlockOfCells::opposite(c)] = shares[c];
    if (isCentred && c < 32) shares[BlockOfCells::mirrored(c)] = shares[c];
  }
  if (!isCentred) return shares;
  for (int c = 0; c < 64; ++c) shares[BlockOfCells::opposite(c)] = shares[c];
  return shares;
}

/// A random filling: shares at random, or hollow where a random quadric is positive.
Vector randomShares(const BlockOfCells& block, Random& random, bool isCentred) {
  Vector shares(64);
  if (random() > 0.3) {
    const double bias = random();
    for (double& share : shares) share = random() > bias ? 1.0 : 0.0;
    if (random() > 0.5) {
      for (double& share : shares) share *= 0.5 + 0.5 * random();
    }
  } else {
    const Vector quadric = random.vector(10);
    const Vector values = block.cells * quadric;
    shares = (values.array() > 0.0).cast<double>();
  }
  return symmetric(shares, isCentred);
}

struct Case {
  double staticWeight, inertiaWeight, volumeWeight, fillDensity;
};

constexpr Case kCases[] = {{1.0, 1.0, 0.0, 0.0}, {0.0, 1.0, 0.0, 0.0}, {1.0, 0.0, 0.0, 0.0},
                           {3.0, 0.5, 0.4, 0.0}, {1.0, 1.0, 0.0, 4.0}, {2.0, 1.0, 1.0, 0.5}};

std::unique_ptr<Goal> goalFor(const BlockOfCells& block, bool isCentred, const Weights& weights) {
  if (isCentred) return makeYoYoGoal(block.solid, weights, {0, 0, 0.5 * block.size.z()});
  return makeSpinGoal(block.solid, weights);
}

class EveryBlock : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(SpinAndYoYo, EveryBlock, ::testing::Values(false, true));

TEST_P(EveryBlock, HasNoFillingBelowTheBound) {
  const bool isCentred = GetParam();
  Random random(7);
  int idle = 0;
  for (const Vec3& size : {Vec3(1.0, 0.8, 0.5), Vec3(0.6, 0.5, 1.0), Vec3(1.0, 0.6, 0.63)}) {
    const BlockOfCells block(size, 0.05);
    for (const Case& c : kCases) {
      Weights weights;
      weights.volume = c.volumeWeight;
      weights.centerOfMass = c.staticWeight;
      weights.inertia = c.inertiaWeight;
      const auto goal = goalFor(block, isCentred, weights);
      const OptimalBound best =
          optimalBound(*goal, weights, block.solid, {{c.fillDensity}}, block.cells);
      if (best.violation > 1e-6) continue;
      ASSERT_TRUE(best.objectiveAtLeast);
      EXPECT_LE(*best.objectiveAtLeast, best.objective);
      // SLSQP finds the best body where the constraint that parts the bodies is idle.
      const OptimalBound relaxed =
          optimalBound(*goal->relaxed(), weights, block.solid, {{c.fillDensity}}, block.cells);
      if (largestViolation(*goal, relaxed.massMoments) < 1e-6) {
        ++idle;
        EXPECT_GE(*best.objectiveAtLeast, 0.99 * best.objective) << size.transpose();
      }
      for (int trial = 0; trial < 3000; ++trial) {
        const Vector shares = randomShares(block, random, isCentred);
        const Moments body = block.body(shares, c.fillDensity);
        const double share = 1.0 - shares.dot(block.cells.col(0)) / block.solid[0];
        if (largestViolation(*goal, body) > 1e-9) continue;
        EXPECT_GE(goal->objective(body).value + c.volumeWeight * share,
                  *best.objectiveAtLeast - 1e-9);
      }
    }
  }
  EXPECT_GT(idle, 8);
}

TEST(SpinningBound, IsTheSameForATopOfTwiceTheSize) {
  const BlockOfCells block({1.0, 0.8, 0.5}, 0.05);
  const auto boundAt = [&](double s) {
    Vector power(10);
    power << std::pow(s, 3), Vector::Constant(3, std::pow(s, 4)),
        Vector::Constant(6, std::pow(s, 5));
    const Moments solid = power.cwiseProduct(block.solid);
    const AdmissibleCells cells = block.cells * power.asDiagonal();
    // The static moment is a length.
    const SpinningTask task{Vec3::Zero(), false, solid[0], solid[4] + solid[5], 1.0 / s, 1.0};
    return spinningBound(task, 0.0, 0.9, solid, 0.0, cells)->objective;
  };
  EXPECT_NEAR(boundAt(2.0), boundAt(1.0), 5e-3); // within which it stops
}

TEST(SpinningBound, SaysNothingOfAFillingAsDenseAsTheMaterial) {
  const BlockOfCells block({1.0, 0.8, 0.5}, 0.05);
  const SpinningTask task{Vec3::Zero(), false, 1.0, 1.0, 1.0, 1.0};
  EXPECT_FALSE(spinningBound(task, 0.0, 1.0, block.solid, 1.0, block.cells));
}

TEST(SpinningBound, OfABallIsThatOfTwoConesAlongTheAxis) {
  // As in OptimalBound.OfASpinningBallIsTwoConesAlongTheAxis, centred.
  const double wall = 0.1;
  const double r5 = std::pow(1 - wall, 5);
  double expected = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 1000; ++i) {
    const double c = std::cos(0.5 * std::acos(-1.0) * i / 1000);
    const double zz = 1 - r5 * (1 - c * c * c);
    const double rr = 2 - r5 * (2 - 3 * c + c * c * c);
    expected = std::min(expected, 2 * std::pow((0.5 * rr + zz) / rr, 2));
  }
  const TriangleMesh ball = transformed(sphere(24), Mat3::Identity(), Vec3(0, 0, 1.3));
  const Moments solid = moments(ball.vertices, ball.faces);
  const AdmissibleCells cells = cellsBehind({ball.vertices, ball.faces}, wall);
  const auto goal = makeYoYoGoal(solid, {}, {0, 0, 1.3});
  const OptimalBound best = optimalBound(*goal, {}, solid, {{}}, cells);
  ASSERT_TRUE(best.objectiveAtLeast);
  EXPECT_NEAR(*best.objectiveAtLeast, expected, 5e-3 * (2.0 - expected));
  EXPECT_NEAR(best.objective, *best.objectiveAtLeast, 1e-3 * best.objective);
}

TEST(SpinningBound, IsHigherWhereTheBestBodyHasTheMiddleMomentAboutTheAxis) {
  // Of a block nearly as high as it is deep the moment about the axis is the greatest only if much
  // is hollow above and below, which the weight of the volume is too heavy for.
  const BlockOfCells block({1.0, 0.6, 0.63}, 0.05);
  const auto goal = makeYoYoGoal(block.solid, {}, {0, 0, 0.315});
  const double volumeWeight = -1.0; // the more material the better
  double least = std::numeric_limits<double>::infinity();
  double leastOfAny = least;
  // Fillings that are symmetric to all middle planes: eight shares, each in quarters.
  for (int filling = 0; filling < 390625; ++filling) {
    Vector shares(64);
    for (int c = 0; c < 64; ++c) {
      const auto side = [](int i) { return std::min(i, 3 - i); };
      const int orbit = side(c % 4) + 2 * side(c / 4 % 4) + 4 * side(c / 16);
      shares[c] = 0.25 * (filling / static_cast<int>(std::pow(5, orbit)) % 5);
    }
    const Moments body = block.body(shares, 0.0);
    const double hollow = shares.dot(block.cells.col(0)) / block.solid[0];
    const double objective = goal->objective(body).value + volumeWeight * (1.0 - hollow);
    leastOfAny = std::min(leastOfAny, objective);
    if (objective < least && largestViolation(*goal, body) < 1e-9) least = objective;
  }
  const double bound =
      spinningBound(*goal->spinningTask(), volumeWeight, least, block.solid, 0.0, block.cells)
          ->objective;
  EXPECT_LE(bound, least);
  EXPECT_GT(bound, leastOfAny + 0.25 * (least - leastOfAny)) << least << ", " << leastOfAny;
}

TEST(RatioBound, IsTheLeastOfAllFillingsOfFewCells) {
  const BlockOfCells block({1.0, 0.8, 0.5}, 0.05);
  const AdmissibleCells cells = block.cells.middleRows(20, 10);
  const ExtremeBodies bodies(block.solid, 0.0, cells);
  Random random(3);
  for (int trial = 0; trial < 20; ++trial) {
    AffineRow dividend = AffineRow::Zero();
    dividend.head<10>() = random.vector(10).transpose();
    const AffineRow divisor = AffineRow::Unit(0) + 0.5 * AffineRow::Unit(4);
    double least = std::numeric_limits<double>::infinity();
    double leastRatio = least;
    for (int set = 0; set < 1024; ++set) {
      Moments body = block.solid;
      for (int c = 0; c < 10; ++c) {
        if ((set >> c & 1) != 0) body -= cells.row(c).transpose();
      }
      least = std::min(least, valueOf(dividend, body));
      leastRatio = std::min(leastRatio, valueOf(dividend, body) / valueOf(divisor, body));
    }
    EXPECT_NEAR(valueOf(dividend, bodies.withLeast(dividend)), least, 1e-14);
    const Moments body = bodies.withLeastRatio(dividend, divisor, block.solid);
    EXPECT_NEAR(valueOf(dividend, body) / valueOf(divisor, body), leastRatio, 1e-13);
  }
}

TEST(RatioBound, KeepsEveryKindOfCondition) {
  // The least m of the block with S_z = 0.23 m, or at most that, or with it as both diagonal
  // entries of a matrix: of bodies that are hollow above a height.
  const BlockOfCells block({1.0, 0.8, 0.5}, 0.05);
  const ExtremeBodies bodies(block.solid, 0.0, block.cells);
  const AffineRow low = AffineRow::Unit(3) - 0.23 * AffineRow::Unit(0);
  const AffineRow most = -AffineRow::Unit(0);
  // To have much mass: what has to go is as high as possible. 0.25 m_0 − z Δ = 0.23 (m_0 − Δ) in
  // the uppermost layer, z = 0.4.
  const double gone = 0.02 * 0.4 / (0.4 - 0.23);
  for (int kind = 0; kind < 3; ++kind) {
    RatioProblem problem;
    problem.across = most;
    problem.divisor = AffineRow::Unit(10);
    if (kind == 0) problem.equal = low;
    if (kind == 1) problem.less = low;
    if (kind == 2) {
      problem.cone = AffineRows::Zero(3, 11);
      problem.cone.row(0) = problem.cone.row(1) = low;
    }
    const auto worth = [](double ratio, double) { return Worth{ratio, 1.0, 0.0}; };
    const RatioBound bound = ratioBound(problem, worth, bodies, {}, block.solid);
    EXPECT_NEAR(bound.value, -(0.4 - gone), 1e-5) << kind;
    EXPECT_LE(bound.value, -(0.4 - gone) + 1e-12) << kind;
  }
}

} // namespace
} // namespace massprops::testing
