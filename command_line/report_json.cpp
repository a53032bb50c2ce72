#include "command_line/report_json.h"

#include "core/goals/registry.h"
#include "core/parameters.h"

#include <nlohmann/json.hpp>

namespace massprops {
namespace {

using Json = nlohmann::ordered_json;

struct ToJson {
  template <class Plain>
  Json operator()(const Plain& value) const {
    return value;
  }
  Json operator()(const Vec3& value) const { return {value.x(), value.y(), value.z()}; }
  Json operator()(const Mat3& value) const {
    Json rows = Json::array();
    for (int row = 0; row < 3; ++row) rows.push_back((*this)(Vec3(value.row(row))));
    return rows;
  }
};

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
  row[standard] = std::visit(ToJson{}, parameter.standard);
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

std::string text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

} // namespace

std::string toJson(const Report& report) {
  Json object = Json::object();
  for (const auto& [key, value] : report.entries) object[key] = std::visit(ToJson{}, value);
  return text(object);
}

std::string parametersAsJson() {
  Json rows = Json::array();
  for (const Parameter& parameter : parameterTable()) rows.push_back(described(parameter));
  return text(rows);
}

} // namespace massprops
