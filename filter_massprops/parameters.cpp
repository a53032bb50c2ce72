#include "filter_massprops/parameters.h"

#include <array>
#include <charconv>
#include <cmath>

namespace massprops {
namespace {

QStringList goalEntries() {
  QStringList entries;
  for (const std::string& name : goalNames()) entries.append(QString::fromStdString(name));
  return entries;
}

QStringList axisNames() {
  return {"+Z", "+Y", "+X", "-Z", "-Y", "-X"};
}

/// The decimal number that was typed: hosts keep parameters in single precision, where 1.24 becomes
/// 1.2400000095, even if they hand it over in double precision.
double asTyped(double value) {
  const auto single = static_cast<float>(value);
  if (!std::isfinite(single) || static_cast<double>(single) != value) return value;
  std::array<char, 64> text{};
  char* const end = std::to_chars(text.data(), text.data() + text.size(), single).ptr;
  double result = 0.0;
  std::from_chars(text.data(), end, result);
  return result;
}

double number(const RichParameterList& parameters, const char* name) {
  return asTyped(static_cast<double>(parameters.getFloat(name)));
}

double length(const RichParameterList& parameters, const char* name) {
  return asTyped(static_cast<double>(parameters.getAbsPerc(name)));
}

std::optional<double> unlessZero(double value) {
  return value == 0.0 ? std::nullopt : std::optional(value);
}

int entry(const RichParameterList& parameters, const char* name, const QStringList& list) {
  const int value = parameters.getEnum(name);
  if (value < 0 || value >= list.size()) {
    throw InvalidInput(std::string("The parameter '") + name + "' is entry " +
                       std::to_string(value) + ", but its list has the entries 0 to " +
                       std::to_string(list.size() - 1) + ".");
  }
  return value;
}

void addWeight(RichParameterList& list, const char* name, double value, const char* label,
               const char* meaning) {
  list.addParam(RichFloat(name, static_cast<float>(value), label,
                          QString(meaning) + " Dimensionless; 0 switches the term off."));
}

} // namespace

RichParameterList dialogParameters(double diagonal) {
  const Options defaults;
  const auto range = static_cast<float>(diagonal);
  RichParameterList list;
  list.addParam(RichEnum("goal", static_cast<int>(defaults.goal), goalEntries(), "Goal",
                         "What the model shall do once it is printed. Stand: it stands on its "
                         "ground contacts, as hard to tip over as possible. Spin: it spins as a "
                         "top about the vertical axis through its lowest point. Yo-yo: it spins "
                         "about its vertical axle, balanced on both sides. Stand empty and filled: "
                         "it stands with its cavity empty and with it filled. Roll upright: it "
                         "comes back upright from every position, like a tumbler. Float: it floats "
                         "upright at the given waterline. Hang: it hangs upright from its topmost "
                         "point or a given one. Mass: it weighs as much as is asked for."));
  list.addParam(RichInt("basis_k", defaults.basisSize, "Basis functions",
                        "Number of harmonic functions that describe the cavity, at least 1 and "
                        "less than the number of vertices. More of them shape the cavity in finer "
                        "detail and take longer."));
  list.addParam(RichFloat("radius_x", 0.0F, "Contact radius x",
                          "Half axis of the elliptic contact area along the first horizontal axis "
                          "(x when z is up), in model units. 0: taken from the model's ground "
                          "contacts."));
  list.addParam(RichFloat("radius_y", 0.0F, "Contact radius y",
                          "Half axis of the elliptic contact area along the second horizontal axis "
                          "(y when z is up), in model units. 0: taken from the model's ground "
                          "contacts."));
  list.addParam(RichLength("inner_lower_bound", 0.01F * range, 0.0F, range,
                           "Minimum wall thickness",
                           "Least distance of the cavity from the outer surface, in model units "
                           "(read as mm) or percent of the bounding-box diagonal. Parts that are "
                           "too thin for it stay solid."));
  list.addParam(RichFloat("inner_upper_bound", static_cast<float>(defaults.innerUpperBound),
                          "Greatest inner offset",
                          "Greatest offset of the cavity's surface, as a fraction between 0 and 1 "
                          "of the distance from the outer surface to the skeleton."));
  list.addParam(RichLength("outer_lower_bound", static_cast<float>(defaults.outerLowerBound), 0.0F,
                           range, "Least outer offset",
                           "Least outward displacement of the outer surface, in model units (read "
                           "as mm) or percent of the bounding-box diagonal. The outer surface "
                           "stays when both outer offsets are 0."));
  list.addParam(RichLength("outer_upper_bound", static_cast<float>(defaults.outerUpperBound), 0.0F,
                           range, "Greatest outer offset",
                           "Greatest outward displacement of the outer surface, in model units "
                           "(read as mm) or percent of the bounding-box diagonal. The outer "
                           "surface stays when both outer offsets are 0."));
  const Weights& weights = defaults.weights;
  addWeight(list, "opt_weight_1", weights.volume, "Weight 1: volume",
            "Weight of the material's volume relative to the solid's.");
  addWeight(
      list, "opt_weight_2", weights.centerOfMass, "Weight 2: centre of mass",
      "Weight of the goal's terms in mass and centre of mass: low, and over the contact area.");
  addWeight(list, "opt_weight_3", weights.inertia, "Weight 3: moments of inertia",
            "Weight of the goal's terms in the moments of inertia (Spin, Yo-yo).");
  addWeight(list, "opt_weight_4", weights.smoothness, "Weight 4: smoothness",
            "Weight of the smoothness of the offsets over the surface.");
  addWeight(list, "opt_weight_5", weights.constraints, "Weight 5: constraints",
            "Weight of the squared violation of the goal's constraints; 0 also lifts the "
            "constraints themselves.");
  addWeight(list, "opt_weight_6", weights.outer, "Weight 6: outer displacement",
            "Weight of the mean squared displacement of the outer surface.");
  list.addParam(RichEnum("up_axis", static_cast<int>(defaults.upAxis), axisNames(), "Up axis",
                         "Axis of the scene that points up when the print stands or spins."));
  list.addParam(RichFloat("density", static_cast<float>(defaults.density), "Density",
                          "Density of the material in g/cm\u00b3, model units read as mm. 1.24 is "
                          "PLA."));
  list.addParam(RichFloat("fill_density", static_cast<float>(defaults.fillDensity),
                          "Density of the filling",
                          "Density of what fills the cavity in g/cm\u00b3, model units read as mm. "
                          "0 is air, 1 is water. Stand empty and filled needs it."));
  list.addParam(RichBool("use_pivot", false, "Use the pivot",
                         "Whether pivot_x, pivot_y and pivot_z are given. Otherwise Spin takes the "
                         "centre of the ground contact, Yo-yo the point above it at half the "
                         "height, and Hang the topmost point. For Spin, Yo-yo and Hang; other "
                         "goals ignore it."));
  const auto addCoordinate = [&](const char* name, const char* label) {
    list.addParam(RichFloat(name, 0.0F, label,
                            "Coordinate in the scene of the point the model turns about. Spin: any "
                            "point of the axis. Yo-yo: the middle of the axle. Hang: the point it "
                            "hangs from. Counts for these goals only, and only with use_pivot."));
  };
  addCoordinate("pivot_x", "Pivot x");
  addCoordinate("pivot_y", "Pivot y");
  addCoordinate("pivot_z", "Pivot z");
  list.addParam(RichFloat("water_level", static_cast<float>(defaults.waterLevel), "Waterline",
                          "How deep the model shall lie in the water, as a share of its height: "
                          "above 0, and 1 is neutral under water. For Float only."));
  list.addParam(
      RichFloat("water_density", static_cast<float>(defaults.waterDensity), "Density of the water",
                "Density of the liquid the model floats in, g/cm\u00b3: 1 is fresh water, "
                "1.025 the sea. For Float only."));
  list.addParam(RichFloat("target_mass", static_cast<float>(defaults.targetMass), "Target mass",
                          "Mass that the model shall have, filling included, in grams when model "
                          "units are mm. 0: as light as possible. For Mass only."));
  return list;
}

Options optionsFrom(const RichParameterList& parameters) {
  Options options;
  options.goal = static_cast<GoalKind>(entry(parameters, "goal", goalEntries()));
  options.basisSize = parameters.getInt("basis_k");
  options.radiusX = unlessZero(number(parameters, "radius_x"));
  options.radiusY = unlessZero(number(parameters, "radius_y"));
  options.innerLowerBound = length(parameters, "inner_lower_bound");
  options.innerUpperBound = number(parameters, "inner_upper_bound");
  options.outerLowerBound = length(parameters, "outer_lower_bound");
  options.outerUpperBound = length(parameters, "outer_upper_bound");
  options.weights.volume = number(parameters, "opt_weight_1");
  options.weights.centerOfMass = number(parameters, "opt_weight_2");
  options.weights.inertia = number(parameters, "opt_weight_3");
  options.weights.smoothness = number(parameters, "opt_weight_4");
  options.weights.constraints = number(parameters, "opt_weight_5");
  options.weights.outer = number(parameters, "opt_weight_6");
  options.upAxis = static_cast<UpAxis>(entry(parameters, "up_axis", axisNames()));
  options.density = number(parameters, "density");
  options.fillDensity = number(parameters, "fill_density");
  if (parameters.getBool("use_pivot")) {
    options.pivot = Vec3(number(parameters, "pivot_x"), number(parameters, "pivot_y"),
                         number(parameters, "pivot_z"));
  }
  options.waterLevel = number(parameters, "water_level");
  options.waterDensity = number(parameters, "water_density");
  options.targetMass = number(parameters, "target_mass");
  return options;
}

} // namespace massprops
