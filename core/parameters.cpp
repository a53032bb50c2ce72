#include "core/parameters.h"

#include "core/goals/registry.h"

#include <algorithm>
#include <type_traits>
#include <utility>

namespace massprops {
namespace {

using Rows = std::vector<Parameter>;
using Setter = std::function<void(Options&, const ParameterValue&)>;

template <class Value>
Setter to(Value Options::*field) {
  return [field](Options& options, const ParameterValue& value) {
    options.*field = std::get<Value>(value);
  };
}

/// 0 is what the model itself suggests.
Setter to(std::optional<double> Options::*field) {
  return [field](Options& options, const ParameterValue& value) {
    const double given = std::get<double>(value);
    options.*field = given == 0.0 ? std::nullopt : std::optional(given);
  };
}

Parameter onOff(const char* name, const char* label, bool Options::*field, const char* help) {
  return {name, ParameterKind::Switch, Options{}.*field, label, "", help, {}, to(field)};
}

template <class Field>
Parameter number(const char* name, const char* label, const char* unit, Field Options::*field,
                 const char* help, ParameterKind kind = ParameterKind::Number) {
  double standard = 0.0;
  if constexpr (std::is_same_v<Field, double>) standard = Options{}.*field;
  return {name, kind, standard, label, unit, help, {}, to(field)};
}

Parameter share(const char* name, const char* label, double Options::*field, const char* help) {
  return number(name, label, "", field, help, ParameterKind::Share);
}

template <class Field>
Parameter length(const char* name, const char* label, Field Options::*field, const char* help) {
  return number(name, label, "mm", field, help, ParameterKind::Length);
}

template <class Enum>
Parameter choice(const char* name, const char* label, Enum Options::*field,
                 std::vector<std::string> entries, std::string help) {
  const auto set = [field](Options& options, const ParameterValue& value) {
    options.*field = static_cast<Enum>(std::get<int>(value));
  };
  const int standard = static_cast<int>(Options{}.*field);
  return {name, ParameterKind::Choice, standard,           label,
          "",   std::move(help),       std::move(entries), set};
}

Parameter weight(const char* name, const char* label, double Weights::*field, const char* help) {
  const auto set = [field](Options& options, const ParameterValue& value) {
    options.weights.*field = std::get<double>(value);
  };
  return {name,
          ParameterKind::Number,
          Weights{}.*field,
          label,
          "",
          std::string(help) + " Dimensionless; 0 switches the term off.",
          {},
          set};
}

/// Whether the pivot counts comes before its coordinates.
Parameter usePivot() {
  return {"use_pivot",
          ParameterKind::Switch,
          false,
          "Use the pivot (Spin, Yo-yo, Hang)",
          "",
          "Whether pivot_x, pivot_y and pivot_z count. Otherwise Spin takes the centre of the "
          "ground contact, Yo-yo the point above it at half the height, and Hang the topmost "
          "point.",
          {},
          [](Options& options, const ParameterValue& value) {
            if (std::get<bool>(value)) options.pivot = Vec3::Zero();
          }};
}

Parameter pivotCoordinate(const char* name, const char* label, int axis) {
  return {name,
          ParameterKind::Number,
          0.0,
          label,
          "mm",
          "Coordinate in the scene of the point the model turns about. Spin: any point of the "
          "axis. Yo-yo: the middle of the axle. Hang: the point it hangs from. Only with "
          "use_pivot.",
          {},
          [axis](Options& options, const ParameterValue& value) {
            if (options.pivot) (*options.pivot)[axis] = std::get<double>(value);
          }};
}

std::string goalHelp() {
  std::string help = "What the model shall do once it is printed.";
  for (const GoalEntry& goal : goalRegistry()) help += " " + goal.name + ": " + goal.promise + ".";
  return help;
}

Parameter of(const std::vector<GoalKind>& goals, Parameter row) {
  row.goals = goals;
  return row;
}

Parameter startingAt(double shareOfDiagonal, Parameter row) {
  row.standard = shareOfDiagonal;
  return row;
}

Rows generalRows() {
  return {
      choice("goal", "Goal", &Options::goal, goalNames(), goalHelp()),
      choice("up_axis", "Up axis", &Options::upAxis, {"+Z", "+Y", "+X", "-Z", "-Y", "-X"},
             "Axis of the scene that points up when the print is used."),
      choice(
          "cavity_shape", "Cavity", &Options::cavityShape,
          {"Automatic", "Offset surface", "Best possible"},
          "Offset surface: the outer surface moved inwards. Best possible: all that the wall "
          "leaves on one side of the best plane or quadric. Automatic: the best possible one of a "
          "closed surface that stays; the offset surface where the surface is open or the outer "
          "one moves."),
      startingAt(0.01, length("inner_lower_bound", "Minimum wall", &Options::innerLowerBound,
                              "Least distance of the cavity from the outer surface, in model units "
                              "(read as mm) or percent of the bounding-box diagonal. Parts too "
                              "thin for it stay solid.")),
      number("density", "Density", "g/cm\u00b3", &Options::density,
             "Of the material, model units read as mm. 1.24 is PLA."),
      number("fill_density", "Filling", "g/cm\u00b3", &Options::fillDensity,
             "Density of what fills the cavity: 0 is air, 1 is water. Stand empty and filled needs "
             "it."),
      share("cavity_infill", "Infill of the cavity", &Options::cavityInfill,
            "The cavity is printed as sparse infill of this share of the material, which carries "
            "its ceiling, instead of left empty: 0.1 is 10 %."),
  };
}

Rows goalRows() {
  const std::vector<GoalKind> onGround = {GoalKind::Stand, GoalKind::StandEmptyAndFilled,
                                          GoalKind::RollUpright, GoalKind::PublishedStand};
  const std::vector<GoalKind> standing = {GoalKind::Stand, GoalKind::StandEmptyAndFilled,
                                          GoalKind::PublishedStand};
  const std::vector<GoalKind> withPivot = {GoalKind::Spin, GoalKind::YoYo, GoalKind::Hang};
  return {
      of(onGround,
         number("radius_x", "Contact radius x", "mm", &Options::radiusX,
                "Half axis of an elliptic contact area along the first horizontal axis (x when z "
                "is up), in model units. 0: the area is taken from the ground contacts.")),
      of(onGround,
         number("radius_y", "Contact radius y", "mm", &Options::radiusY,
                "Half axis of an elliptic contact area along the second horizontal axis (y when z "
                "is up), in model units. 0: the area is taken from the ground contacts.")),
      of(standing, choice("foot", "Foot (Stand)", &Options::foot, {"Automatic", "Never", "Given"},
                          "Automatic: a model that touches the ground in a point, along a line or "
                          "on too little is cut flat, at most 1 % of its height above its lowest "
                          "point. Never: it stays. Given: by foot_depth. With radius_x and "
                          "radius_y nothing is cut. Stand, Stand (published), Stand empty and "
                          "filled.")),
      of(standing,
         length("foot_depth", "Foot depth", &Options::footDepth,
                "How far above its lowest point the model is cut flat, in model units or percent "
                "of the diagonal; only where foot is Given.")),
      of({GoalKind::Stand},
         number("tipping_angle", "Tipping angle (Stand)", "\u00b0", &Options::tippingAngle,
                "The angle by which it shall be possible to tilt the model before it falls over, "
                "with the least material. 0: as large an angle as possible.")),
      of(withPivot, usePivot()),
      of(withPivot, pivotCoordinate("pivot_x", "Pivot x", 0)),
      of(withPivot, pivotCoordinate("pivot_y", "Pivot y", 1)),
      of(withPivot, pivotCoordinate("pivot_z", "Pivot z", 2)),
      of({GoalKind::Spin},
         number("spin_speed", "Spin speed (Spin)", "rpm", &Options::spinSpeed,
                "How fast a hand spins the top: it must stay upright at this speed and a little "
                "below. Thumb and finger on a stem reach 1000, a string a multiple of it.")),
      of({GoalKind::Float},
         share("water_level", "Waterline (Float)", &Options::waterLevel,
               "How deep it shall lie in the water, as a share of its height: above 0, and 1 is "
               "neutral under water.")),
      of({GoalKind::Float},
         number("water_density", "Water (Float)", "g/cm\u00b3", &Options::waterDensity,
                "Density of the liquid it floats in: 1 is fresh water, 1.025 the sea.")),
      of({GoalKind::Mass},
         number("target_mass", "Target mass (Mass)", "g", &Options::targetMass,
                "Mass that it shall have, filling included, model units read as mm. 0: as light as "
                "possible.")),
  };
}

Rows modelRows() {
  return {
      onOff("open_surface", "Open surface as a shell", &Options::openSurface,
            "Takes a surface with openings (a vase, a tube) as the outside of a shell: the new "
            "layer is its inside, joined to it by a strip along every opening. Otherwise such a "
            "surface is refused."),
      onOff("mend", "Mend defects", &Options::mend,
            "Closes holes, parts non-manifold edges, removes crossings, unites overlapping bodies "
            "and wraps what is left, in a copy: the outer surface as it was mended is a layer of "
            "its own. Otherwise such a model is refused."),
      {"keep_selected_solid",
       ParameterKind::Switch,
       false,
       "Keep selected faces solid",
       "",
       "No point of the cavity comes nearer to a selected face than solid_depth: around screw "
       "holes and joints, say.",
       {},
       {}},
      length("solid_depth", "Solid depth", &Options::solidDepth,
             "How far from the selected faces all stays solid, in model units or percent of the "
             "diagonal; only with keep_selected_solid. 0: four times the minimum wall."),
  };
}

Rows resultRows() {
  return {
      onOff("show_layers", "Show the answer (more layers)", &Options::showAnswer,
            "Adds a layer with the model cut open along the vertical plane through its centre of "
            "mass, one with the centre of mass before (red) and after (green) and what it is "
            "judged by: contact area (Stand, Stand empty and filled, Roll upright), axis (Spin, "
            "Yo-yo), waterline (Float) or plumb line (Hang), and one, hidden at first, with the "
            "skeleton and the points of it that the surface shrinks to."),
  };
}

Rows printRows() {
  return {
      choice("build_axis", "Build axis", &Options::buildAxis,
             {"As used", "+Z", "+Y", "+X", "-Z", "-Y", "-X"},
             "Axis of the scene that points up in the printer. As used: the up axis."),
      {"drain_holes",
       ParameterKind::Whole,
       Options{}.drainHoles,
       "Drain holes",
       "",
       "Least number of holes through the wall for each cavity, for resin and powder: the first at "
       "its lowest point, the second at its highest. The drilled body and plugs for the holes are "
       "layers of their own. 0: none are drilled.",
       {},
       to(&Options::drainHoles)},
      number("drain_diameter", "Drain hole diameter", "mm", &Options::drainDiameter,
             "Of the narrowest part of a hole, model units read as mm. Guides for resin and powder "
             "ask for 3.5."),
      number("overhang_angle", "Overhang angle", "\u00b0", &Options::overhangAngle,
             "The cavity's ceiling is nowhere flatter than this against the horizontal in the "
             "printer, so that it prints without support: 45 is usual. 0: as flat as it comes."),
      {"print_file",
       ParameterKind::File,
       std::string(),
       "Project for the slicer",
       "",
       "A 3MF project is written here: the body, its cavity as a part of its own where it has "
       "infill, the settings that make the print weigh what was calculated, and the report. "
       "PrusaSlicer opens it. Empty: none.",
       {"*.3mf"},
       to(&Options::printFile)},
  };
}

Rows searchRows() {
  return {
      share("inner_upper_bound", "Greatest inner offset", &Options::innerUpperBound,
            "Greatest depth of the cavity's surface, as a fraction between 0 and 1 of the way from "
            "the outer surface to the skeleton."),
      length("outer_lower_bound", "Least outer offset", &Options::outerLowerBound,
             "Least outward displacement of the outer surface, in model units or percent of the "
             "diagonal. The outer surface stays when both are 0."),
      length("outer_upper_bound", "Greatest outer offset", &Options::outerUpperBound,
             "Greatest outward displacement of the outer surface, in model units or percent of the "
             "diagonal. The outer surface stays when both are 0."),
      {"basis_k",
       ParameterKind::Whole,
       Options{}.basisSize,
       "Basis functions",
       "",
       "Number of harmonic functions that shape the cavity, at least 1 and less than the number of "
       "vertices. More give finer detail and take longer.",
       {},
       to(&Options::basisSize)},
      weight("opt_weight_1", "Weight 1: volume", &Weights::volume,
             "Of the material's volume relative to the solid's."),
      weight("opt_weight_2", "Weight 2: centre of mass", &Weights::centerOfMass,
             "Of the goal's terms in mass and centre of mass: low, and over the contact area."),
      of({GoalKind::Spin, GoalKind::YoYo},
         weight("opt_weight_3", "Weight 3: moments of inertia", &Weights::inertia,
                "Of the goal's terms in the moments of inertia (Spin, Yo-yo).")),
      weight("opt_weight_4", "Weight 4: smoothness", &Weights::smoothness,
             "Of the smoothness of the offsets over the surface."),
      weight("opt_weight_5", "Weight 5: constraints", &Weights::constraints,
             "Of the squared violation of the goal's constraints; 0 also lifts the constraints "
             "themselves."),
      weight("opt_weight_6", "Weight 6: outer displacement", &Weights::outer,
             "Of the mean squared displacement of the outer surface."),
  };
}

void append(Rows& table, Rows rows, const char* category, bool advanced = false) {
  for (Parameter& row : rows) {
    row.category = category;
    row.advanced = advanced;
    table.push_back(std::move(row));
  }
}

Rows allRows() {
  Rows table;
  append(table, generalRows(), "");
  append(table, goalRows(), "Goal");
  append(table, modelRows(), "Model");
  append(table, printRows(), "Print");
  append(table, resultRows(), "Result");
  append(table, searchRows(), "Search", true);
  return table;
}

void requireEntry(const Parameter& parameter, int value) {
  const auto count = static_cast<int>(parameter.entries.size());
  if (value >= 0 && value < count) return;
  throw InvalidInput("The parameter '" + parameter.name + "' is entry " + std::to_string(value) +
                     ", but its list has the entries 0 to " + std::to_string(count - 1) + ".");
}

} // namespace

const std::vector<Parameter>& parameterTable() {
  static const Rows table = allRows();
  return table;
}

std::string fullLabel(const Parameter& parameter) {
  return parameter.unit.empty() ? parameter.label : parameter.label + " [" + parameter.unit + "]";
}

Options optionsFrom(const ParameterSource& valueOf) {
  Options options;
  for (const Parameter& parameter : parameterTable()) {
    const std::optional<ParameterValue> value = valueOf(parameter);
    if (!value) continue;
    if (parameter.kind == ParameterKind::Choice) requireEntry(parameter, std::get<int>(*value));
    if (parameter.set) parameter.set(options, *value);
  }
  return options;
}

} // namespace massprops
