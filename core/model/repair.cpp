#include "core/model/repair.h"

#include "core/base/parallel.h"
#include "core/mesh/cgal_mesh.h"
#include "core/mesh/components.h"
#include "core/mesh/connectivity.h"
#include "core/mesh/degenerate_faces.h"

#include <CGAL/Polygon_mesh_processing/repair_degeneracies.h>
#include <CGAL/Polygon_mesh_processing/shape_predicates.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <vector>

namespace massprops {
namespace {

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
int removeDuplicates(Eigen::Index vertexCount, Faces& faces) {
  struct Corners {
    int middle, largest; ///< in ascending order after the smallest
    bool backward;
    int face;
  };
  const VertexCorners at = vertexCorners(vertexCount, faces);
  std::vector<char> remove(static_cast<std::size_t>(faces.rows()), 0);
  constexpr Eigen::Index kChunk = 4096;
  // Every face is met at its smallest vertex.
  forChunks(vertexCount, kChunk, [&](const Chunk& chunk) {
    std::vector<Corners> same;
    for (Eigen::Index v = chunk.begin; v < chunk.end; ++v) {
      same.clear();
      for (const int c : at.at(v)) {
        const int next = faces.data()[nextHalfEdge(c)];
        const int previous = faces.data()[previousHalfEdge(c)];
        if (next < v || previous < v) continue;
        same.push_back(
            {std::min(next, previous), std::max(next, previous), previous < next, c / 3});
      }
      std::sort(same.begin(), same.end(), [](const Corners& a, const Corners& b) {
        return std::tie(a.middle, a.largest, a.face) < std::tie(b.middle, b.largest, b.face);
      });
      for (std::size_t i = 0; i < same.size();) {
        std::size_t end = i;
        bool hasForward = false;
        bool hasBackward = false;
        for (; end < same.size() && same[end].middle == same[i].middle &&
               same[end].largest == same[i].largest;
             ++end) {
          (same[end].backward ? hasBackward : hasForward) = true;
        }
        for (std::size_t j = i; j < end; ++j) {
          const bool goes = j > i || (hasForward && hasBackward);
          remove[static_cast<std::size_t>(same[j].face)] = goes ? 1 : 0;
        }
        i = end;
      }
    }
  });
  return keepFaces(faces, [&](Eigen::Index f) { return remove[static_cast<std::size_t>(f)] == 0; });
}

void append(std::string& text, int count, const char* singular, const char* plural,
            const char* done) {
  if (count == 0) return;
  if (!text.empty()) text += ", ";
  text += std::to_string(count) + " " + (count == 1 ? singular : plural) + " " + done;
}

} // namespace

Repairs& Repairs::operator+=(const Repairs& before) {
  unusedVertices += before.unusedVertices;
  mergedVertices += before.mergedVertices;
  zeroAreaFaces += before.zeroAreaFaces;
  duplicateFaces += before.duplicateFaces;
  flippedComponents += before.flippedComponents;
  replacedCavities += before.replacedCavities;
  mended = before.mended + (before.mended.empty() || mended.empty() ? "" : ", ") + mended;
  distance = std::max(distance, before.distance);
  if (warning.empty()) warning = before.warning;
  return *this;
}

std::string Repairs::describe() const {
  std::string text;
  append(text, mergedVertices, "duplicate vertex", "duplicate vertices", "merged");
  append(text, unusedVertices, "unused vertex", "unused vertices", "left out");
  append(text, zeroAreaFaces, "face without area", "faces without area", "removed");
  append(text, duplicateFaces, "duplicate face", "duplicate faces", "removed");
  append(text, flippedComponents, "component", "components", "flipped");
  append(text, replacedCavities, "existing cavity", "existing cavities", "replaced by the new one");
  if (!mended.empty()) text += (text.empty() ? "" : ", ") + mended;
  return text.empty() ? "none" : text;
}

RepairedMesh mergedAndCompacted(TriangleMesh mesh) {
  RepairedMesh result{std::move(mesh), {}};
  Faces& faces = result.mesh.faces;
  Repairs& repairs = result.repairs;
  repairs.zeroAreaFaces += removeFacesWithACornerTwice(faces);
  if (countEdges(result.mesh.vertices.rows(), faces).boundary > 0) {
    repairs.mergedVertices = mergeCoincident(result.mesh);
    repairs.zeroAreaFaces += removeFacesWithACornerTwice(faces);
  }
  repairs.duplicateFaces = removeDuplicates(result.mesh.vertices.rows(), faces);
  const Eigen::Index before = result.mesh.vertices.rows();
  result.mesh = submesh(result.mesh.vertices, faces).mesh;
  repairs.unusedVertices =
      static_cast<int>(before - result.mesh.vertices.rows()) - repairs.mergedVertices;
  return result;
}

RepairedMesh withoutZeroAreaFaces(RepairedMesh input) {
  if (facesWithoutArea(input.mesh.vertices, input.mesh.faces).empty()) return input;
  auto mesh = surfaceMesh(input.mesh.vertices, input.mesh.faces);
  const auto degenerate = [&] {
    return static_cast<int>(
        std::count_if(mesh.faces_begin(), mesh.faces_end(), [&](SurfaceMesh::Face_index f) {
          return CGAL::Polygon_mesh_processing::is_degenerate_triangle_face(f, mesh);
        }));
  };
  const int before = degenerate();
  if (before == 0) return input;
  CGAL::Polygon_mesh_processing::remove_degenerate_faces(mesh);
  mesh.collect_garbage();
  input.repairs.zeroAreaFaces += before - degenerate();
  const TriangleMesh rest = triangleMesh(mesh);
  input.mesh = submesh(rest.vertices, rest.faces).mesh;
  return input;
}

} // namespace massprops
