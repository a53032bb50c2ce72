#include "command_line/hollowing.h"

#include "command_line/mesh_files.h"
#include "command_line/output_files.h"
#include "command_line/report_json.h"
#include "core/mesh/components.h"
#include "core/parameter_text.h"
#include "core/parameters.h"

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>

namespace massprops {
namespace {

namespace fs = std::filesystem;

const std::string kPlaceholder = "{name}";

std::vector<std::string> meshFilesOf(const Outputs& outputs) {
  std::vector<std::string> files;
  for (const std::string& file : {outputs.cavity, outputs.solid, outputs.plugs, outputs.answer}) {
    if (!file.empty()) files.push_back(file);
  }
  return files;
}

/// What parameters write, by their names.
std::map<std::string, std::string> parameterFilesOf(const Arguments& arguments) {
  std::map<std::string, std::string> files;
  for (const Parameter& parameter : parameterTable()) {
    const auto given = arguments.given.find(parameter.name);
    if (parameter.kind == ParameterKind::File && given != arguments.given.end())
      files.insert(*given);
  }
  return files;
}

std::vector<std::string> filesOf(const Arguments& arguments) {
  std::vector<std::string> files = meshFilesOf(arguments.outputs);
  const std::string& report = arguments.outputs.report;
  if (!report.empty() && report != "-") files.push_back(report);
  for (const auto& [name, file] : parameterFilesOf(arguments)) files.push_back(file);
  return files;
}

std::string filledIn(std::string text, const std::string& name) {
  for (auto place = text.find(kPlaceholder); place != std::string::npos;
       place = text.find(kPlaceholder, place + name.size())) {
    text.replace(place, kPlaceholder.size(), name);
  }
  return text;
}

double diagonalOf(const TriangleMesh& mesh) {
  if (mesh.vertices.rows() == 0) return 0.0;
  return (mesh.vertices.colwise().maxCoeff() - mesh.vertices.colwise().minCoeff()).norm();
}

Points asFloats(const Points& points) {
  return points.cast<float>().cast<double>();
}

/// The model's own faces that stay solid, where there are any.
TriangleMesh selectedPart(const MeshFile& model) {
  if (model.selected.empty()) {
    throw InvalidInput("No face is selected: of all formats only PLY keeps a selection, as MeshLab "
                       "writes it with the faces' flags.");
  }
  return submesh(model.mesh.vertices, model.mesh.faces(model.selected, Eigen::all)).mesh;
}

Options optionsFor(const MeshFile& model, const Arguments& arguments) {
  const auto textOf = [&](const std::string& name) {
    const auto given = arguments.given.find(name);
    return given == arguments.given.end() ? std::string() : given->second;
  };
  Options options = optionsFrom([&](const Parameter& parameter) -> std::optional<ParameterValue> {
    const std::string text = textOf(parameter.name);
    if (text.empty()) return {};
    return valueFrom(parameter, text, diagonalOf(model.mesh));
  });
  if (textOf("keep_selected_solid") == "true") options.keptSolid = selectedPart(model);
  options.showAnswer = !arguments.outputs.answer.empty();
  return options;
}

ColouredMesh together(const ColouredMesh& a, const ColouredMesh& b) {
  ColouredMesh both{assembled({a.mesh, b.mesh}), a.colours};
  both.colours.insert(both.colours.end(), b.colours.begin(), b.colours.end());
  return both;
}

void writeText(const std::string& path, const std::string& text) {
  std::ofstream file(path);
  if (!(file << text).flush()) throw std::runtime_error("'" + path + "' cannot be written.");
}

std::string grams(double mass) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.4g g", mass);
  return text.data();
}

std::string summaryOf(const Report& report, bool solved) {
  return std::string(solved ? "solved" : "NOT solved") + ", " +
         grams(std::get<double>(report.at("mass_before"))) + " -> " +
         grams(std::get<double>(report.at("mass_after"))) + ": " +
         std::get<std::string>(report.at("message"));
}

void writeResult(const Result& result, const TriangleMesh& model, const Outputs& outputs,
                 bool isShell, const std::map<std::string, std::string>& places) {
  const bool hasCavity = result.inner.faces.rows() > 0;
  if (!outputs.cavity.empty() && hasCavity) {
    writeMesh(places.at(outputs.cavity), result.inner, result.innerWall);
  }
  if (!outputs.solid.empty()) {
    const TriangleMesh& outer = result.outer ? *result.outer : model;
    TriangleMesh solid = result.drilled ? *result.drilled
                         : hasCavity    ? assembled({outer, result.inner})
                                        : outer;
    if (isShell) solid = withoutEqualVertices(solid); // along its rims
    writeMesh(places.at(outputs.solid), solid);
  }
  if (!outputs.plugs.empty() && result.plugs) {
    writeMesh(places.at(outputs.plugs), *result.plugs);
  }
  if (!outputs.answer.empty() && result.picture) {
    writeMesh(places.at(outputs.answer), together(result.picture->cutOpen, result.picture->marks));
  }
  const std::string report = toJson(result.report);
  if (outputs.report == "-") {
    std::cout << report << std::flush;
  } else if (!outputs.report.empty()) {
    writeText(places.at(outputs.report), report);
  }
}

std::string isTaken(const std::string& file, const std::string& model, const std::string& other) {
  return "'" + file + "' would be written for '" + model + "', but is taken by '" + other +
         "': give each file a name of its own; {name} in it stands for the model's.";
}

} // namespace

