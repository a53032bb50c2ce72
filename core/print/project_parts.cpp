#include "core/print/project_parts.h"

#include <pugixml.hpp>

#include <array>
#include <charconv>
#include <sstream>

namespace massprops {
namespace {

constexpr int kObject = 1;

std::string text(const pugi::xml_document& document) {
  std::ostringstream out;
  document.save(out, " ");
  return out.str();
}

/// pugixml's own numbers follow the host's locale.
std::string inDigits(double value) {
  std::array<char, 32> digits{};
  char* const end =
      std::to_chars(digits.data(), digits.data() + digits.size(), static_cast<float>(value)).ptr;
  return {digits.data(), end};
}

void set(pugi::xml_node node, const char* attribute, const std::string& value) {
  node.append_attribute(attribute).set_value(value.c_str());
}

void addVertices(pugi::xml_node vertices, const Points& points) {
  constexpr std::array<const char*, 3> kAxes = {"x", "y", "z"};
  for (Eigen::Index v = 0; v < points.rows(); ++v) {
    const pugi::xml_node vertex = vertices.append_child("vertex");
    for (int i = 0; i < 3; ++i) {
      set(vertex, kAxes[static_cast<std::size_t>(i)], inDigits(points(v, i)));
    }
  }
}

void addTriangles(pugi::xml_node triangles, const Faces& faces, Eigen::Index firstVertex) {
  constexpr std::array<const char*, 3> kCorners = {"v1", "v2", "v3"};
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    pugi::xml_node triangle = triangles.append_child("triangle");
    for (int i = 0; i < 3; ++i) {
      triangle.append_attribute(kCorners[static_cast<std::size_t>(i)]) =
          static_cast<long long>(faces(f, i) + firstVertex);
    }
  }
}

void addMetadata(pugi::xml_node node, const std::string& key, const std::string& value,
                 const char* type = nullptr) {
  const pugi::xml_node metadata = node.append_child("metadata");
  if (type != nullptr) set(metadata, "type", type);
  set(metadata, "key", key);
  set(metadata, "value", value);
}

const char* volumeType(PartRole role) {
  switch (role) {
  case PartRole::Body:
    return "ModelPart";
  case PartRole::Modifier:
    return "ParameterModifier";
  case PartRole::SupportBlocker:
    return "SupportBlocker";
  }
  return "";
}

const char* subtypeOfBambu(PartRole role) {
  switch (role) {
  case PartRole::Body:
    return "normal_part";
  case PartRole::Modifier:
    return "modifier_part";
  case PartRole::SupportBlocker:
    return "support_blocker";
  }
  return "";
}

/// Which of the mesh's triangles are a part's.
void setTriangles(pugi::xml_node node, Eigen::Index first, const ProjectPart& part) {
  node.append_attribute("firstid") = static_cast<long long>(first);
  node.append_attribute("lastid") = static_cast<long long>(first + part.mesh.faces.rows() - 1);
}

} // namespace

std::string modelXml(const ProjectObject& object) {
  pugi::xml_document document;
  pugi::xml_node model = document.append_child("model");
  set(model, "unit", "millimeter");
  set(model, "xml:lang", "en-US");
  set(model, "xmlns", "http://schemas.microsoft.com/3dmanufacturing/core/2015/02");
  set(model, "xmlns:slic3rpe", "http://schemas.slic3r.org/3mf/2017/06");
  const auto addText = [&](const char* name, const std::string& value) {
    pugi::xml_node metadata = model.append_child("metadata");
    set(metadata, "name", name);
    metadata.text().set(value.c_str());
  };
  addText("slic3rpe:Version3mf", "1"); // else PrusaSlicer moves the parts
  addText("Title", object.name);
  addText("Application", "massprops");

  pugi::xml_node solid = model.append_child("resources").append_child("object");
  solid.append_attribute("id") = kObject;
  set(solid, "name", object.name);
  set(solid, "type", "model");
  pugi::xml_node mesh = solid.append_child("mesh");
  const pugi::xml_node vertices = mesh.append_child("vertices");
  const pugi::xml_node triangles = mesh.append_child("triangles");
  Eigen::Index firstVertex = 0;
  for (const ProjectPart& part : object.parts) {
    addVertices(vertices, part.mesh.vertices);
    addTriangles(triangles, part.mesh.faces, firstVertex);
    firstVertex += part.mesh.vertices.rows();
  }
  pugi::xml_node item = model.append_child("build").append_child("item");
  item.append_attribute("objectid") = kObject;
  set(item, "transform",
      "1 0 0 0 1 0 0 0 1 " + inDigits(object.place.x()) + " " + inDigits(object.place.y()) + " 0");
  return text(document);
}

