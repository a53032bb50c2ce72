#include "core/inspection.h"

#include "core/graph.h"
#include "core/moments.h"
#include "core/spatial.h"
#include "core/validity.h"

#include <set>

namespace massprops {
namespace {

constexpr double kWallTolerance = 0.005;

/// Faces of each connected component, as rows of `faces`.
std::vector<Faces> componentsOf(Eigen::Index vertexCount, const Faces& faces) {
  const Neighbours neighbours = vertexNeighbours(vertexCount, faces);
  std::vector<int> component(static_cast<std::size_t>(vertexCount), -1);
  std::vector<std::vector<Eigen::Index>> rows;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const auto seed = static_cast<std::size_t>(faces(f, 0));
    if (component[seed] < 0) {
      const int label = static_cast<int>(rows.size());
      rows.emplace_back();
      component[seed] = label;
      std::vector<std::size_t> stack{seed};
      while (!stack.empty()) {
        const std::size_t v = stack.back();
        stack.pop_back();
        for (const int w : neighbours[v]) {
          if (component[static_cast<std::size_t>(w)] >= 0) continue;
          component[static_cast<std::size_t>(w)] = label;
          stack.push_back(static_cast<std::size_t>(w));
        }
      }
    }
    rows[static_cast<std::size_t>(component[seed])].push_back(f);
  }
  std::vector<Faces> result;
  for (const std::vector<Eigen::Index>& list : rows) {
    Faces part(static_cast<Eigen::Index>(list.size()), 3);
    for (std::size_t i = 0; i < list.size(); ++i) {
      part.row(static_cast<Eigen::Index>(i)) = faces.row(list[i]);
    }
    result.push_back(std::move(part));
  }
  return result;
}

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

  // Without crossings a component lies inside of another surface with all its points or with none.
  const std::vector<Faces> components = componentsOf(inner.rows(), innerFaces);
  inspection.components = static_cast<int>(components.size());
  Points samples(static_cast<Eigen::Index>(components.size()), 3);
  for (std::size_t c = 0; c < components.size(); ++c) {
    samples.row(static_cast<Eigen::Index>(c)) = inner.row(components[c](0, 0));
  }
  std::vector<bool> bad = insideOf(samples, outer, outerFaces);
  bad.flip();
  for (std::size_t c = 0; c < components.size(); ++c) {
    const Points centred = inner.rowwise() - samples.row(static_cast<Eigen::Index>(c));
    if (!(moments(centred, components[c])[0] > 0.0)) bad[c] = true;
    if (components.size() == 1) continue;
    const std::vector<bool> swallowed = insideOf(samples, inner, components[c]);
    for (std::size_t other = 0; other < components.size(); ++other) {
      if (other != c && swallowed[other]) bad[other] = true;
    }
  }
  for (std::size_t c = 0; c < components.size(); ++c) {
    if (!bad[c]) continue;
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
