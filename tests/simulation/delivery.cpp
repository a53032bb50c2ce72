#include "simulation/delivery.h"

#include "simulation/floating.h"
#include "simulation/free_spin.h"
#include "simulation/hanging.h"
#include "simulation/hull.h"
#include "simulation/rolling.h"
#include "simulation/spinning.h"
#include "simulation/standing.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace simulation {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kGravity = 9.80665; // m/s²
/// The report's numbers have nine digits.
constexpr double kDigits = 1e-7;
constexpr double kTolerance = 0.5; // degrees

/// The body before or after, and what is said of it.
struct State {
  std::string name;
  const Delivery& delivery;
  const Mesh& outer;
  MassProperties properties; ///< g, model units
  double unit;               ///< diagonal of the model
  Body body;

  std::string key(const std::string& stem) const { return stem + "_" + name; }
  double number(const std::string& stem) const { return delivery.report.number(key(stem)); }
  bool truth(const std::string& stem) const { return delivery.report.truth(key(stem)); }
};

State stateOf(const Delivery& delivery, bool after, double fillDensity,
              double level = std::numeric_limits<double>::infinity()) {
  const Mesh& outer = after ? delivery.outer : delivery.model;
  const MassProperties properties =
      massProperties(outer, after ? delivery.inner : Mesh(),
                     delivery.script.number("density") / 1000.0, fillDensity / 1000.0, level);
  const double unit = diagonal(delivery.model);
  return {after ? "after" : "before",
          delivery,
          outer,
          properties,
          unit,
          inNaturalUnits(outer, properties, unit)};
}

/// By the plumb line.
double tippingAngleOf(const State& state) {
  return weakestSide(contactPolygon(state.body.surface), state.body.centre).angle;
}

/// With what is in the cavity up to the level at which it falls over first.
State weakestWhileFilled(const Delivery& delivery, double fillDensity) {
  constexpr int kLevels = 24;
  const double low = delivery.inner.vertices.col(2).minCoeff();
  const double high = delivery.inner.vertices.col(2).maxCoeff();
  double least = std::numeric_limits<double>::infinity();
  double weakest = high;
  for (int i = 1; i <= kLevels; ++i) {
    const double level = low + (high - low) * i / kLevels;
    const double angle = tippingAngleOf(stateOf(delivery, true, fillDensity, level));
    if (angle >= least) continue;
    least = angle;
    weakest = level;
  }
  return stateOf(delivery, true, fillDensity, weakest);
}

void compareMassProperties(const State& s, Comparison& comparison) {
  comparison.number(s.name + ": mass", s.number("mass"), s.properties.mass,
                    kDigits * s.properties.mass);
  const std::vector<double> centre = s.delivery.report.numbers(s.key("center_of_mass"));
  comparison.number(s.name + ": centre of mass, distance", 0.0,
                    (Eigen::Map<const Vector3d>(centre.data()) - s.properties.centre).norm(),
                    kDigits * s.unit);
  const std::vector<double> inertia = s.delivery.report.numbers(s.key("inertia_tensor"));
  comparison.number(s.name + ": inertia tensor, distance over its size", 0.0,
                    (Eigen::Map<const Matrix3d>(inertia.data()) - s.properties.inertia).norm() /
                        s.properties.inertia.norm(),
                    kDigits);
}

/// The pivot that was given, or `otherwise`; natural units.
Vector3d pivotOr(const State& s, const Vector3d& otherwise) {
  const Record& script = s.delivery.script;
  if (!script.truth("use_pivot")) return otherwise;
  return Vector3d(script.number("pivot_x"), script.number("pivot_y"), script.number("pivot_z")) /
         s.unit;
}

