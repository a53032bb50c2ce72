// Distances within a layer, against closed forms.
#include "core/overhang/layer_distance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace massprops::testing {
namespace {

constexpr int kColumns = 60;
constexpr int kRows = 50;

template <typename Function>
std::vector<float> sampled(const Function& f) {
  std::vector<float> values;
  for (int j = 0; j < kRows; ++j) {
    for (int i = 0; i < kColumns; ++i) values.push_back(static_cast<float>(f(i, j)));
  }
  return values;
}

TEST(LayerDistance, OfACircleIsTheDifferenceOfRadii) {
  constexpr double kSagitta = 2.0 / (8.0 * 15.0) * 1.1; // of chords as long as a diagonal
  constexpr double kSweeps = 0.09;                      // what two sweeps may miss [Dan80]
  const auto circle = [](double i, double j) { return 15.0 - std::hypot(i - 30.3, j - 24.7); };
  LayerDistance distance(kColumns, kRows);
  distance.measure(sampled(circle));
  ASSERT_TRUE(distance.hasBorder());
  for (int j = 0; j < kRows; ++j) {
    for (int i = 0; i < kColumns; ++i) {
      const double known = circle(i, j);
      const double found = distance.distances()[static_cast<std::size_t>(i + kColumns * j)];
      EXPECT_NEAR(found, known, kSagitta + kSweeps);
      const Eigen::Vector2f end = Eigen::Vector2f(static_cast<float>(i), static_cast<float>(j)) +
                                  distance.wayToBorder(i, j);
      EXPECT_NEAR(circle(end.x(), end.y()), 0.0, kSagitta);
    }
  }
}

TEST(LayerDistance, OfTwoStripsIsThatOfTheNearerOne) {
  // Inside for 10 < i < 20 and 30 < i < 50.
  const auto strips = [](int i, int) {
    return std::max(5.0 - std::abs(i - 15.0), 10.0 - std::abs(i - 40.0));
  };
  LayerDistance distance(kColumns, kRows);
  distance.measure(sampled(strips));
  for (int i = 0; i < kColumns; ++i) {
    const double found = distance.distances()[static_cast<std::size_t>(i + kColumns * 20)];
    EXPECT_NEAR(found, strips(i, 20), 1e-4) << i;
  }
}

TEST(LayerDistance, IsFarWithoutABorder) {
  LayerDistance distance(kColumns, kRows);
  distance.measure(sampled([](int, int) { return -1.0; }));
  EXPECT_FALSE(distance.hasBorder());
  EXPECT_EQ(distance.distances().front(), -LayerDistance::kFar);
}

} // namespace
} // namespace massprops::testing
