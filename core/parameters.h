// What a user can set: one table that every dialog, command line, script and description comes
// from.
#pragma once

#include "core/base/options.h"

#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace massprops {

enum class ParameterKind {
  Switch, ///< bool
  Whole,  ///< int
  Number, ///< double
  Share,  ///< double, 0…1
  Length, ///< double, model units; its default is a share of the bounding box's diagonal
  Choice, ///< int, the place in `entries`
  File,   ///< std::string, a path to write to; empty: none
};

using ParameterValue = std::variant<bool, int, double, std::string>;

struct Parameter {
  std::string name; ///< never changes, because scripts name it
  ParameterKind kind;
  ParameterValue standard; ///< the default
  std::string label;       ///< without the unit
  std::string unit;        ///< empty where there is none
  /// The meaning comes first: the help of MeshLab 2020.09 shows about two lines.
  std::string help;
  std::vector<std::string> entries; ///< of a choice; of a file the patterns of its names
  /// Puts a value into the options; hosts themselves act on those of parameters without one.
  std::function<void(Options&, const ParameterValue&)> set;
  std::vector<GoalKind> goals = {}; ///< for which it counts; empty: for all
  /// Heading, empty for what every user looks at; in the alphabet's order, which is the hosts'.
  std::string category = {};
  bool advanced = false; ///< hidden at first where the host can
};

/// In the order in which they are shown: what is asked for and what it is made of, what only some
/// goals need, the model, the result, and how the cavity is searched.
const std::vector<Parameter>& parameterTable();

/// As a dialog shows it, with its unit.
std::string fullLabel(const Parameter& parameter);

/// What was set; nothing keeps the default of `Options`. Throws what it likes.
using ParameterSource = std::function<std::optional<ParameterValue>(const Parameter&)>;

/// \throw InvalidInput for an entry outside of its list
Options optionsFrom(const ParameterSource& valueOf);

} // namespace massprops