void compareSpin(const State& s, Comparison& comparison) {
  const Vector3d ground = middleOfContact(s.body.surface);
  Vector3d tip = pivotOr(s, ground);
  tip.z() = ground.z();
  const double seconds = std::sqrt(s.unit / 1000.0 / kGravity);
  const double sleeping = sleepingSpeed(topOf(s.body, tip));
  const std::string key = s.key("sleeping_speed");
  const bool balanced = s.number("axis_offset") < 1e-3 * s.unit && s.number("axis_tilt") < 0.5;
  const double perMinute = sleeping / seconds * 30.0 / kPi;
  comparison.note("sleeping speed by the polynomial, rpm: " + std::to_string(perMinute));
  if (balanced && s.delivery.report.has(key)) {
    comparison.number(s.name + ": sleeping speed by the polynomial, rpm",
                      s.delivery.report.number(key), perMinute,
                      1e-6 * s.delivery.report.number(key));
  }
  compareSpinning(s.body, tip, balanced, s.name, comparison);
}

void compareFreeSpin(const State& s, Comparison& comparison) {
  const double wobble = freeWobble(s.body);
  constexpr double kMost = 30.0; // degrees; what has the middle moment about it turns over
  const double bound = std::min(kMost, expectedFreeWobble(s.body) + kTolerance);
  comparison.note("wobble in degrees: " + std::to_string(wobble) + ", of a balanced one at most " +
                  std::to_string(bound));
  comparison.truth(s.name + ": spins about its axle", s.truth("spins"), wobble < bound);
}

void compareRolling(const State& s, Comparison& comparison) {
  constexpr int kDrops = 40;
  constexpr double kUpright = 2.0;
  int upright = 0;
  double most = 0.0;
  for (const Vector3d& down : restsAfterDrops(s.body, kDrops)) {
    const double off = std::acos(std::min(1.0, -down.z())) * 180.0 / kPi;
    most = std::max(most, off);
    if (off < kUpright) ++upright;
  }
  comparison.note(std::to_string(upright) + " of " + std::to_string(kDrops) +
                  " drops end upright; farthest off, degrees: " + std::to_string(most));
  const double settled = std::acos(std::min(1.0, -restWhenSetDown(s.body).z())) * 180.0 / kPi;
  comparison.number(s.name + ": tilt when set down upright", s.number("rest_tilt"), settled, 1.0);
  comparison.truth(s.name + ": comes back upright from everywhere", s.truth("rolls_upright"),
                   upright == kDrops);
}

/// Whether the report lists a pose with this tilt: "0, 90.1, 0 to 180".
bool isListed(const std::string& tilts, double tilt) {
  std::istringstream items(tilts);
  for (std::string item; std::getline(items, item, ',');) {
    std::istringstream words(item);
    double low = 0.0;
    std::string to;
    words >> low;
    double high = low;
    words >> to >> high;
    if (to.empty()) high = low;
    if (tilt > low - 1.0 && tilt < high + 1.0) return true;
  }
  return false;
}

/// Out of that many heels in directions all round, from how many the body does not come back.
int lostHeels(const State& s, double displaced, double heel, int directions) {
  int lost = 0;
  for (int i = 0; i < directions; ++i) {
    const Floated pose = floated(s.body, displaced, heel, 2.0 * kPi * i / directions);
    if (std::abs(pose.heel - s.number("heel_angle")) > 1.0) ++lost;
  }
  return lost;
}

void compareSafeHeel(const State& s, double displaced, Comparison& comparison) {
  // Heels count from the pose in which it floats.
  if (!s.delivery.report.has(s.key("safe_heel")) || s.number("heel_angle") >= 1.0) return;
  constexpr int kDirections = 16;
  const double less = s.number("safe_heel") - kTolerance;
  if (less > 0.0) {
    comparison.number(s.name + ": of 16 safe heels do not come back", 0,
                      lostHeels(s, displaced, less, kDirections), 0);
  }
  // With one pose it goes on to the same one. The weakest direction may lie between two of these.
  if (s.number("floating_poses") < 2.0) return;
  const double more = s.number("vanishing_stability") + 4.0 * kTolerance;
  if (more < 180.0) {
    comparison.truth(s.name + ": comes back from all heels beyond the vanishing one", false,
                     lostHeels(s, displaced, more, kDirections) == 0);
  }
}

