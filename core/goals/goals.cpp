#include "core/goals/goals.h"

#include <algorithm>
#include <cmath>

namespace massprops {
namespace {

Vec3 middleOfTop(const Points& vertices) {
  // The top is the ground of the model turned upside down.
  Points turned = vertices;
  turned.rightCols<2>() *= -1.0;
  const Vec3 ground = groundContact(turned, {}).centre;
  return {ground.x(), -ground.y(), -ground.z()};
}

} // namespace

VerdictBounds Goal::verdictBounds(const Moments& /*massMoments*/, double /*level*/) const {
  return {};
}

std::string Goal::bestInWords(const Moments& massMoments) const {
  return "at best " + worstViolation(massMoments);
}

std::string Goal::draw(const Moments& /*before*/, const Moments& /*after*/,
                       Annotations& /*sketch*/) const {
  return "";
}

std::unique_ptr<Goal> makeGoal(const Options& options, const PosedModel& posed,
                               const Points& outer) {
  const Weights& weights = options.weights;
  const double unit = posed.frame.length;
  const double filling = options.fillDensity / options.density;
  const auto solid = [&] { return moments(posed.vertices, posed.faces); };
  switch (options.goal) {
  case GoalKind::Stand:
    return makeStandGoal(posed.contact, weights, unit);
  case GoalKind::Spin:
    return makeSpinGoal(solid(), weights, unit, posed.pivot.value_or(Vec3::Zero()));
  case GoalKind::YoYo: {
    const Vec3 middle(0.0, 0.0, 0.5 * posed.vertices.col(2).maxCoeff());
    return makeYoYoGoal(solid(), weights, unit, posed.pivot.value_or(middle));
  }
  case GoalKind::StandEmptyAndFilled:
    return makeStandEmptyAndFilledGoal(posed.contact, moments(outer, posed.faces), filling, weights,
                                       unit);
  case GoalKind::RollUpright:
    return makeRollUprightGoal(posed.contact, outer, weights, unit);
  case GoalKind::Float:
    return makeFloatGoal(outer, posed.faces, options.waterLevel,
                         options.waterDensity / options.density, weights, unit);
  case GoalKind::Hang:
    return makeHangGoal(posed.pivot ? *posed.pivot : middleOfTop(posed.vertices), weights, unit);
  case GoalKind::Mass: {
    const double grams = options.density * std::pow(unit, 3) / 1000.0;
    const std::optional<double> target =
        options.targetMass > 0.0 ? std::optional(options.targetMass / grams) : std::nullopt;
    return makeMassGoal(solid()[0], target, weights, grams);
  }
  }
  throw InvalidInput("This goal does not exist: choose one from the list.");
}

double fillingSeenBy(const Options& options) {
  return options.goal == GoalKind::StandEmptyAndFilled ? 0.0
                                                       : options.fillDensity / options.density;
}

double largestViolation(const Goal& goal, const Moments& massMoments) {
  double largest = 0.0;
  for (const double e : goal.equalities(massMoments).values) {
    largest = std::max(largest, std::abs(e));
  }
  for (const double g : goal.inequalities(massMoments).values) largest = std::max(largest, g);
  return largest;
}

} // namespace massprops
