#include "core/repair.h"

#include "core/components.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <vector>

namespace massprops {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

bool isOpen(const Faces& faces) {
  std::map<std::pair<int, int>, int> uses;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      ++uses[std::minmax(faces(f, k), faces(f, (k + 1) % 3))];
    }
  }
  return std::any_of(uses.begin(), uses.end(), [](const auto& use) { return use.second == 1; });
}

/// Every vertex becomes the first one with the same coordinates. Returns how many changed.
int mergeCoincident(TriangleMesh& mesh) {
  std::vector<int> order(static_cast<std::size_t>(mesh.vertices.rows()));
  std::iota(order.begin(), order.end(), 0);
  const auto key = [&](int v) {
    return std::array<double, 3>{mesh.vertices(v, 0), mesh.vertices(v, 1), mesh.vertices(v, 2)};
  };
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return key(a) < key(b); });
  std::vector<int> first(order.size());
  int merged = 0;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
    const auto v = static_cast<std::size_t>(order[i]);
    first[v] = same ? first[static_cast<std::size_t>(order[i - 1])] : order[i];
    if (same) ++merged;
  }
  mesh.faces = mesh.faces.unaryExpr([&](int v) { return first[static_cast<std::size_t>(v)]; });
  return merged;
}

template <class Keep>
int keepFaces(Faces& faces, const Keep& keep) {
  Eigen::Index kept = 0;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    if (!keep(f)) continue;
    const Eigen::RowVector3i face = faces.row(f);
    faces.row(kept++) = face;
  }
  const auto removed = static_cast<int>(faces.rows() - kept);
  faces.conservativeResize(kept, 3);
  return removed;
}

int removeFacesWithACornerTwice(Faces& faces) {
  return keepFaces(faces, [&](Eigen::Index f) {
    return faces(f, 0) != faces(f, 1) && faces(f, 1) != faces(f, 2) && faces(f, 2) != faces(f, 0);
  });
}

/// Of faces with the same corners one stays; two that lie back to back bound nothing and both go.
int removeDuplicates(Faces& faces) {
  struct Copies {
    int forward = 0;
    int backward = 0;
    bool taken = false;
  };
  const auto sorted = [&](Eigen::Index f) {
    std::array<int, 3> corners{faces(f, 0), faces(f, 1), faces(f, 2)};
    std::sort(corners.begin(), corners.end());
    return corners;
  };
  const auto isForward = [&](Eigen::Index f) {
    const std::array<int, 3> corners = sorted(f);
    for (int k = 0; k < 3; ++k) {
      if (faces(f, k) == corners[0]) return faces(f, (k + 1) % 3) == corners[1];
    }
    return false;
  };
  std::map<std::array<int, 3>, Copies> copies;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    Copies& c = copies[sorted(f)];
    ++(isForward(f) ? c.forward : c.backward);
  }
  return keepFaces(faces, [&](Eigen::Index f) {
    Copies& c = copies[sorted(f)];
    if (c.forward > 0 && c.backward > 0) return false;
    return !std::exchange(c.taken, true);
  });
}

void append(std::string& text, int count, const char* singular, const char* plural,
            const char* done) {
  if (count == 0) return;
  if (!text.empty()) text += ", ";
  text += std::to_string(count) + " " + (count == 1 ? singular : plural) + " " + done;
}

} // namespace

std::string Repairs::describe() const {
  std::string text;
  append(text, mergedVertices, "duplicate vertex", "duplicate vertices", "merged");
  append(text, unusedVertices, "unused vertex", "unused vertices", "left out");
  append(text, zeroAreaFaces, "face without area", "faces without area", "removed");
  append(text, duplicateFaces, "duplicate face", "duplicate faces", "removed");
  append(text, turnedComponents, "component", "components", "turned round");
  append(text, replacedCavities, "existing cavity", "existing cavities", "replaced by the new one");
  return text.empty() ? "none" : text;
}

RepairedMesh mergedAndCompacted(const TriangleMesh& mesh) {
  RepairedMesh result{mesh, {}};
  Faces& faces = result.mesh.faces;
  Repairs& repairs = result.repairs;
  repairs.zeroAreaFaces += removeFacesWithACornerTwice(faces);
  if (isOpen(faces)) {
    repairs.mergedVertices = mergeCoincident(result.mesh);
    repairs.zeroAreaFaces += removeFacesWithACornerTwice(faces);
  }
  repairs.duplicateFaces = removeDuplicates(faces);
  const Eigen::Index before = result.mesh.vertices.rows();
  result.mesh = submesh(result.mesh.vertices, faces).mesh;
  repairs.unusedVertices =
      static_cast<int>(before - result.mesh.vertices.rows()) - repairs.mergedVertices;
  return result;
}

RepairedMesh withoutZeroAreaFaces(RepairedMesh input) {
  Mesh mesh;
  const TriangleMesh& old = input.mesh;
  for (Eigen::Index v = 0; v < old.vertices.rows(); ++v) {
    mesh.add_vertex({old.vertices(v, 0), old.vertices(v, 1), old.vertices(v, 2)});
  }
  const auto vertex = [](int v) { return Mesh::Vertex_index(static_cast<Mesh::size_type>(v)); };
  for (Eigen::Index f = 0; f < old.faces.rows(); ++f) {
    mesh.add_face(vertex(old.faces(f, 0)), vertex(old.faces(f, 1)), vertex(old.faces(f, 2)));
  }
  const auto degenerate = [&] {
    return static_cast<int>(
        std::count_if(mesh.faces_begin(), mesh.faces_end(), [&](Mesh::Face_index f) {
          return CGAL::Polygon_mesh_processing::is_degenerate_triangle_face(f, mesh);
        }));
  };
  const int before = degenerate();
  if (before == 0) return input;
  CGAL::Polygon_mesh_processing::remove_degenerate_faces(mesh);
  mesh.collect_garbage();
  input.repairs.zeroAreaFaces += before - degenerate();
  input.mesh.vertices.resize(static_cast<Eigen::Index>(mesh.number_of_vertices()), 3);
  for (const Mesh::Vertex_index v : mesh.vertices()) {
    const Kernel::Point_3& p = mesh.point(v);
    input.mesh.vertices.row(static_cast<Eigen::Index>(v.idx())) << p.x(), p.y(), p.z();
  }
  input.mesh.faces.resize(static_cast<Eigen::Index>(mesh.number_of_faces()), 3);
  for (const Mesh::Face_index f : mesh.faces()) {
    int k = 0;
    for (const Mesh::Vertex_index v : mesh.vertices_around_face(mesh.halfedge(f))) {
      input.mesh.faces(static_cast<Eigen::Index>(f.idx()), k++) = static_cast<int>(v.idx());
    }
  }
  return input;
}

} // namespace massprops
