#include "core/model/empty_shells.h"

#include "core/base/tolerances.h"
#include "core/base/triangle.h"
#include "core/mesh/components.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/signed_volume.h"

#include <cmath>
#include <utility>
#include <vector>

namespace massprops {

MendedMesh withoutEmptyShells(const TriangleMesh& input, const MendingTask& /*task*/) {
  std::vector<Submesh> components = componentMeshes(input.vertices, input.faces);
  if (components.size() < 2) return {input};
  const double thinnest = placeTolerance(input.vertices);
  const double least = kLeastVolume * std::pow(diagonalOf(input.vertices), 3);
  constexpr double kFlat = 1e-3; // of a cube with this surface: 0.068
  constexpr double kLittle = 0.05;
  std::vector<TriangleMesh> kept;
  std::size_t empty = 0;
  double sheets = 0.0; // their area
  for (Submesh& component : components) {
    const auto& [vertices, faces] = component.mesh;
    const bool isClosed = countEdges(vertices.rows(), faces).boundary == 0;
    const double volume = std::abs(signedVolume(vertices, faces));
    const double area = surfaceArea(vertices, faces);
    // Two sides.
    const double thickness = 2.0 * volume / area;
    const bool isThin = !(thickness > thinnest && volume > least);
    const bool isEmpty = isThin || (!isClosed && volume < kFlat * std::pow(area, 1.5));
    if (!isEmpty) {
      kept.push_back(std::move(component.mesh));
      continue;
    }
    ++empty;
    if (!isClosed) sheets += area;
  }
  const bool isMuch = sheets > kLittle * surfaceArea(input.vertices, input.faces);
  if (empty == 0 || kept.empty() || isMuch) return {input};
  return {assembled(kept), counted(empty, "component", "components") + " without volume left out"};
}

} // namespace massprops
