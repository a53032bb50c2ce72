#include "core/inspection.h"

#include "core/components.h"
#include "core/moments.h"
#include "core/spatial.h"
#include "core/validity.h"

#include <set>

namespace massprops {
namespace {

constexpr double kWallTolerance = 0.005;

} // namespace

Inspection inspect(const Points& inner, const Faces& innerFaces, const Points& outer,
                   const Faces& outerFaces, double wall, bool outerMoved) {
  Inspection inspection;
  std::set<int> crossing;
  for (const int f : crossingFaces(inner, innerFaces, outer, outerFaces)) {
    for (const int v : innerFaces.row(f)) crossing.insert(v);
  }

  if (outerMoved) {
    std::set<int> folded;
    for (const int f : selfIntersectingFaces(outer, outerFaces)) {
      for (const int v : outerFaces.row(f)) folded.insert(v);
    }
    inspection.outerCrossing.assign(folded.begin(), folded.end());
  }

  const Components components = connectedComponents(inner.rows(), innerFaces);
  inspection.components = static_cast<int>(components.size());
  const std::vector<int> depths = nestingDepths(inner, components);
  Points samples(static_cast<Eigen::Index>(components.size()), 3);
  for (std::size_t c = 0; c < components.size(); ++c) {
    samples.row(static_cast<Eigen::Index>(c)) = inner.row(components[c](0, 0));
  }
  const std::vector<bool> inside = insideOf(samples, outer, outerFaces);
  for (std::size_t c = 0; c < components.size(); ++c) {
    const Points centred = inner.rowwise() - samples.row(static_cast<Eigen::Index>(c));
    const bool outward = moments(centred, components[c])[0] > 0.0;
    if (inside[c] && outward && depths[c] == 0) continue;
    crossing.insert(components[c].data(), components[c].data() + components[c].size());
  }
  inspection.crossing.assign(crossing.begin(), crossing.end());

  inspection.wall = surfaceDistances(inner, innerFaces, outer, outerFaces, wall);
  inspection.leastWall = inspection.wall.minCoeff();
  for (Eigen::Index v = 0; v < inspection.wall.size(); ++v) {
    if (inspection.wall[v] < (1.0 - kWallTolerance) * wall) {
      inspection.thin.push_back(static_cast<int>(v));
    }
  }
  return inspection;
}

} // namespace massprops
