#include "command_line/description.h"

#include "command_line/arguments.h"
#include "command_line/coming_meshlab.h"
#include "core/goals/registry.h"
#include "core/parameters.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

namespace massprops {
namespace {

using Json = nlohmann::ordered_json;

const char* nameOf(ParameterKind kind) {
  switch (kind) {
  case ParameterKind::Switch:
    return "switch";
  case ParameterKind::Whole:
    return "whole number";
  case ParameterKind::Number:
    return "number";
  case ParameterKind::Share:
    return "share";
  case ParameterKind::Length:
    return "length";
  case ParameterKind::Choice:
    return "choice";
  case ParameterKind::File:
    return "file";
  }
  return "";
}

Json described(const Parameter& parameter) {
  Json row;
  row["name"] = parameter.name;
  row["kind"] = nameOf(parameter.kind);
  const char* const standard =
      parameter.kind == ParameterKind::Length ? "default_share_of_diagonal" : "default";
  row[standard] = std::visit([](const auto& value) -> Json { return value; }, parameter.standard);
  row["label"] = parameter.label;
  row["unit"] = parameter.unit;
  row["help"] = parameter.help;
  row["entries"] = parameter.entries;
  row["goals"] = Json::array();
  for (const GoalKind goal : parameter.goals) row["goals"].push_back(goalEntry(goal).name);
  row["category"] = parameter.category;
  row["advanced"] = parameter.advanced;
  return row;
}

std::string json() {
  Json rows = Json::array();
  for (const Parameter& parameter : parameterTable()) rows.push_back(described(parameter));
  return rows.dump(2) + "\n";
}

/// Text for troff: no hyphen is a sign of its own, no line begins with a request.
std::string escaped(const std::string& text) {
  std::string result;
  bool isLineStart = true;
  for (const char c : text) {
    if (isLineStart && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\' || c == '-') result += '\\';
    result += c;
    isLineStart = c == '\n';
  }
  return result;
}

std::string man() {
  std::ostringstream page;
  page << ".TH MASSPROPS 1 \"\" \"massprops " MASSPROPS_VERSION "\" \"User Commands\"\n"
       << ".SH NAME\nmassprops \\- hollows 3D models so that their prints behave\n"
       << ".SH SYNOPSIS\n.B massprops\n[\\fIOPTION\\fR...] \\fIMODEL\\fR...\n"
       << ".SH DESCRIPTION\n"
       << escaped(programSummary()) << "\n";
  std::string heading;
  for (const OptionHelp& option : programOptions()) {
    if (option.heading != heading) {
      heading = option.heading;
      page << ".SH \"" << escaped(heading) << "\"\n";
    }
    page << ".TP\n\\fB" << escaped(option.names) << "\\fR";
    if (!option.placeholder.empty()) page << " \\fI" << escaped(option.placeholder) << "\\fR";
    page << '\n' << escaped(option.help) << '\n';
  }
  page << ".SH NOTES\n.nf\n" << escaped(programNotes()) << "\n.fi\n";
  return page.str();
}

std::string bash() {
  std::string names;
  std::string files;
  for (const OptionHelp& option : programOptions()) {
    std::string each = option.names;
    std::replace(each.begin(), each.end(), ',', '\n');
    names += each + "\n";
    std::replace(each.begin(), each.end(), '\n', '|');
    if (option.placeholder == "FILE") files += (files.empty() ? "" : "|") + each;
  }
  std::ostringstream script;
  script << "# massprops: bash completes its options, entries and files.\n"
         << "_massprops() {\n  local current=${COMP_WORDS[COMP_CWORD]} words= IFS=$'\\n'\n"
         << "  case ${COMP_WORDS[COMP_CWORD-1]} in\n";
  for (const Parameter& parameter : parameterTable()) {
    if (parameter.kind != ParameterKind::Choice) continue;
    script << "    " << optionOf(parameter.name) << ") words='";
    for (const std::string& entry : parameter.entries) script << entry << '\n';
    script << "' ;;\n";
  }
  script << "    --describe) words=$'json\\nman\\nbash\\nfilters' ;;\n"
         << "    " << files << ") compopt -o default; return ;;\n"
         << "    *) case $current in -*) words='" << names
         << "' ;; *) compopt -o default; return ;; "
         << "esac ;;\n  esac\n"
         << "  COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
         << "  COMPREPLY=(\"${COMPREPLY[@]// /\\\\ }\")\n}\n"
         << "complete -F _massprops massprops\n";
  return script.str();
}

} // namespace

std::string described(const std::string& form) {
  if (form == "man") return man();
  if (form == "filters") return filtersOfComingMeshLab();
  return form == "bash" ? bash() : json();
}

} // namespace massprops
