#include "core/components.h"

#include "core/graph.h"
#include "core/validity.h"

namespace massprops {

Components connectedComponents(Eigen::Index vertexCount, const Faces& faces) {
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
  Components result;
  for (const std::vector<Eigen::Index>& list : rows) {
    Faces part(static_cast<Eigen::Index>(list.size()), 3);
    for (std::size_t i = 0; i < list.size(); ++i) {
      part.row(static_cast<Eigen::Index>(i)) = faces.row(list[i]);
    }
    result.push_back(std::move(part));
  }
  return result;
}

std::vector<int> nestingDepths(const Points& vertices, const Components& components) {
  std::vector<int> depths(components.size(), 0);
  if (components.size() < 2) return depths;
  // Without crossings a component lies inside of another one with all its points or with none.
  Points samples(static_cast<Eigen::Index>(components.size()), 3);
  for (std::size_t c = 0; c < components.size(); ++c) {
    samples.row(static_cast<Eigen::Index>(c)) = vertices.row(components[c](0, 0));
  }
  for (std::size_t c = 0; c < components.size(); ++c) {
    const Submesh part = submesh(vertices, components[c]);
    const std::vector<bool> inside = insideOf(samples, part.mesh.vertices, part.mesh.faces);
    for (std::size_t other = 0; other < components.size(); ++other) {
      if (other != c && inside[other]) ++depths[other];
    }
  }
  return depths;
}

Submesh submesh(const Points& vertices, const Faces& faces) {
  std::vector<int> number(static_cast<std::size_t>(vertices.rows()), -1);
  for (Eigen::Index i = 0; i < faces.size(); ++i) {
    number[static_cast<std::size_t>(faces.data()[i])] = 0;
  }
  Submesh result;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] < 0) continue;
    number[v] = static_cast<int>(result.vertexOf.size());
    result.vertexOf.push_back(static_cast<int>(v));
  }
  result.mesh.vertices.resize(static_cast<Eigen::Index>(result.vertexOf.size()), 3);
  for (std::size_t i = 0; i < result.vertexOf.size(); ++i) {
    result.mesh.vertices.row(static_cast<Eigen::Index>(i)) = vertices.row(result.vertexOf[i]);
  }
  result.mesh.faces = faces.unaryExpr([&](int v) { return number[static_cast<std::size_t>(v)]; });
  return result;
}

} // namespace massprops
