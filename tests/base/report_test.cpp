// How values are written, and that a report finds them again.
#include "core/base/report.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace massprops::testing {
namespace {

TEST(Report, KeepsItsOrderAndFindsItsValues) {
  Report report;
  report.add("second", 2.0);
  report.add("first", std::string("one"));
  EXPECT_EQ(report.entries[0].first, "second");
  EXPECT_EQ(std::get<double>(report.at("second")), 2.0);
  EXPECT_EQ(std::get<std::string>(report.at("first")), "one");
  EXPECT_THROW(report.at("third"), std::out_of_range);
}

TEST(ToString, WritesEveryKindOfValueInOneLine) {
  EXPECT_EQ(toString(true), "true");
  EXPECT_EQ(toString(false), "false");
  EXPECT_EQ(toString(42), "42");
  EXPECT_EQ(toString(0.125), "0.125");
  EXPECT_EQ(toString(std::string("it stands")), "it stands");
  EXPECT_EQ(toString(Vec3(1, 2, 3)), "(1, 2, 3)");
  Mat3 matrix;
  matrix << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  EXPECT_EQ(toString(matrix), "((1, 2, 3), (4, 5, 6), (7, 8, 9))");
}

TEST(ToString, KeepsNineDigits) {
  EXPECT_EQ(toString(1.0 / 3), "0.333333333");
  EXPECT_EQ(toString(1e-20 / 3), "3.33333333e-21");
  EXPECT_EQ(toString(-123456789.0), "-123456789");
}

} // namespace
} // namespace massprops::testing
