// The speed from which a top sleeps, against closed forms and the eigenvalues of its motion.
#include "core/physics/sleeping_top.h"

#include "shapes.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <cmath>

namespace massprops::testing {
namespace {

/// The fastest growth of a disturbance: by the eigenvalues of Euler's equations and of the
/// vertical's, both in the body and linearised about the upright spin.
double growthAt(const Top& top, double w) {
  const double A = top.acrossA;
  const double B = top.acrossB;
  const double C = top.axial;
  const double k = top.weightMoment;
  // Of (ω_1, ω_2, γ_1, γ_2), γ the upward direction.
  Eigen::Matrix4d motion;
  motion << 0, (B - C) * w / A, 0, k / A, //
      (C - A) * w / B, 0, -k / B, 0,      //
      0, -1, 0, w,                        //
      1, 0, -w, 0;
  return Eigen::EigenSolver<Eigen::Matrix4d>(motion).eigenvalues().real().maxCoeff();
}

/// Rounding makes of a double imaginary root one that grows by the square root of 1e-16.
constexpr double kNoGrowth = 1e-6;

/// A body whose centre is above its tip, by the moments of the body about its centre.
Top topOf(const Vec3& central, double mass, double height, double gravity) {
  const double shift = mass * height * height;
  return {central.x() + shift, central.y() + shift, central.z(), mass * gravity * height};
}

TEST(SleepingSpeed, OfASymmetricTopIsTheClosedForm) {
  // ω² = 4 m g h A / C²
  for (const double A : {0.3, 1.0, 7.0}) {
    for (const double C : {0.05, 0.5, 0.9 * A, 1.5 * A}) {
      const Top top{A, A, C, 2.5};
      ASSERT_TRUE(sleepingSpeed(top));
      EXPECT_NEAR(*sleepingSpeed(top), 2.0 * std::sqrt(2.5 * A) / C, 1e-12 * A / C);
    }
  }
}

TEST(SleepingSpeed, MayHaveAnUnstableBandAboveAStableWindow) {
  const Top top{1.0, 0.8, 1.2, 1.0};
  // Q = (0.2 w − 1)(0.4 w − 1) is negative between w = 2.5 and 5.
  EXPECT_NEAR(*sleepingSpeed(top), std::sqrt(5.0), 1e-12);
  EXPECT_NEAR(std::sqrt(2.5), 1.58, 0.005);
  EXPECT_NEAR(std::sqrt(5.0), 2.24, 0.005);
  EXPECT_FALSE(sleepsAt(top, 1.59));
  EXPECT_FALSE(sleepsAt(top, 2.23));
  EXPECT_TRUE(sleepsAt(top, 2.25));
  EXPECT_TRUE(sleepsAt(top, 1.57)); // the window
  EXPECT_FALSE(sleepsAt(top, 0.5));
}

TEST(SleepingSpeed, LeavesOutBandsThatAHandSpunTopSlowsThrough) {
  // Disturbances followed through the band by the fastest growth there.
  const auto factorThrough = [](const Top& top, double turns) {
    const double from = std::sqrt(top.weightMoment / (top.axial - top.acrossB));
    const double to = std::sqrt(top.weightMoment / (top.axial - top.acrossA));
    constexpr int kSteps = 2000;
    const double ratio = std::pow(to / from, 1.0 / kSteps);
    double sum = 0.0;
    for (int i = 0; i < kSteps; ++i) {
      const double w = from * std::pow(ratio, i + 0.5);
      sum += turns * std::log(ratio) * 2.0 * std::acos(-1.0) * growthAt(top, w) / w;
    }
    return std::exp(sum);
  };
  const auto uneven = [](double share) { return Top{1.0 + share, 1.0, 1.2, 1.0}; };
  const double round = 2.0 / 1.2;
  const double band = std::sqrt(1.0 / 0.2);
  for (const double share : {1e-10, 1e-5, 1e-3, 0.005}) {
    EXPECT_NEAR(*sleepingSpeed(uneven(share)), round, share) << share;
    EXPECT_LT(factorThrough(uneven(share), 1000.0), 2.0) << share;
  }
  for (const double share : {0.02, 0.05}) {
    EXPECT_GT(*sleepingSpeed(uneven(share)), band) << share;
    EXPECT_GT(factorThrough(uneven(share), 1000.0), 2.0) << share;
  }
}

TEST(SleepingSpeed, IsNoneForTheMiddleMoment) {
  const Top top{1.2, 0.6, 1.0, 1.0};
  EXPECT_FALSE(sleepingSpeed(top));
  for (const double w : {3.0, 30.0, 3000.0}) EXPECT_FALSE(sleepsAt(top, w));
  // About the smallest of the three it sleeps, also where two of them are equal.
  EXPECT_TRUE(sleepingSpeed({1.2, 0.6, 0.6, 1.0}));
}

TEST(SleepingSpeed, OfARodOnItsTipIsBeyondEveryHand) {
  // 4 × 4 × 99 mm, in millimetres and seconds; the mass cancels.
  const double mass = 3.0;
  const Vec3 central(mass * (16 + 99 * 99) / 12.0, mass * (16 + 99 * 99) / 12.0, mass * 32 / 12.0);
  const double speed = *sleepingSpeed(topOf(central, mass, 49.5, 9806.65));
  EXPECT_NEAR(speed * 30 / std::acos(-1.0), 285000, 1000);
}

TEST(SleepingSpeed, OfABodyThatHangsIsZeroAboutTheLargestMoment) {
  EXPECT_EQ(*sleepingSpeed({0.9, 0.8, 1.2, -1.0}), 0.0);
  // About the smallest it swings out between the speeds of its two pendulums.
  EXPECT_NEAR(*sleepingSpeed({1.0, 0.9, 0.3, -1.0}), std::sqrt(1 / 0.6), 1e-12);
}

TEST(SleepingSpeed, SeparatesGrowthFromOscillation) {
  Random random(41);
  int slept = 0;
  int windows = 0;
  for (int trial = 0; trial < 300; ++trial) {
    // Any triangle of moments is some body's; the tip is below its centre.
    const Vec3 lengths = (random.vector().array().abs() + 0.02).matrix();
    const Vec3 squares = lengths.cwiseAbs2();
    const Vec3 central(squares.y() + squares.z(), squares.x() + squares.z(),
                       squares.x() + squares.y());
    const Top top = topOf(central, 1.0, 0.05 + std::abs(random()), 1.0);
    const double C = top.axial;
    const bool isMiddle = (C - top.acrossA) * (C - top.acrossB) < 0.0;
    const auto speed = sleepingSpeed(top);
    ASSERT_EQ(speed.has_value(), !isMiddle);
    const double last = speed.value_or(std::sqrt(top.weightMoment / C));
    if (speed) {
      ++slept;
      EXPECT_GT(growthAt(top, 0.999 * last), kNoGrowth);
      for (const double factor : {1.001, 1.1, 2.0, 10.0, 1000.0}) {
        EXPECT_LT(growthAt(top, factor * last), kNoGrowth * factor * last);
      }
    }
    for (double w = 0.02 * last; w < 3.0 * last; w += 0.0317 * last) {
      const bool grows = growthAt(top, w) > kNoGrowth;
      EXPECT_EQ(sleepsAt(top, w), !grows) << "at " << w << ", sleeping speed " << last;
      if (speed && !grows && w < last) ++windows;
    }
  }
  EXPECT_GT(slept, 100);
  EXPECT_GT(windows, 0);
}

TEST(SleepingSpeed, ScalesWithTheRootOfGravityOverLength) {
  const Vec3 central(0.7, 0.5, 0.3);
  const double one = *sleepingSpeed(topOf(central, 1.0, 0.8, 9.8));
  const double s = 50.0; // lengths
  const double large = *sleepingSpeed(topOf(s * s * central, 1.0, 0.8 * s, 9.8));
  EXPECT_NEAR(large, one / std::sqrt(s), 1e-12 * one);
  const double heavy = *sleepingSpeed(topOf(7.0 * central, 7.0, 0.8, 9.8));
  EXPECT_NEAR(heavy, one, 1e-12 * one);
}

} // namespace
} // namespace massprops::testing
