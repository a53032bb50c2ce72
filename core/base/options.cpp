#include "core/base/options.h"

#include <cmath>
#include <string>

namespace massprops {

namespace {

void require(bool holds, const std::string& sentence) {
  if (!holds) throw InvalidInput(sentence);
}

bool finite(double value) {
  return std::isfinite(value);
}

/// What the body is made of, and what only some goals need.
void requireSensibleWishes(const Options& options) {
  require(finite(options.density) && options.density > 0.0,
          "density must be greater than 0 g/cm³; PLA has 1.24.");
  require(finite(options.fillDensity) && options.fillDensity >= 0.0,
          "fill_density must be 0 (an empty cavity) or positive.");
  require(options.cavityInfill >= 0.0 && options.cavityInfill < 1.0,
          "cavity_infill is a share of the material: give 0 (an empty cavity) or a value below 1; "
          "0.1 carries a ceiling.");
  require(options.goal != GoalKind::StandEmptyAndFilled || options.fillDensity > 0.0,
          "The goal Stand empty and filled needs fill_density, the density of what will be in the "
          "cavity: 1 for water.");
  require(!options.pivot || options.pivot->allFinite(),
          "pivot_x, pivot_y and pivot_z must be coordinates of a point.");
  require(finite(options.spinSpeed) && options.spinSpeed > 0.0,
          "spin_speed must be greater than 0 rpm; thumb and finger reach 1000.");
  require(options.waterLevel > 0.0 && options.waterLevel <= 1.0,
          "water_level is a share of the model's height: give a value above 0 and at most 1 (under "
          "water).");
  require(finite(options.waterDensity) && options.waterDensity > 0.0,
          "water_density must be greater than 0 g/cm³; fresh water has 1.");
  require(finite(options.targetMass) && options.targetMass >= 0.0,
          "target_mass must be 0 (as light as possible) or a mass in grams.");
  require(
      options.foot != FootCut::Given || (finite(options.footDepth) && options.footDepth > 0.0),
      "foot is Given: foot_depth must be a length greater than 0, how much of the model's lowest "
      "part is cut off; or set foot to Automatic.");
  require(options.tippingAngle >= 0.0 && options.tippingAngle < 90.0,
          "tipping_angle must be 0 (as hard to tip over as possible) or an angle below 90 degrees; "
          "10 suits most models.");
  constexpr double kSteepest = 80.0;
  require(options.overhangAngle >= 0.0 && options.overhangAngle <= kSteepest,
          "overhang_angle must be 0 (the cavity's ceiling may be flat) or an angle up to 80 "
          "degrees; 45 suits most printers.");
}

void requireSensibleHoles(const Options& options, double diagonal) {
  constexpr int kMost = 8;
  constexpr double kLeastDiameter = 1.0;
  require(options.drainHoles >= 0 && options.drainHoles <= kMost,
          "drain_holes is the least number of holes for each cavity: give 0 (none are drilled) to "
          "8; 2 suits most models.");
  if (options.drainHoles == 0) return;
  require(finite(options.drainDiameter) && options.drainDiameter >= kLeastDiameter,
          "drain_diameter must be at least 1 mm, for there is a plug in it that needs a clearance; "
          "resin and powder need 3.5.");
  require(options.drainDiameter < 0.5 * diagonal,
          "drain_diameter is more than half of the model's diagonal: lower it. It is in "
          "millimetres, as the model should be.");
}

} // namespace

void requireSensible(const Options& options, double diagonal) {
  require(options.basisSize >= 1, "basis_k is " + std::to_string(options.basisSize) +
                                      ": give at least 1; 36 suits most models.");
  for (const std::optional<double>& radius : {options.radiusX, options.radiusY}) {
    require(!radius || (finite(*radius) && *radius > 0.0),
            "radius_x and radius_y must be positive, or 0 to take them from the model.");
  }
  require(options.radiusX.has_value() == options.radiusY.has_value(),
          "Give both radius_x and radius_y, or leave both 0 to take them from the model.");
  require(!options.innerLowerBound ||
              (finite(*options.innerLowerBound) && *options.innerLowerBound > 0.0),
          "inner_lower_bound, the minimum wall, must be greater than 0.");
  require(finite(options.innerUpperBound) && options.innerUpperBound > 0.0 &&
              options.innerUpperBound <= 1.0,
          "inner_upper_bound is a factor on the distance to the skeleton: give a value above 0 and "
          "at most 1.");
  require(!options.innerLowerBound || *options.innerLowerBound < options.innerUpperBound * diagonal,
          "inner_lower_bound lies above inner_upper_bound for every point of this model: lower the "
          "minimum wall.");
  require(finite(options.outerLowerBound) && finite(options.outerUpperBound) &&
              options.outerLowerBound >= 0.0 && options.outerUpperBound >= 0.0,
          "outer_lower_bound and outer_upper_bound must be 0 or positive: the outer surface only "
          "moves outwards.");
  require(options.outerLowerBound <= options.outerUpperBound,
          "outer_lower_bound is greater than outer_upper_bound: swap them.");
  require(options.outerUpperBound <= 0.5 * diagonal,
          "outer_upper_bound is more than half of the model's diagonal: lower it.");
  require(!options.solidDepth || (finite(*options.solidDepth) && *options.solidDepth > 0.0),
          "solid_depth must be a length, or 0 for four walls.");
  const Weights& w = options.weights;
  for (const double weight :
       {w.volume, w.centerOfMass, w.inertia, w.smoothness, w.constraints, w.outer}) {
    require(finite(weight) && weight >= 0.0, "opt_weight_1 to opt_weight_6 must be 0 or positive.");
  }
  requireSensibleWishes(options);
  requireSensibleHoles(options, diagonal);
}

double contentsDensity(const Options& options) {
  return options.fillDensity + options.cavityInfill * options.density;
}

UpAxis buildAxisOf(const Options& options) {
  if (options.buildAxis == BuildAxis::AsUsed) return options.upAxis;
  return static_cast<UpAxis>(static_cast<int>(options.buildAxis) - 1);
}

} // namespace massprops
