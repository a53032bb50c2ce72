// What was found, as a project that a slicer opens and prints as it was calculated.
#pragma once

#include "core/base/options.h"
#include "core/base/report.h"
#include "core/print/archive.h"
#include "core/print/first_layer.h"
#include "core/print/plate.h"
#include "core/print/project_parts.h"

#include <string>
#include <vector>

namespace massprops {

/// Surfaces in model coordinates, millimetres.
struct PrintJob {
  TriangleMesh outer;  ///< outward
  TriangleMesh cavity; ///< oriented into it; may be empty
  /// Whether the outer surface has openings, which the other one closes.
  bool isOpen = false;
  double wall = 0.0; ///< the least
};

struct PrintProject {
  ProjectObject object;
  PrintSettings settings;
  double wall = 0.0; ///< the least
  PlatePose pose;    ///< model to plate
  FirstLayer firstLayer;
  bool firstLayerHolds = false;
  double mass = 0.0;                ///< of what is printed, g
  Vec3 centerOfMass = Vec3::Zero(); ///< of that, on the plate
  std::string thumbnail;            ///< PNG
};

/// `name`: of the object. \pre the surfaces bound a volume
PrintProject printProject(const PrintJob& job, const Options& options, const std::string& name);

/// Adds the keys of the print.
void describe(const PrintProject& project, Report& report);

/// The files of the 3MF archive. `report`: goes with them but for the times, so that the same print
/// has the same bytes.
std::vector<ArchiveEntry> filesOf(const PrintProject& project, const Report& report);

} // namespace massprops