/// Where it ends from heels up to upside down.
void compareOtherPoses(const State& s, double displaced, Comparison& comparison) {
  if (!s.delivery.report.has(s.key("floating_tilts"))) return;
  const std::string& known = s.delivery.report.text(s.key("floating_tilts"));
  constexpr int kStarts = 12;
  int unknown = 0;
  for (int i = 0; i < kStarts; ++i) {
    const Floated pose = floated(s.body, displaced, 180.0 * (i + 0.5) / kStarts, 2.4 * i);
    if (isListed(known, pose.heel)) continue;
    ++unknown;
    comparison.note("it floats " + std::to_string(pose.heel) + " degrees over");
  }
  comparison.number(s.name + ": of 12 heels end in a pose not reported", 0, unknown, 0);
}

void compareFloating(const State& s, Comparison& comparison) {
  const double displaced =
      s.properties.mass * 1000.0 / s.delivery.script.number("water_density") / std::pow(s.unit, 3);
  constexpr int kPushes = 4;
  for (int i = 0; i < kPushes; ++i) {
    const Floated pose = floated(s.body, displaced, 3.0, 2.0 * kPi * (i + 0.25) / kPushes);
    const std::string push = s.name + ", push " + std::to_string(i + 1) + ": ";
    comparison.truth(push + "floats", s.truth("floats"), std::isfinite(pose.draught));
    if (!std::isfinite(pose.draught)) return;
    comparison.number(push + "heel", s.number("heel_angle"), pose.heel, kTolerance);
    comparison.number(push + "draught", s.number("draught"), pose.draught * s.unit, 0.005 * s.unit);
  }
  compareSafeHeel(s, displaced, comparison);
  compareOtherPoses(s, displaced, comparison);
}

void compareState(const State& s, const std::string& goal, Comparison& comparison) {
  if (goal == "Stand" || goal == "Stand (published)") {
    compareStanding(s.body, s.number("tip_angle"), s.name, comparison);
  }
  if (goal == "Spin") compareSpin(s, comparison);
  if (goal == "Yo-yo") compareFreeSpin(s, comparison);
  if (goal == "Stand empty and filled") {
    compareStanding(s.body, s.number("tip_angle_empty"), s.name + ", empty", comparison);
  }
  if (goal == "Roll upright") compareRolling(s, comparison);
  if (goal == "Float") compareFloating(s, comparison);
  if (goal == "Hang") {
    comparison.number(s.name + ": hanging angle", s.number("hanging_angle"),
                      hangingAngle(s.body, pivotOr(s, topPoint(s.body.surface))), kTolerance);
  }
}

} // namespace

Delivery readDelivery(const std::string& modelPath, const std::string& prefix,
                      const std::string& scriptPath) {
  Delivery delivery{
      readPly(modelPath), {}, {}, readReport(prefix + "_report.txt"), readScript(scriptPath)};
  const std::string outer = prefix + "_outer.ply";
  const std::string inner = prefix + "_inner.ply";
  delivery.outer = std::filesystem::exists(outer) ? readPly(outer) : delivery.model;
  if (std::filesystem::exists(inner)) delivery.inner = readPly(inner);
  if (delivery.script.number("up_axis") != 0.0 || delivery.script.number("radius_x") != 0.0) {
    throw std::runtime_error(
        "only +Z as up_axis and contact areas of the model itself are simulated");
  }
  return delivery;
}

void compareDelivery(const Delivery& delivery, Comparison& comparison) {
  const std::string& goal = delivery.report.text("goal");
  const double fillDensity = delivery.script.number("fill_density");
  const bool bothWays = goal == "Stand empty and filled";
  for (const bool after : {false, true}) {
    const State state = stateOf(delivery, after, bothWays ? 0.0 : fillDensity);
    compareMassProperties(state, comparison);
    compareState(state, goal, comparison);
  }
  if (bothWays) {
    const State filled = stateOf(delivery, true, fillDensity);
    compareStanding(filled.body, filled.number("tip_angle_filled"), "after, filled", comparison);
    if (delivery.report.text("filled_as") == "one cavity") {
      const State partly = weakestWhileFilled(delivery, fillDensity);
      comparison.number("after, at the worst level: reported tipping angle",
                        partly.number("tip_angle_filling"), tippingAngleOf(partly), kTolerance);
      compareStanding(partly.body, tippingAngleOf(partly), "after, at the worst level", comparison);
    }
  }
}

} // namespace simulation
