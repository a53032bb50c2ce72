// How a slicer is told to print: chosen so that what it makes weighs what was calculated.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace massprops {

/// Lengths in millimetres. The defaults are those of common profiles for a nozzle of 0.4 mm.
struct PrintSettings {
  double layerHeight = 0.2;
  double lineWidth = 0.45;
  int perimeters = 2;
  double cavityInfill = 0.0; ///< 0…1; 0: the cavity is left empty
  double density = 1.24;     ///< of the filament, g/cm³
  double brim = 0.0;         ///< around the first layer
};

/// As many perimeters around a wall as it has room for, one at least and two at most: more would
/// grow into what is behind it.
int perimetersFor(double wall, double lineWidth);

/// Names of settings and their values, in a slicer's own words.
using SlicerSettings = std::vector<std::pair<std::string, std::string>>;

/// PrusaSlicer's for the whole project.
SlicerSettings projectSettings(const PrintSettings& settings);
/// Those of them that make the print what was calculated: they stay with the object when another
/// printer is chosen.
SlicerSettings bodySettings(const PrintSettings& settings);
/// Of the modifier volume that is the cavity: infill up to its surface, without perimeters and
/// solid layers of its own.
SlicerSettings cavitySettings(const PrintSettings& settings);

/// The same in Bambu Studio's and OrcaSlicer's words.
SlicerSettings bodySettingsOfBambu(const PrintSettings& settings);
SlicerSettings cavitySettingsOfBambu(const PrintSettings& settings);

} // namespace massprops
