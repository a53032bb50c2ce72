#include "core/cavity.h"

#include "core/graph.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>

namespace massprops {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// Fewer connected faces than this, left over from a larger component, make no cavity worth
/// printing.
constexpr std::size_t kLeastFaces = 24;

std::size_t at(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

bool touches(const Faces& faces, Eigen::Index f, const std::vector<char>& solid) {
  return solid[at(faces(f, 0))] != 0 || solid[at(faces(f, 1))] != 0 || solid[at(faces(f, 2))] != 0;
}

/// Marks vertices that no kept face uses, and those where kept faces meet in more than one fan.
/// Returns whether anything changed.
bool markIrregular(const Faces& faces, std::vector<char>& solid) {
  // Around a vertex with one open fan exactly two kept faces have a border edge at it.
  std::vector<int> kept(solid.size(), 0);
  std::vector<std::vector<std::pair<int, int>>> links(solid.size());
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    if (touches(faces, f, solid)) continue;
    for (int k = 0; k < 3; ++k) {
      ++kept[at(faces(f, k))];
      links[at(faces(f, k))].emplace_back(faces(f, (k + 1) % 3), faces(f, (k + 2) % 3));
    }
  }
  bool changed = false;
  for (std::size_t v = 0; v < solid.size(); ++v) {
    if (solid[v] != 0) continue;
    // Each link edge goes from one neighbour to the next; starts without a predecessor open a fan.
    int openings = 0;
    for (const auto& [from, to] : links[v]) {
      const bool hasPredecessor =
          std::any_of(links[v].begin(), links[v].end(),
                      [start = from](const auto& l) { return l.second == start; });
      if (!hasPredecessor) ++openings;
    }
    if (kept[v] == 0 || openings > 1) {
      solid[v] = 1;
      changed = true;
    }
  }
  return changed;
}

/// Marks the vertices of pieces that are too small; whole components are not, however coarse.
void markSmallPieces(const Faces& faces, std::vector<char>& solid) {
  std::vector<int> piece(solid.size(), -1);
  const Neighbours neighbours = vertexNeighbours(static_cast<Eigen::Index>(solid.size()), faces);
  std::vector<std::size_t> faceCount;
  std::vector<char> isTrimmed;
  for (std::size_t seed = 0; seed < solid.size(); ++seed) {
    if (solid[seed] != 0 || piece[seed] >= 0) continue;
    char trimmed = 0;
    std::vector<std::size_t> stack{seed};
    piece[seed] = static_cast<int>(faceCount.size());
    while (!stack.empty()) {
      const std::size_t v = stack.back();
      stack.pop_back();
      for (const int w : neighbours[v]) {
        if (solid[at(w)] != 0) {
          trimmed = 1;
        } else if (piece[at(w)] < 0) {
          piece[at(w)] = static_cast<int>(faceCount.size());
          stack.push_back(at(w));
        }
      }
    }
    faceCount.push_back(0);
    isTrimmed.push_back(trimmed);
  }
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    if (!touches(faces, f, solid)) ++faceCount[at(piece[at(faces(f, 0))])];
  }
  for (std::size_t v = 0; v < solid.size(); ++v) {
    if (solid[v] != 0) continue;
    const std::size_t p = at(piece[v]);
    if (isTrimmed[p] != 0 && faceCount[p] < kLeastFaces) solid[v] = 1;
  }
}

} // namespace

CavitySurface cavitySurface(const Points& vertices, const Faces& faces, std::vector<char> solid) {
  for (;;) {
    while (markIrregular(faces, solid)) {
    }
    markSmallPieces(faces, solid);

    Mesh mesh;
    for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
      mesh.add_vertex({vertices(v, 0), vertices(v, 1), vertices(v, 2)});
    }
    for (Eigen::Index f = 0; f < faces.rows(); ++f) {
      if (touches(faces, f, solid)) continue;
      mesh.add_face(Mesh::Vertex_index(static_cast<Mesh::size_type>(faces(f, 0))),
                    Mesh::Vertex_index(static_cast<Mesh::size_type>(faces(f, 1))),
                    Mesh::Vertex_index(static_cast<Mesh::size_type>(faces(f, 2))));
    }
    std::vector<Mesh::Halfedge_index> borders;
    CGAL::Polygon_mesh_processing::extract_boundary_cycles(mesh, std::back_inserter(borders));
    bool closed = true;
    for (const Mesh::Halfedge_index border : borders) {
      std::vector<std::size_t> loop;
      for (const auto h : CGAL::halfedges_around_face(border, mesh)) {
        loop.push_back(static_cast<std::size_t>(mesh.target(h).idx()));
      }
      std::vector<Mesh::Face_index> cap;
      CGAL::Polygon_mesh_processing::triangulate_hole(mesh, border, std::back_inserter(cap));
      if (cap.empty()) {
        // No triangulation without doubled edges: retreat by one ring.
        for (const std::size_t v : loop) solid[v] = 1;
        closed = false;
      }
    }
    if (!closed) continue;

    CavitySurface cavity;
    cavity.solid = std::move(solid);
    cavity.faces.resize(static_cast<Eigen::Index>(mesh.number_of_faces()), 3);
    Eigen::Index row = 0;
    for (const Mesh::Face_index f : mesh.faces()) {
      int k = 0;
      for (const Mesh::Vertex_index v : mesh.vertices_around_face(mesh.halfedge(f))) {
        cavity.faces(row, k++) = static_cast<int>(v.idx());
      }
      ++row;
    }
    return cavity;
  }
}

} // namespace massprops
