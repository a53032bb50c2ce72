#include "filter_massprops/pymeshlab_names.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace massprops {
namespace {

struct Filter {
  const char* menu;
  const char* python;
};

/// Beginnings that all MeshLab versions share: later ones spell the rest otherwise.
constexpr Filter kFilters[] = {
    {"Close Holes", "meshing_close_holes"},
    {"Compute Planar Section", "generate_polyline_from_planar_section"},
    {"Isotropic Explicit Remeshing", "meshing_isotropic_explicit_remeshing"},
    {"Laplacian Smooth", "apply_coord_laplacian_smoothing"},
    {"Matrix: Reset Current Matrix", "set_matrix_identity"},
    {"Merge Close Vertices", "meshing_merge_close_vertices"},
    {"Mesh Boolean: Union", "generate_boolean_union"},
    {"Re-Orient all faces", "meshing_re_orient_faces_coherently"},
    {"Remove Isolated pieces (wrt Diameter)", "meshing_remove_connected_component_by_diameter"},
    {"Remove T-Vertices", "meshing_remove_t_vertices"},
    {"Remove Vertices wrt Quality", "meshing_remove_vertices_by_scalar"},
    {"Repair non Manifold Edges", "meshing_repair_non_manifold_edges"},
    {"Repair non Manifold Vertices", "meshing_repair_non_manifold_vertices"},
    {"Select Self Intersecting Faces", "compute_selection_by_self_intersections_per_face"},
    {"Simplification: Quadric Edge Collapse Decimation",
     "meshing_decimation_quadric_edge_collapse"},
    {"Split in Connected Components", "generate_splitting_by_connected_components"},
    {"Subdivision Surfaces: Midpoint", "meshing_surface_subdivision_midpoint"},
    {"Surface Reconstruction: Screened Poisson",
     "generate_surface_reconstruction_screened_poisson"},
    {"Transform: Translate, Center", "compute_matrix_from_translation"},
};

} // namespace

std::string withPyMeshLabNames(const std::string& sentence) {
  std::vector<std::pair<std::size_t, const char*>> named;
  for (const Filter& filter : kFilters) {
    const std::size_t place = sentence.find(filter.menu);
    if (place != std::string::npos) named.emplace_back(place, filter.python);
  }
  std::sort(named.begin(), named.end());
  std::string result = sentence;
  const char* separator = " In PyMeshLab: ";
  for (const auto& [place, python] : named) {
    result += std::exchange(separator, ", ");
    result += python;
  }
  return named.empty() ? result : result + ".";
}

} // namespace massprops
