#include "core/mesh/components.h"

#include <algorithm>
#include <numeric>

namespace massprops {

std::vector<int> componentNumbers(Eigen::Index vertexCount, const Faces& faces) {
  // Sets of vertices, each known by its least member; faces unite them.
  std::vector<int> parent(static_cast<std::size_t>(vertexCount));
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int v) {
    auto i = static_cast<std::size_t>(v);
    while (parent[i] != static_cast<int>(i)) {
      parent[i] = parent[static_cast<std::size_t>(parent[i])];
      i = static_cast<std::size_t>(parent[i]);
    }
    return static_cast<int>(i);
  };
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    const int roots[3] = {root(faces(f, 0)), root(faces(f, 1)), root(faces(f, 2))};
    const int least = std::min({roots[0], roots[1], roots[2]});
    for (const int r : roots) parent[static_cast<std::size_t>(r)] = least;
  }
  std::vector<int> label(parent.size(), -1);
  int count = 0;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    int& ofRoot = label[static_cast<std::size_t>(root(faces(f, 0)))];
    if (ofRoot < 0) ofRoot = count++;
    for (const int v : faces.row(f)) label[static_cast<std::size_t>(v)] = ofRoot;
  }
  return label;
}

Components connectedComponents(Eigen::Index vertexCount, const Faces& faces) {
  const std::vector<int> number = componentNumbers(vertexCount, faces);
  std::vector<Eigen::Index> sizes;
  const auto of = [&](Eigen::Index f) {
    return static_cast<std::size_t>(number[static_cast<std::size_t>(faces(f, 0))]);
  };
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    if (sizes.size() <= of(f)) sizes.resize(of(f) + 1, 0);
    ++sizes[of(f)];
  }
  if (sizes.size() == 1) return {faces};
  Components result;
  for (Eigen::Index& size : sizes) {
    result.emplace_back(size, 3);
    size = 0;
  }
  for (Eigen::Index f = 0; f < faces.rows(); ++f) result[of(f)].row(sizes[of(f)]++) = faces.row(f);
  return result;
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
