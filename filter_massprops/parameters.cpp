#include "filter_massprops/parameters.h"

#include "core/goals/registry.h"

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

QString goalMeaning() {
  std::string meaning = "What the model shall do once it is printed.";
  for (const GoalEntry& goal : goalRegistry()) {
    meaning += " " + goal.name + ": " + goal.promise + ".";
  }
  return QString::fromStdString(meaning);
}

QStringList shapeNames() {
  return {"Automatic", "Offset surface", "Best possible"};
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

// What is asked for, then what it is made of, then what only some goals need, then how it is
// searched. The help of MeshLab 2020.09 shows about two lines of a tooltip: the meaning comes
// first.
RichParameterList dialogParameters(double diagonal) {
  const Options defaults;
  const auto range = static_cast<float>(diagonal);
  RichParameterList list;
  const auto addNumber = [&](const char* name, double value, const char* label,
                             const char* meaning) {
    list.addParam(RichFloat(name, static_cast<float>(value), label, meaning));
  };
  const auto addLength = [&](const char* name, double value, const char* label,
                             const char* meaning) {
    list.addParam(RichLength(name, static_cast<float>(value), 0.0F, range, label, meaning));
  };

  list.addParam(
      RichEnum("goal", static_cast<int>(defaults.goal), goalEntries(), "Goal", goalMeaning()));
  list.addParam(RichEnum("up_axis", static_cast<int>(defaults.upAxis), axisNames(), "Up axis",
                         "Axis of the scene that points up when the print is used."));
  list.addParam(RichEnum("cavity_shape", static_cast<int>(defaults.cavityShape), shapeNames(),
                         "Cavity",
                         "Offset surface: the outer surface moved inwards. Best possible: all "
                         "that the wall leaves on one side of the best plane or quadric. "
                         "Automatic: the offset surface, and the best possible one where that "
                         "misses the goal or leaves more than 3 % of what is possible."));
  addLength("inner_lower_bound", 0.01F * range, "Minimum wall [mm]",
            "Least distance of the cavity from the outer surface, in model units (read as mm) or "
            "percent of the bounding-box diagonal. Parts too thin for it stay solid.");
  addNumber("density", defaults.density, "Density [g/cm\u00b3]",
            "Of the material, model units read as mm. 1.24 is PLA.");
  addNumber("fill_density", defaults.fillDensity, "Filling [g/cm\u00b3]",
            "Density of what fills the cavity: 0 is air, 1 is water. Stand empty and filled needs "
            "it.");

  addNumber("radius_x", 0.0, "Contact radius x [mm]",
            "Half axis of an elliptic contact area along the first horizontal axis (x when z is "
            "up), in model units. 0: the area is taken from the ground contacts.");
  addNumber("radius_y", 0.0, "Contact radius y [mm]",
            "Half axis of an elliptic contact area along the second horizontal axis (y when z is "
            "up), in model units. 0: the area is taken from the ground contacts.");
  addNumber("tipping_angle", defaults.tippingAngle, "Tipping angle (Stand) [\u00b0]",
            "The angle by which it shall be possible to tilt the model before it falls over, with "
            "the least material. 0: as large an angle as possible.");
  list.addParam(RichBool("use_pivot", false, "Use the pivot (Spin, Yo-yo, Hang)",
                         "Whether pivot_x, pivot_y and pivot_z count. Otherwise Spin takes the "
                         "centre of the ground contact, Yo-yo the point above it at half the "
                         "height, and Hang the topmost point."));
  const char* const pivot =
      "Coordinate in the scene of the point the model turns about. Spin: any point of the axis. "
      "Yo-yo: the middle of the axle. Hang: the point it hangs from. Only with use_pivot.";
  addNumber("pivot_x", 0.0, "Pivot x [mm]", pivot);
  addNumber("pivot_y", 0.0, "Pivot y [mm]", pivot);
  addNumber("pivot_z", 0.0, "Pivot z [mm]", pivot);
  addNumber("spin_speed", defaults.spinSpeed, "Spin speed (Spin) [rpm]",
            "How fast a hand spins the top: it must stay upright at this speed and a little below. "
            "Thumb and finger on a stem reach 1000, a string a multiple of it.");
  addNumber("water_level", defaults.waterLevel, "Waterline (Float)",
            "How deep it shall lie in the water, as a share of its height: above 0, and 1 is "
            "neutral under water.");
  addNumber("water_density", defaults.waterDensity, "Water (Float) [g/cm\u00b3]",
            "Density of the liquid it floats in: 1 is fresh water, 1.025 the sea.");
  addNumber("target_mass", defaults.targetMass, "Target mass (Mass) [g]",
            "Mass that it shall have, filling included, model units read as mm. 0: as light as "
            "possible.");

  addNumber("inner_upper_bound", defaults.innerUpperBound, "Greatest inner offset",
            "Greatest depth of the cavity's surface, as a fraction between 0 and 1 of the way from "
            "the outer surface to the skeleton.");
  addLength("outer_lower_bound", defaults.outerLowerBound, "Least outer offset [mm]",
            "Least outward displacement of the outer surface, in model units or percent of the "
            "diagonal. The outer surface stays when both are 0.");
  addLength("outer_upper_bound", defaults.outerUpperBound, "Greatest outer offset [mm]",
            "Greatest outward displacement of the outer surface, in model units or percent of the "
            "diagonal. The outer surface stays when both are 0.");
  list.addParam(RichInt("basis_k", defaults.basisSize, "Basis functions",
                        "Number of harmonic functions that shape the cavity, at least 1 and less "
                        "than the number of vertices. More give finer detail and take longer."));
  const Weights& weights = defaults.weights;
  addWeight(list, "opt_weight_1", weights.volume, "Weight 1: volume",
            "Of the material's volume relative to the solid's.");
  addWeight(list, "opt_weight_2", weights.centerOfMass, "Weight 2: centre of mass",
            "Of the goal's terms in mass and centre of mass: low, and over the contact area.");
  addWeight(list, "opt_weight_3", weights.inertia, "Weight 3: moments of inertia",
            "Of the goal's terms in the moments of inertia (Spin, Yo-yo).");
  addWeight(list, "opt_weight_4", weights.smoothness, "Weight 4: smoothness",
            "Of the smoothness of the offsets over the surface.");
  addWeight(list, "opt_weight_5", weights.constraints, "Weight 5: constraints",
            "Of the squared violation of the goal's constraints; 0 also lifts the constraints "
            "themselves.");
  addWeight(list, "opt_weight_6", weights.outer, "Weight 6: outer displacement",
            "Of the mean squared displacement of the outer surface.");
  list.addParam(
      RichBool("open_surface", defaults.openSurface, "Open surface as a shell",
               "Takes a surface with openings (a vase, a tube) as the outside of a shell: "
               "the new layer is its inside, joined to it by a strip along every opening. "
               "Otherwise such a surface is refused."));
  list.addParam(RichBool("mend", defaults.mend, "Mend defects",
                         "Closes holes, parts non-manifold edges, removes crossings, unites "
                         "overlapping bodies and wraps what is left, in a copy: the outer surface "
                         "as it was mended is a layer of its own. Otherwise such a model is "
                         "refused."));
  list.addParam(RichBool("keep_selected_solid", false, "Keep selected faces solid",
                         "No point of the cavity comes nearer to a selected face than solid_depth: "
                         "around screw holes and joints, say."));
  addLength("solid_depth", 0.0, "Solid depth [mm]",
            "How far from the selected faces all stays solid, in model units or percent of the "
            "diagonal; only with keep_selected_solid. 0: four times the minimum wall.");
  list.addParam(RichBool("show_layers", defaults.showAnswer, "Show the answer (more layers)",
                         "Adds a layer with the model cut open along the vertical plane through "
                         "its centre of mass, one with the centre of mass before (red) and "
                         "after (green) and what it is judged by: contact area (Stand, Stand empty "
                         "and filled, Roll upright), axis (Spin, Yo-yo), waterline (Float) or "
                         "plumb line (Hang), and one, hidden at first, with the skeleton and the "
                         "points of it that the surface shrinks to."));
  return list;
}

Options optionsFrom(const RichParameterList& parameters) {
  Options options;
  options.goal = static_cast<GoalKind>(entry(parameters, "goal", goalEntries()));
  options.cavityShape = static_cast<CavityShape>(entry(parameters, "cavity_shape", shapeNames()));
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
  options.spinSpeed = number(parameters, "spin_speed");
  options.waterLevel = number(parameters, "water_level");
  options.waterDensity = number(parameters, "water_density");
  options.targetMass = number(parameters, "target_mass");
  options.tippingAngle = number(parameters, "tipping_angle");
  options.openSurface = parameters.getBool("open_surface");
  options.mend = parameters.getBool("mend");
  options.solidDepth = unlessZero(length(parameters, "solid_depth"));
  options.showAnswer = parameters.getBool("show_layers");
  return options;
}

} // namespace massprops