std::string partsOfPrusaSlicer(const ProjectObject& object) {
  pugi::xml_document document;
  pugi::xml_node node = document.append_child("config").append_child("object");
  node.append_attribute("id") = kObject;
  node.append_attribute("instances_count") = 1;
  addMetadata(node, "name", object.name, "object");
  for (const auto& [key, value] : object.settings) addMetadata(node, key, value, "object");
  Eigen::Index first = 0;
  for (const ProjectPart& part : object.parts) {
    const pugi::xml_node volume = node.append_child("volume");
    setTriangles(volume, first, part);
    first += part.mesh.faces.rows();
    addMetadata(volume, "name", part.name, "volume");
    addMetadata(volume, "volume_type", volumeType(part.role), "volume");
    for (const auto& [key, value] : part.settings) addMetadata(volume, key, value, "volume");
  }
  return text(document);
}

std::string partsOfBambu(const ProjectObject& object) {
  pugi::xml_document document;
  pugi::xml_node node = document.append_child("config").append_child("object");
  node.append_attribute("id") = kObject;
  addMetadata(node, "name", object.name);
  for (const auto& [key, value] : object.settingsOfBambu) addMetadata(node, key, value);
  Eigen::Index first = 0;
  int number = 0;
  for (const ProjectPart& part : object.parts) {
    pugi::xml_node entry = node.append_child("part");
    entry.append_attribute("id") = ++number;
    set(entry, "subtype", subtypeOfBambu(part.role));
    setTriangles(entry, first, part);
    first += part.mesh.faces.rows();
    addMetadata(entry, "name", part.name);
    for (const auto& [key, value] : part.settingsOfBambu) addMetadata(entry, key, value);
  }
  return text(document);
}

std::string configOfPrusaSlicer(const SlicerSettings& settings) {
  std::ostringstream lines;
  lines << "; written by massprops\n\n";
  for (const auto& [key, value] : settings) lines << "; " << key << " = " << value << '\n';
  return lines.str();
}

std::string contentTypesXml() {
  pugi::xml_document document;
  pugi::xml_node types = document.append_child("Types");
  set(types, "xmlns", "http://schemas.openxmlformats.org/package/2006/content-types");
  const auto add = [&](const char* extension, const char* type) {
    const pugi::xml_node entry = types.append_child("Default");
    set(entry, "Extension", extension);
    set(entry, "ContentType", type);
  };
  add("rels", "application/vnd.openxmlformats-package.relationships+xml");
  add("model", "application/vnd.ms-package.3dmanufacturing-3dmodel+xml");
  add("png", "image/png");
  add("config", "application/octet-stream");
  add("txt", "text/plain");
  return text(document);
}

std::string relationshipsXml() {
  pugi::xml_document document;
  pugi::xml_node relationships = document.append_child("Relationships");
  set(relationships, "xmlns", "http://schemas.openxmlformats.org/package/2006/relationships");
  const auto add = [&](const char* id, const char* target, const char* type) {
    const pugi::xml_node entry = relationships.append_child("Relationship");
    set(entry, "Target", target);
    set(entry, "Id", id);
    set(entry, "Type", type);
  };
  add("rel-1", "/3D/3dmodel.model", "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel");
  add("rel-2", "/Metadata/thumbnail.png",
      "http://schemas.openxmlformats.org/package/2006/relationships/metadata/thumbnail");
  return text(document);
}

} // namespace massprops
