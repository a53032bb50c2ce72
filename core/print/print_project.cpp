#include "core/print/print_project.h"

#include "core/mesh/signed_volume.h"
#include "core/model/repair.h"
#include "core/physics/mass_properties.h"
#include "core/print/thumbnail.h"

#include <cmath>
#include <utility>

namespace massprops {
namespace {

/// The middle of the plate that the settings name; smaller and larger ones have room there, too.
const Vec2 kPlace(125.0, 105.0);

/// Both surfaces; vertices that lie on each other are one where the second closes the first.
TriangleMesh together(const TriangleMesh& a, const TriangleMesh& b, bool areJoined) {
  TriangleMesh both;
  both.vertices.resize(a.vertices.rows() + b.vertices.rows(), 3);
  both.vertices << a.vertices, b.vertices;
  both.faces.resize(a.faces.rows() + b.faces.rows(), 3);
  const Faces shifted = b.faces.array() + static_cast<int>(a.vertices.rows());
  both.faces << a.faces, shifted;
  return areJoined ? mergedAndCompacted(both).mesh : both;
}

TriangleMesh turnedOver(TriangleMesh mesh) {
  flip(mesh.faces);
  return mesh;
}

TriangleMesh raised(TriangleMesh mesh, double height) {
  mesh.vertices.col(2).array() += height;
  return mesh;
}

/// What the object is made of: `outer`, `cavity` as they stand on the plate.
std::vector<ProjectPart> partsOf(const TriangleMesh& outer, const TriangleMesh& cavity, bool isOpen,
                                 const PrintSettings& settings, const std::string& name) {
  if (cavity.faces.rows() == 0) return {{name, PartRole::Body, outer}};
  if (settings.cavityInfill > 0.0) {
    return {{name, PartRole::Body, outer},
            {name + " cavity", PartRole::Modifier, turnedOver(cavity), cavitySettings(settings),
             cavitySettingsOfBambu(settings)}};
  }
  std::vector<ProjectPart> parts = {{name, PartRole::Body, together(outer, cavity, isOpen)}};
  // A layer hangs over where there is a cavity in the one below. Nobody could take support out.
  if (!isOpen) {
    parts.push_back({name + " cavity", PartRole::SupportBlocker,
                     turnedOver(raised(cavity, settings.layerHeight))});
  }
  return parts;
}

/// What there is to know before it is printed; often nothing.
std::string noteOn(const PrintProject& project) {
  std::string note;
  if (!project.firstLayerHolds) {
    note =
        "The first layer, " + toString(std::round(project.firstLayer.area)) +
        " mm\u00b2, is too small to hold the print: the project has a brim and support outside, or "
        "choose another build_axis.";
  }
  const double width = project.settings.lineWidth;
  if (project.wall < width) {
    note += (note.empty() ? "" : " ") + std::string("Walls thinner than a line of ") +
            toString(width) + " mm are printed thicker than they were calculated.";
  }
  return note;
}

Report withoutTimes(const Report& report) {
  Report result;
  for (const auto& entry : report.entries) {
    if (entry.first.rfind("seconds", 0) != 0) result.entries.push_back(entry);
  }
  return result;
}

} // namespace

PrintProject printProject(const PrintJob& job, const Options& options, const std::string& name) {
  constexpr double kBrim = 5.0;
  PrintProject project;
  project.wall = job.wall;
  project.pose = poseOnPlate(job.outer.vertices, options);
  const TriangleMesh outer{project.pose(job.outer.vertices), job.outer.faces};
  const TriangleMesh cavity{project.pose(job.cavity.vertices), job.cavity.faces};
  const TriangleMesh material = together(outer, cavity, job.isOpen);

  PrintSettings& settings = project.settings;
  settings.perimeters = perimetersFor(job.wall, settings.lineWidth);
  settings.cavityInfill = cavity.faces.rows() > 0 ? options.cavityInfill : 0.0;
  settings.density = options.density;
  project.firstLayer = firstLayer(material.vertices, material.faces, 0.5 * settings.layerHeight);
  project.firstLayerHolds = holds(project.firstLayer, outer.vertices.col(2).maxCoeff());
  if (!project.firstLayerHolds) settings.brim = kBrim;

  const Moments infill = -settings.cavityInfill * moments(cavity.vertices, cavity.faces);
  const MassProperties body = massProperties(moments(material.vertices, material.faces) + infill);
  project.mass = options.density * body.mass / 1000.0;
  project.thumbnail = thumbnail(material, outer.faces.rows(), body.centerOfMass);

  const Vec3 place(kPlace.x(), kPlace.y(), 0.0);
  project.centerOfMass = body.centerOfMass + place;
  project.pose.shift += place;
  project.object = {name, partsOf(outer, cavity, job.isOpen, settings, name), kPlace,
                    bodySettings(settings), bodySettingsOfBambu(settings)};
  return project;
}

void describe(const PrintProject& project, Report& report) {
  report.add("print_mass", project.mass);
  report.add("print_center_of_mass", project.centerOfMass);
  report.add("print_perimeters", project.settings.perimeters);
  report.add("first_layer_area", project.firstLayer.area);
  report.add("first_layer_holds", project.firstLayerHolds);
  const std::string note = noteOn(project);
  if (!note.empty()) report.add("print_note", note);
}

std::vector<ArchiveEntry> filesOf(const PrintProject& project, const Report& report) {
  std::string lines;
  for (const auto& [key, value] : withoutTimes(report).entries) {
    lines += key + " = " + toString(value) + "\n";
  }
  return {{"[Content_Types].xml", contentTypesXml()},
          {"_rels/.rels", relationshipsXml()},
          {"3D/3dmodel.model", modelXml(project.object)},
          {"Metadata/Slic3r_PE.config", configOfPrusaSlicer(projectSettings(project.settings))},
          {"Metadata/Slic3r_PE_model.config", partsOfPrusaSlicer(project.object)},
          {"Metadata/model_settings.config", partsOfBambu(project.object)},
          {"Metadata/thumbnail.png", project.thumbnail},
          {"Metadata/report.txt", lines}};
}

} // namespace massprops
