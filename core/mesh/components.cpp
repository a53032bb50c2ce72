#include "core/mesh/components.h"

#include <boost/pending/disjoint_sets.hpp>

#include <utility>

namespace massprops {

std::vector<int> componentNumbers(Eigen::Index vertexCount, const Faces& faces) {
  const auto n = static_cast<std::size_t>(vertexCount);
  std::vector<int> rank(n);
  std::vector<int> parent(n);
  boost::disjoint_sets<int*, int*> sets(rank.data(), parent.data());
  for (int v = 0; v < static_cast<int>(vertexCount); ++v) sets.make_set(v);
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    sets.union_set(faces(f, 0), faces(f, 1));
    sets.union_set(faces(f, 0), faces(f, 2));
  }
  std::vector<int> label(n, -1);
  std::vector<int> labelOfSet(n, -1);
  int count = 0;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    int& number = labelOfSet[static_cast<std::size_t>(sets.find_set(faces(f, 0)))];
    if (number < 0) number = count++;
    for (const int v : faces.row(f)) label[static_cast<std::size_t>(v)] = number;
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
  Components result;
  if (sizes.size() == 1) {
    result.push_back(faces);
    return result;
  }
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

std::vector<Submesh> componentMeshes(const Points& vertices, const Faces& faces) {
  const std::vector<int> component = componentNumbers(vertices.rows(), faces);
  Components parts = connectedComponents(vertices.rows(), faces);
  std::vector<Submesh> result(parts.size());
  std::vector<int> number(component.size(), -1); // of a vertex in its component
  for (std::size_t v = 0; v < component.size(); ++v) {
    if (component[v] < 0) continue;
    std::vector<int>& vertexOf = result[static_cast<std::size_t>(component[v])].vertexOf;
    number[v] = static_cast<int>(vertexOf.size());
    vertexOf.push_back(static_cast<int>(v));
  }
  for (std::size_t c = 0; c < parts.size(); ++c) {
    const std::vector<int>& vertexOf = result[c].vertexOf;
    Points& points = result[c].mesh.vertices;
    points.resize(static_cast<Eigen::Index>(vertexOf.size()), 3);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      points.row(i) = vertices.row(vertexOf[static_cast<std::size_t>(i)]);
    }
    result[c].mesh.faces =
        parts[c].unaryExpr([&](int v) { return number[static_cast<std::size_t>(v)]; });
  }
  return result;
}

Faces joined(const std::vector<Faces>& parts) {
  Eigen::Index rows = 0;
  for (const Faces& part : parts) rows += part.rows();
  Faces result(rows, 3);
  rows = 0;
  for (const Faces& part : parts) {
    result.middleRows(rows, part.rows()) = part;
    rows += part.rows();
  }
  return result;
}

TriangleMesh assembled(const std::vector<TriangleMesh>& parts) {
  Eigen::Index vertices = 0;
  Eigen::Index faces = 0;
  for (const TriangleMesh& part : parts) {
    vertices += part.vertices.rows();
    faces += part.faces.rows();
  }
  TriangleMesh result{Points(vertices, 3), Faces(faces, 3)};
  vertices = faces = 0;
  for (const TriangleMesh& part : parts) {
    result.vertices.middleRows(vertices, part.vertices.rows()) = part.vertices;
    result.faces.middleRows(faces, part.faces.rows()) =
        part.faces.array() + static_cast<int>(vertices);
    vertices += part.vertices.rows();
    faces += part.faces.rows();
  }
  return result;
}

} // namespace massprops
