// A slicer's project as the 3MF format and slicers' own files describe it.
#pragma once

#include "core/base/types.h"
#include "core/print/print_settings.h"

#include <string>
#include <vector>

namespace massprops {

enum class PartRole {
  Body,           ///< printed
  Modifier,       ///< where it lies the body has other settings
  SupportBlocker, ///< no support where it lies
};

/// A closed surface, outward; of a body with cavities these as well, oriented into them.
struct ProjectPart {
  std::string name;
  PartRole role = PartRole::Body;
  TriangleMesh mesh; ///< millimetres
  SlicerSettings settings = {}, settingsOfBambu = {};
};

/// Parts of one object, which keep their places.
struct ProjectObject {
  std::string name;
  std::vector<ProjectPart> parts;
  Vec2 place = Vec2::Zero(); ///< of the object's origin on the plate
  SlicerSettings settings = {}, settingsOfBambu = {};
};

/// 3D/3dmodel.model: one mesh of all parts. Coordinates in single precision, as slicers read them.
std::string modelXml(const ProjectObject& object);
/// Metadata/Slic3r_PE_model.config, by which PrusaSlicer takes the mesh apart.
std::string partsOfPrusaSlicer(const ProjectObject& object);
/// Metadata/model_settings.config, the same for Bambu Studio and OrcaSlicer.
std::string partsOfBambu(const ProjectObject& object);
/// Metadata/Slic3r_PE.config
std::string configOfPrusaSlicer(const SlicerSettings& settings);
/// [Content_Types].xml and _rels/.rels, the same for every project.
std::string contentTypesXml();
std::string relationshipsXml();

} // namespace massprops
