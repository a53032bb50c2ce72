#include "core/goals/registry.h"

#include "core/goals/float.h"
#include "core/goals/hang.h"
#include "core/goals/mass.h"
#include "core/goals/published_stand.h"
#include "core/goals/roll_upright.h"
#include "core/goals/spin.h"
#include "core/goals/stand.h"
#include "core/goals/stand_empty_and_filled.h"
#include "core/goals/yo_yo.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace massprops {
namespace {

Moments solid(const GoalInputs& in) {
  return moments(in.posed.vertices, in.posed.faces);
}

double unit(const GoalInputs& in) {
  return in.posed.frame.length;
}

/// The axis is a line: any of its points says where it is.
Vec2 spinAxis(const GoalInputs& in) {
  return in.posed.pivot.value_or(Vec3::Zero()).head<2>();
}

Vec3 middleOfAxle(const GoalInputs& in) {
  return in.posed.pivot.value_or(Vec3(0.0, 0.0, 0.5 * in.posed.vertices.col(2).maxCoeff()));
}

double filling(const Options& options) {
  return contentsDensity(options) / options.density;
}

double waterDensity(const GoalInputs& in) {
  return in.options.waterDensity / in.options.density;
}

/// The given pivot, or the middle of the top: the ground of the model turned upside down.
Vec3 suspension(const GoalInputs& in) {
  if (in.posed.pivot) return *in.posed.pivot;
  Points turned = in.posed.vertices;
  turned.rightCols<2>() *= -1.0;
  const Vec3 ground = groundContact(turned, {}).centre;
  return {ground.x(), -ground.y(), -ground.z()};
}

/// Of the openings of an open surface.
Points rims(const GoalInputs& in) {
  Points result(0, 3);
  if (in.posed.open) result = in.outer(in.posed.open->rim, Eigen::all);
  return result;
}

/// A working unit of mass in grams.
double grams(const GoalInputs& in) {
  return in.options.density * std::pow(unit(in), 3) / 1000.0;
}

std::optional<double> targetMass(const GoalInputs& in) {
  if (in.options.targetMass <= 0.0) return std::nullopt;
  return in.options.targetMass / grams(in);
}

std::vector<GoalEntry> allGoals() {
  using In = GoalInputs;
  return {
      {GoalKind::Stand, "Stand",
       "it stands on its ground contacts, as hard to tip over as possible", 0,
       [](const In& in) {
         return makeStandGoal(in.posed.contact, in.options.weights, in.options.tippingAngle,
                              solid(in)[0]);
       },
       [](const In& in) {
         return makeStandVerdict(in.posed.contact, unit(in), in.options.tippingAngle);
       }},
      {GoalKind::Spin, "Spin", "it spins as a top about the vertical axis through its lowest point",
       4, [](const In& in) { return makeSpinGoal(solid(in), in.options.weights, spinAxis(in)); },
       [](const In& in) {
         return makeSpinVerdict(solid(in), spinAxis(in), unit(in), in.options.spinSpeed);
       }},
      {GoalKind::YoYo, "Yo-yo", "it spins about its vertical axle, balanced on both sides", 5,
       [](const In& in) { return makeYoYoGoal(solid(in), in.options.weights, middleOfAxle(in)); },
       [](const In& in) { return makeYoYoVerdict(solid(in), middleOfAxle(in), unit(in)); }},
      {GoalKind::StandEmptyAndFilled, "Stand empty and filled",
       "it stands with its cavity empty and with it filled", 0,
       [](const In& in) { return makeStandGoal(in.posed.contact, in.options.weights); },
       [](const In& in) {
         return makeStandEmptyAndFilledVerdict(in.posed.contact, moments(in.outer, in.posed.faces),
                                               filling(in.options), unit(in), in.cavity);
       }},
      {GoalKind::RollUpright, "Roll upright",
       "it comes back upright from every position, like a tumbler", 0,
       [](const In& in) { return makeRollUprightGoal(in.outer, in.options.weights); },
       [](const In& in) { return makeRollUprightVerdict(in.posed.contact, in.outer); }},
      {GoalKind::Float, "Float", "it floats upright at the given waterline", 3,
       [](const In& in) {
         return makeFloatGoal(in.outer, in.posed.faces, in.options.waterLevel, waterDensity(in),
                              in.options.weights);
       },
       [](const In& in) {
         return makeFloatVerdict(in.outer, in.posed.faces, in.options.waterLevel, waterDensity(in),
                                 unit(in), rims(in));
       }},
      {GoalKind::Hang, "Hang", "it hangs upright from its topmost point or a given one", 2,
       [](const In& in) { return makeHangGoal(suspension(in), in.options.weights); },
       [](const In& in) { return makeHangVerdict(suspension(in), unit(in)); }},
      {GoalKind::Mass, "Mass", "it weighs as much as is asked for", 1,
       [](const In& in) { return makeMassGoal(solid(in)[0], targetMass(in), in.options.weights); },
       [](const In& in) { return makeMassVerdict(targetMass(in), grams(in)); }},
      {GoalKind::PublishedStand, "Stand (published)",
       "it stands on its ground contacts, by the objective that the literature prints", 0,
       [](const In& in) {
         return makePublishedStandGoal(in.posed.contact, unit(in), in.options.weights);
       },
       [](const In& in) { return makeStandVerdict(in.posed.contact, unit(in)); }},
  };
}

} // namespace

const std::vector<GoalEntry>& goalRegistry() {
  static const std::vector<GoalEntry> goals = allGoals();
  return goals;
}

const GoalEntry& goalEntry(GoalKind kind) {
  const std::vector<GoalEntry>& goals = goalRegistry();
  const auto found = std::find_if(goals.begin(), goals.end(),
                                  [&](const GoalEntry& entry) { return entry.kind == kind; });
  if (found == goals.end()) {
    throw InvalidInput("This goal does not exist: choose one from the list.");
  }
  return *found;
}

const std::vector<std::string>& goalNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> result;
    for (const GoalEntry& entry : goalRegistry()) result.push_back(entry.name);
    return result;
  }();
  return names;
}

void requireEnoughFunctions(const Options& options) {
  const GoalEntry& goal = goalEntry(options.goal);
  if (options.basisSize >= goal.equalities) return;
  throw InvalidInput("basis_k is " + std::to_string(options.basisSize) + ": the goal " + goal.name +
                     " has to meet " + std::to_string(goal.equalities) +
                     " conditions at once; give at least as many functions.");
}

std::unique_ptr<Goal> makeGoal(const Options& options, const PosedModel& posed,
                               const Points& outer) {
  return goalEntry(options.goal).goal({options, posed, outer});
}

std::unique_ptr<Verdict> makeVerdict(const Options& options, const PosedModel& posed,
                                     const Points& outer, const TriangleMesh* cavity) {
  return goalEntry(options.goal).verdict({options, posed, outer, cavity});
}

Fillings fillingsSeenBy(const Options& options) {
  if (options.goal == GoalKind::StandEmptyAndFilled) return {{}, {filling(options)}};
  return {{filling(options)}};
}

} // namespace massprops
