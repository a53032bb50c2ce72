#include "core/parameters.h"

#include "core/goals/registry.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace massprops {
namespace {

using Values = std::map<std::string, ParameterValue>;

/// Only what was set.
Options optionsOf(const Values& values) {
  return optionsFrom([&](const Parameter& parameter) -> std::optional<ParameterValue> {
    const auto found = values.find(parameter.name);
    if (found == values.end()) return {};
    return found->second;
  });
}

/// What a parameter of that kind holds.
std::size_t alternativeOf(ParameterKind kind) {
  switch (kind) {
  case ParameterKind::Switch:
    return ParameterValue(false).index();
  case ParameterKind::Whole:
  case ParameterKind::Choice:
    return ParameterValue(0).index();
  case ParameterKind::File:
    return ParameterValue(std::string()).index();
  default:
    return ParameterValue(0.0).index();
  }
}

TEST(ParameterTable, HasRowsThatAreWhole) {
  std::set<std::string> names;
  for (const Parameter& parameter : parameterTable()) {
    SCOPED_TRACE(parameter.name);
    EXPECT_TRUE(names.insert(parameter.name).second);
    EXPECT_EQ(parameter.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789_"),
              std::string::npos);
    EXPECT_FALSE(parameter.label.empty());
    EXPECT_EQ(parameter.help.back(), '.');
    EXPECT_EQ(parameter.standard.index(), alternativeOf(parameter.kind));
    EXPECT_EQ(parameter.entries.size() > 1, parameter.kind == ParameterKind::Choice);
  }
}

TEST(ParameterTable, ShowsCategoriesInTheOrderOfTheAlphabetAndTheAdvancedLast) {
  const std::vector<Parameter>& table = parameterTable();
  for (std::size_t i = 1; i < table.size(); ++i) {
    SCOPED_TRACE(table[i].name);
    EXPECT_LE(table[i - 1].category, table[i].category);
    EXPECT_LE(table[i - 1].advanced, table[i].advanced);
  }
}

TEST(ParameterTable, HasDefaultsThatChangeNothing) {
  Values values;
  for (const Parameter& parameter : parameterTable()) {
    if (parameter.kind != ParameterKind::Length) values[parameter.name] = parameter.standard;
  }
  const Options given = optionsOf(values);
  const Options defaults;
  EXPECT_EQ(given.goal, defaults.goal);
  EXPECT_EQ(given.cavityShape, defaults.cavityShape);
  EXPECT_EQ(given.upAxis, defaults.upAxis);
  EXPECT_EQ(given.basisSize, defaults.basisSize);
  EXPECT_EQ(given.radiusX, defaults.radiusX);
  EXPECT_EQ(given.radiusY, defaults.radiusY);
  EXPECT_EQ(given.innerUpperBound, defaults.innerUpperBound);
  EXPECT_EQ(given.density, defaults.density);
  EXPECT_EQ(given.spinSpeed, defaults.spinSpeed);
  EXPECT_EQ(given.weights.centerOfMass, defaults.weights.centerOfMass);
  EXPECT_EQ(given.weights.constraints, defaults.weights.constraints);
  EXPECT_FALSE(given.pivot.has_value());
  EXPECT_EQ(given.mend, defaults.mend);
  EXPECT_EQ(given.foot, defaults.foot);
}

TEST(ParameterTable, PutsEachNumberIntoItsOwnOption) {
  Values values;
  double next = 1.0;
  for (const Parameter& parameter : parameterTable()) {
    if (std::holds_alternative<double>(parameter.standard)) values[parameter.name] = next++;
  }
  values["use_pivot"] = true;
  const auto set = [&](const char* name) { return std::get<double>(values.at(name)); };
  const Options options = optionsOf(values);
  EXPECT_EQ(options.innerLowerBound, set("inner_lower_bound"));
  EXPECT_EQ(options.density, set("density"));
  EXPECT_EQ(options.fillDensity, set("fill_density"));
  EXPECT_EQ(options.radiusX, set("radius_x"));
  EXPECT_EQ(options.radiusY, set("radius_y"));
  EXPECT_EQ(options.footDepth, set("foot_depth"));
  EXPECT_EQ(options.tippingAngle, set("tipping_angle"));
  EXPECT_EQ(options.pivot, Vec3(set("pivot_x"), set("pivot_y"), set("pivot_z")));
  EXPECT_EQ(options.spinSpeed, set("spin_speed"));
  EXPECT_EQ(options.waterLevel, set("water_level"));
  EXPECT_EQ(options.waterDensity, set("water_density"));
  EXPECT_EQ(options.targetMass, set("target_mass"));
  EXPECT_EQ(options.solidDepth, set("solid_depth"));
  EXPECT_EQ(options.innerUpperBound, set("inner_upper_bound"));
  EXPECT_EQ(options.outerLowerBound, set("outer_lower_bound"));
  EXPECT_EQ(options.outerUpperBound, set("outer_upper_bound"));
  EXPECT_EQ(options.weights.volume, set("opt_weight_1"));
  EXPECT_EQ(options.weights.centerOfMass, set("opt_weight_2"));
  EXPECT_EQ(options.weights.inertia, set("opt_weight_3"));
  EXPECT_EQ(options.weights.smoothness, set("opt_weight_4"));
  EXPECT_EQ(options.weights.constraints, set("opt_weight_5"));
  EXPECT_EQ(options.weights.outer, set("opt_weight_6"));
}

TEST(ParameterTable, CountsThePivotOnlyWhereItIsUsed) {
  EXPECT_FALSE(optionsOf({{"pivot_x", 3.0}}).pivot.has_value());
  EXPECT_EQ(optionsOf({{"use_pivot", true}, {"pivot_x", 3.0}}).pivot, Vec3(3.0, 0.0, 0.0));
}

TEST(ParameterTable, NamesEveryGoal) {
  for (std::size_t i = 0; i < goalNames().size(); ++i) {
    EXPECT_EQ(optionsOf({{"goal", static_cast<int>(i)}}).goal, goalRegistry()[i].kind);
  }
}

TEST(ParameterTable, RefusesWhatIsInNoList) {
  for (const int entry : {-1, 3}) {
    try {
      optionsOf({{"cavity_shape", entry}});
      FAIL() << entry;
    } catch (const InvalidInput& refusal) {
      EXPECT_EQ(std::string(refusal.what()), "The parameter 'cavity_shape' is entry " +
                                                 std::to_string(entry) +
                                                 ", but its list has the entries 0 to 2.");
    }
  }
}

} // namespace
} // namespace massprops
