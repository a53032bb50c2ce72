#include "command_line/coming_meshlab.h"

#include "core/parameters.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <stdexcept>

namespace massprops {
namespace {

using Json = nlohmann::ordered_json;

const char* typeOf(ParameterKind kind) {
  switch (kind) {
  case ParameterKind::Switch:
    return "bool";
  case ParameterKind::Whole:
    return "int";
  case ParameterKind::Number:
  case ParameterKind::Share:
    return "double";
  case ParameterKind::Length:
    return "absperc";
  case ParameterKind::Choice:
    return "enum";
  case ParameterKind::File:
    return "filesave";
  }
  return "";
}

/// A section of the form; one whose name begins with `advanced` is hidden at first.
std::string groupOf(const Parameter& parameter) {
  std::string heading = parameter.category.empty() ? "main" : parameter.category;
  std::transform(heading.begin(), heading.end(), heading.begin(),
                 [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return parameter.advanced ? "advanced." + heading : heading;
}

/// There a share of the diagonal has a name.
Json lengthOf(double share) {
  if (share == 0.0) return 0.0;
  if (share == 0.01) return "@bboxDiag01";
  throw std::logic_error("The coming MeshLab has no name for this share of the diagonal.");
}

Json standardOf(const Parameter& parameter) {
  if (parameter.kind == ParameterKind::Length) {
    return lengthOf(std::get<double>(parameter.standard));
  }
  if (parameter.kind == ParameterKind::Choice) {
    return parameter.entries.at(static_cast<std::size_t>(std::get<int>(parameter.standard)));
  }
  return std::visit([](const auto& value) -> Json { return value; }, parameter.standard);
}

Json rowOf(const Parameter& parameter) {
  Json row;
  row["id"] = parameter.name;
  row["label"] = fullLabel(parameter);
  row["help"] = parameter.help;
  row["group"] = groupOf(parameter);
  row["type"] = typeOf(parameter.kind);
  row["default"] = standardOf(parameter);
  if (parameter.kind == ParameterKind::Share || parameter.kind == ParameterKind::Length) {
    row["min"] = 0.0;
    row["max"] = parameter.kind == ParameterKind::Share ? Json(1.0) : Json("@bboxDiag");
  }
  if (parameter.kind == ParameterKind::Choice) {
    row["enumOptions"] = Json::array();
    for (const std::string& entry : parameter.entries) {
      row["enumOptions"].push_back({{"id", entry}, {"label", entry}});
    }
  }
  if (parameter.kind == ParameterKind::File) row["fileNameFilters"] = parameter.entries;
  return row;
}

const char* const kFilter = R"({
  "id": "create_cavity_for_mass_properties",
  "categories": ["Creation"],
  "name": "Create Cavity for Mass Properties",
  "pythonName": "create_cavity_for_mass_properties",
  "shortDescription": "Finds the cavity with which a model stands, spins, floats, hangs or rolls upright once it is printed.",
  "longDescriptionMarkdown": "The cavity is a new layer whose normals point into it, so that it and the model together bound the material. Its vertex scalar is the wall thickness. It is closed, does not cross itself, and keeps the minimum wall.",
  "referenceIds": ["musialski2015reduced"],
  "inputDomain": "SingleMesh",
  "outputDomain": "NewMeshes",
  "outputTag": "cavity",
  "inputRequirements": {"requireVertices": true, "requireFaces": true},
  "outputModifies": ["VG", "FV", "VN", "FN", "VQ"]
})";

const char* const kReferences = R"([{
  "id": "musialski2015reduced",
  "type": "article-journal",
  "title": "Reduced-Order Shape Optimization Using Offset Surfaces",
  "author": [
    {"family": "Musialski", "given": "Przemyslaw"}, {"family": "Auzinger", "given": "Thomas"},
    {"family": "Birsak", "given": "Michael"}, {"family": "Wimmer", "given": "Michael"},
    {"family": "Kobbelt", "given": "Leif"}
  ],
  "container-title": "ACM Transactions on Graphics",
  "volume": "34",
  "issue": "4",
  "issued": {"date-parts": [[2015]]},
  "DOI": "10.1145/2766955"
}])";

} // namespace

std::string filtersOfComingMeshLab() {
  Json filter = Json::parse(kFilter);
  filter["parameters"] = Json::array();
  for (const Parameter& parameter : parameterTable()) {
    filter["parameters"].push_back(rowOf(parameter));
  }
  Json file;
  file["pluginId"] = "meshlab2.filter.massprops";
  file["provenance"] = {{"project", "massprops"}, {"license", "GPL-3.0-or-later"}};
  file["references"] = Json::parse(kReferences);
  file["filters"] = Json::array({filter});
  return file.dump(2) + "\n";
}

} // namespace massprops
