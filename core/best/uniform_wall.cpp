#include "core/best/uniform_wall.h"

#include "core/base/parallel.h"
#include "core/base/triangle.h"
#include "core/contour/cavity_contour.h"
#include "core/mesh/signed_volume.h"
#include "core/optimum/admissible_cells.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace massprops {
namespace {

/// The depth behind which cells hold the volume, each taken for as deep as its middle; the least
/// wall where they do not.
double depthHolding(const VolumeTask& task) {
  const AdmissibleCells cells = admissibleCells(task.surface, task.leastWall);
  struct Part {
    double depth, volume;
  };
  std::vector<Part> parts(static_cast<std::size_t>(cells.rows()));
  constexpr Eigen::Index kRun = 512;
  forChunks(cells.rows(), kRun, [&](const Chunk& chunk) {
    for (Eigen::Index c = chunk.begin; c < chunk.end; ++c) {
      const Vec3 middle = cells.block<1, 3>(c, 1).transpose() / cells(c, 0);
      parts[static_cast<std::size_t>(c)] = {
          std::sqrt(task.surface.clearance(middle).squaredDistance), cells(c, 0)};
    }
  });
  std::sort(parts.begin(), parts.end(),
            [](const Part& a, const Part& b) { return a.depth > b.depth; });
  double volume = 0.0;
  for (const Part& part : parts) {
    volume += part.volume;
    if (volume >= task.volume) return std::max(part.depth, task.leastWall);
  }
  return task.leastWall;
}

/// Whether it has the volume as it will be delivered.
bool adjustVolume(const VolumeTask& task, TriangleMesh& cavity) {
  constexpr int kSteps = 8;
  for (int step = 0; step < kSteps; ++step) {
    const double missing =
        task.volume - signedVolume(task.deliverable(cavity.vertices), cavity.faces);
    if (std::abs(missing) <= task.tolerance) return true;
    cavity.vertices += missing / surfaceArea(cavity.vertices, cavity.faces) *
                       vertexNormals(cavity.vertices, cavity.faces);
  }
  return false;
}

} // namespace

std::optional<TriangleMesh> cavityOfVolume(const VolumeTask& task) {
  constexpr int kContours = 6;
  constexpr double kFarthest = 0.02; // cubes, that vertices move
  // Many cubes across even where little is hollow.
  constexpr double kAcross = 16.0;
  constexpr double kLeastEdge = 1.0 / 1000.0;
  const double edge = std::min(task.edge, std::max(std::cbrt(task.volume) / kAcross, kLeastEdge));
  double wall = depthHolding(task);
  for (int i = 0; i < kContours; ++i) {
    std::optional<CavityContour> found =
        cavityContour(openedSet(task.surface, wall, task.ball, edge), {});
    if (!found || found->contour.mesh.faces.rows() == 0) return {};
    TriangleMesh& cavity = found->contour.mesh;
    const double missing = task.volume - signedVolume(cavity.vertices, cavity.faces);
    const bool isLeastWall = wall == task.leastWall;
    if (missing > 0.0 && isLeastWall) return {};
    const double outwards = missing / surfaceArea(cavity.vertices, cavity.faces);
    if (std::abs(outwards) <= kFarthest * edge && wall - outwards >= task.leastWall) {
      if (!adjustVolume(task, cavity)) return {};
      return std::move(cavity);
    }
    wall = std::max(wall - outwards, task.leastWall);
  }
  return {};
}

} // namespace massprops
