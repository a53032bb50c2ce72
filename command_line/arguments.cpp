#include "command_line/arguments.h"

#include "core/base/report.h"
#include "core/parameters.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>

namespace massprops {
namespace {

const char* const kAbout =
    "Hollows 3D models so that their prints stand, spin, float, hang, roll upright or weigh what\n"
    "they should. Reads and writes STL, PLY, OBJ and OFF.";

const char* const kFooter =
    "Lengths are in the model's units, read as mm, or in % of its diagonal: 1.5%. In the names of\n"
    "files {name} stands for the model's own name. Nothing is written for a model that is "
    "refused.\n"
    "\n"
    "Exit status: 0 all goals reached, 1 a model was hollowed but its goal missed, 2 refused.\n"
    "\n"
    "  massprops model.stl --goal Stand --wall 1.2 -o cavity.ply --solid hollow.stl\n"
    "  massprops models/*.stl --jobs 4 --solid 'hollow/{name}.stl' --report 'hollow/{name}.json'";

/// What stands for a value in the help.
std::string placeholderOf(const Parameter& parameter) {
  switch (parameter.kind) {
  case ParameterKind::Whole:
    return "COUNT";
  case ParameterKind::Length:
    return "LENGTH";
  case ParameterKind::Choice:
    return "ENTRY";
  case ParameterKind::File:
    return "FILE";
  case ParameterKind::Share:
    return "SHARE";
  default:
    return parameter.unit.empty() ? "NUMBER" : parameter.unit;
  }
}

std::string defaultOf(const Parameter& parameter) {
  std::string number = toString(
      std::visit([](const auto& value) -> ReportValue { return value; }, parameter.standard));
  switch (parameter.kind) {
  case ParameterKind::Choice:
    return parameter.entries[static_cast<std::size_t>(std::get<int>(parameter.standard))];
  case ParameterKind::Length: {
    const double share = std::get<double>(parameter.standard);
    return share == 0.0 ? "0" : toString(100.0 * share) + "% of the diagonal";
  }
  default:
    return number;
  }
}

std::string helpOf(const Parameter& parameter) {
  std::string help = parameter.label + ". " + parameter.help;
  if (parameter.kind == ParameterKind::Choice) {
    help += " Entries:";
    for (const std::string& entry : parameter.entries) {
      help += (&entry == &parameter.entries.front() ? " " : ", ") + entry;
    }
    help += ".";
  }
  const bool hasDefault =
      parameter.kind != ParameterKind::Switch && parameter.kind != ParameterKind::File;
  return hasDefault ? help + " Default: " + defaultOf(parameter) + "." : help;
}

void addParameter(CLI::App& app, const Parameter& parameter, Arguments& arguments) {
  const std::string name = optionOf(parameter.name);
  std::string& text = arguments.given[parameter.name];
  CLI::Option* option = nullptr;
  if (parameter.kind == ParameterKind::Switch) {
    const std::string no = "--no-" + name.substr(2);
    option = app.add_flag_callback(
        name, [&text] { text = "true"; }, helpOf(parameter));
    if (std::get<bool>(parameter.standard)) {
      app.remove_option(option);
      option = app.add_flag_callback(
          no, [&text] { text = "false"; }, "Switches off: " + helpOf(parameter));
    }
  } else {
    const char* const shorter = parameter.name == "inner_lower_bound" ? "--wall," : "";
    option = app.add_option(shorter + name, text, helpOf(parameter));
    option->type_name(placeholderOf(parameter));
  }
  const std::string heading = parameter.category.empty() ? "Parameters" : parameter.category;
  option->group(parameter.advanced ? heading + " (advanced)" : heading);
}

/// All options write into `arguments`.
void define(CLI::App& app, Arguments& arguments) {
  app.footer(kFooter);
  app.set_version_flag("--version", std::string("massprops ") + MASSPROPS_VERSION);
  app.add_option("model", arguments.models, "Models to hollow")->type_name("FILE");
  Outputs& outputs = arguments.outputs;
  app.add_option("-o,--cavity", outputs.cavity, "Write the cavity, normals pointing into it")
      ->type_name("FILE");
  app.add_option("--solid", outputs.solid,
                 "Write outer and inner surface together, for the slicer; with drain holes the "
                 "drilled body")
      ->type_name("FILE");
  app.add_option("--plugs", outputs.plugs, "Write the plugs for drain holes")->type_name("FILE");
  app.add_option("--answer", outputs.answer,
                 "Write the model cut open, with its centre of mass before (red) and after (green) "
                 "and what it is judged by; PLY keeps the colours")
      ->type_name("FILE");
  app.add_option("--report", outputs.report, "Write the report as JSON; - is standard output")
      ->type_name("FILE");
  app.add_option("--jobs", arguments.jobs, "How many models at once")
      ->type_name("COUNT")
      ->check(CLI::Range(1, 1024).description(""));
  app.add_flag("--quiet", arguments.quiet, "No line for each model, no progress");
  app.add_option("--describe", arguments.describe,
                 "Instead of a run: all parameters in JSON, the manual's page, what bash completes "
                 "words by, or filters.json of the coming MeshLab")
      ->type_name("json|man|bash|filters")
      ->check(CLI::IsMember({"json", "man", "bash", "filters"}).description(""));
  for (const Parameter& parameter : parameterTable()) {
    // The answer is a file here.
    if (parameter.name != "show_layers") addParameter(app, parameter, arguments);
  }
}

} // namespace

std::string optionOf(const std::string& parameterName) {
  std::string name = "--" + parameterName;
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

std::string programSummary() {
  return kAbout;
}

std::string programNotes() {
  return kFooter;
}

std::vector<OptionHelp> programOptions() {
  Arguments unused;
  CLI::App app;
  define(app, unused);
  std::vector<OptionHelp> options;
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_positional()) continue;
    const bool isSwitch = option->get_expected_max() == 0;
    options.push_back({option->get_name(false, true), isSwitch ? "" : option->get_type_name(),
                       option->get_description(), option->get_group()});
  }
  return options;
}

Arguments parse(int argc, const char* const* argv) {
  Arguments arguments;
  CLI::App app(kAbout, "massprops");
  define(app, arguments);

  try {
    app.parse(argc, argv);
    if (arguments.models.empty() && arguments.describe.empty()) {
      throw CLI::RequiredError("a model");
    }
  } catch (const CLI::ParseError& end) {
    throw ParsedEnd{app.exit(end) == 0 ? 0 : 2};
  }
  for (auto given = arguments.given.begin(); given != arguments.given.end();) {
    given = given->second.empty() ? arguments.given.erase(given) : std::next(given);
  }
  return arguments;
}

} // namespace massprops