Arguments argumentsFor(const Arguments& arguments, const std::string& model) {
  const std::string name = fs::path(model).stem().string();
  Arguments filled = arguments;
  Outputs& outputs = filled.outputs;
  for (std::string* file :
       {&outputs.cavity, &outputs.solid, &outputs.plugs, &outputs.answer, &outputs.report}) {
    *file = filledIn(*file, name);
  }
  for (const auto& [parameter, file] : parameterFilesOf(arguments)) {
    filled.given[parameter] = filledIn(file, name);
  }
  return filled;
}

void requireSensible(const Arguments& arguments) {
  std::map<fs::path, std::string> taken; // → what it is of
  const auto place = [](const std::string& path) {
    return fs::weakly_canonical(fs::absolute(path));
  };
  for (const std::string& model : arguments.models) taken[place(model)] = model;
  for (const std::string& model : arguments.models) {
    const Arguments own = argumentsFor(arguments, model);
    for (const std::string& file : meshFilesOf(own.outputs)) requireMeshFormat(file);
    for (const std::string& file : filesOf(own)) {
      const auto [other, isNew] = taken.try_emplace(place(file), model);
      if (isNew) continue;
      throw InvalidInput(isTaken(file, model, other->second));
    }
  }
}

Outcome hollow(const std::string& model, const Arguments& arguments, const Progress& progress) {
  Arguments own = argumentsFor(arguments, model);
  MeshFile file = readMesh(model);
  OutputFiles files;
  std::map<std::string, std::string> places;
  for (const std::string& path : filesOf(own)) places[path] = files.add(path);
  for (const auto& [parameter, path] : parameterFilesOf(own)) {
    own.given[parameter] = places.at(path);
  }

  const Outputs& outputs = own.outputs;
  bool inDoubles = true;
  for (const std::string& path : meshFilesOf(outputs)) inDoubles &= keepsDoubles(path);
  // What is checked and reported is what the files hold.
  if (!inDoubles) file.mesh.vertices = asFloats(file.mesh.vertices);
  Options options = optionsFor(file, own);
  if (!inDoubles) options.representable = asFloats;

  const Result result = optimizeMassProperties(file.mesh, options, progress);
  writeResult(result, file.mesh, outputs, options.openSurface, places);
  Outcome outcome;
  outcome.solved = std::get<bool>(result.report.at("solved"));
  outcome.line = summaryOf(result.report, outcome.solved);
  for (const auto& [path, unfinished] : places) {
    if (!files.isWritten(path)) outcome.line += " ('" + path + "' is not written: there is none.)";
  }
  files.keep();
  return outcome;
}

} // namespace massprops
