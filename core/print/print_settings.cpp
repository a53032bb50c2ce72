#include "core/print/print_settings.h"

#include "core/base/report.h"

#include <algorithm>

namespace massprops {
namespace {

void append(SlicerSettings& settings, SlicerSettings more) {
  settings.insert(settings.end(), more.begin(), more.end());
}

std::string percent(double share) {
  return toString(100.0 * share) + "%";
}

/// One width for all that is extruded, so that no line's cross-section is a surprise.
SlicerSettings lineWidths(const std::string& width) {
  SlicerSettings settings;
  for (const char* const of :
       {"extrusion_width", "first_layer_extrusion_width", "perimeter_extrusion_width",
        "external_perimeter_extrusion_width", "infill_extrusion_width",
        "solid_infill_extrusion_width", "top_infill_extrusion_width"}) {
    settings.emplace_back(of, width);
  }
  return settings;
}

} // namespace

int perimetersFor(double wall, double lineWidth) {
  return wall < 2.0 * lineWidth ? 1 : 2;
}

SlicerSettings bodySettings(const PrintSettings& settings) {
  SlicerSettings all = {
      {"layer_height", toString(settings.layerHeight)},
      {"perimeters", std::to_string(settings.perimeters)},
      {"perimeter_generator", "arachne"}, // lines as wide as a thin wall needs
      // Full everywhere. As solid layers rather than infill of 100 %, because only these bridge the
      // sparse infill under a ceiling.
      {"fill_density", "99%"},
      {"solid_infill_every_layers", "1"},
      {"fill_pattern", "rectilinear"},
      {"top_solid_layers", "1"},
      {"bottom_solid_layers", "1"},
      {"top_solid_min_thickness", "0"},
      {"bottom_solid_min_thickness", "0"},
      {"ensure_vertical_shell_thickness", "0"},
      {"infill_overlap", "10%"}, // more is printed twice
      {"infill_anchor", "600%"},
      {"infill_anchor_max", "50"},
      {"thick_bridges", "0"}, // these would take more material
      {"support_material", "1"},
      {"support_material_auto", "1"},
      {"support_material_threshold", "45"},
      {"support_material_buildplate_only", "0"},
      {"brim_width", toString(settings.brim)},
  };
  append(all, lineWidths(toString(settings.lineWidth)));
  return all;
}

SlicerSettings projectSettings(const PrintSettings& settings) {
  SlicerSettings all = {
      {"nozzle_diameter", "0.4"},
      {"filament_diameter", "1.75"},
      {"filament_density", toString(settings.density)},
      {"first_layer_height", toString(settings.layerHeight)},
      {"elefant_foot_compensation", "0"},
      {"bed_shape", "0x0,250x0,250x210,0x210"},
      {"temperature", "215"},
      {"first_layer_temperature", "215"},
      {"bed_temperature", "60"},
      {"first_layer_bed_temperature", "60"},
      {"retract_length", "0.8"},
      {"use_relative_e_distances", "0"},
      {"skirts", "0"},
      {"solid_infill_below_area", "0"},
  };
  append(all, bodySettings(settings));
  return all;
}

SlicerSettings cavitySettings(const PrintSettings& settings) {
  return {
      {"fill_density", percent(settings.cavityInfill)},
      {"solid_infill_every_layers", "0"},
      {"solid_infill_below_area", "0"},
      {"fill_pattern", "cubic"}, // as dense in a narrow place as in a wide one
      {"infill_anchor", "0"},    // lines along its border would add to it
      {"infill_anchor_max", "0"},
      {"perimeters", "0"},
      {"top_solid_layers", "0"},
      {"bottom_solid_layers", "0"},
  };
}

SlicerSettings bodySettingsOfBambu(const PrintSettings& settings) {
  const std::string width = toString(settings.lineWidth);
  SlicerSettings all = {
      {"layer_height", toString(settings.layerHeight)},
      {"wall_loops", std::to_string(settings.perimeters)},
      {"wall_generator", "arachne"},
      {"sparse_infill_density", "100%"},
      {"sparse_infill_pattern", "zig-zag"},
      {"top_shell_layers", "1"},
      {"bottom_shell_layers", "1"},
      {"top_shell_thickness", "0"},
      {"bottom_shell_thickness", "0"},
      {"infill_wall_overlap", "10%"},
      {"thick_bridges", "0"},
      {"enable_support", "1"},
      {"support_type", "normal(auto)"},
      {"support_threshold_angle", "45"},
      {"support_on_build_plate_only", "0"},
      {"brim_type", settings.brim > 0.0 ? "outer_only" : "no_brim"},
      {"brim_width", toString(settings.brim)},
  };
  for (const char* const of :
       {"line_width", "initial_layer_line_width", "inner_wall_line_width", "outer_wall_line_width",
        "sparse_infill_line_width", "internal_solid_infill_line_width", "top_surface_line_width"}) {
    all.emplace_back(of, width);
  }
  return all;
}

SlicerSettings cavitySettingsOfBambu(const PrintSettings& settings) {
  return {
      {"sparse_infill_density", percent(settings.cavityInfill)},
      {"sparse_infill_pattern", "cubic"},
      {"minimum_sparse_infill_area", "0"},
      {"infill_anchor", "0"},
      {"infill_anchor_max", "0"},
      {"wall_loops", "0"},
      {"top_shell_layers", "0"},
      {"bottom_shell_layers", "0"},
  };
}

} // namespace massprops
