#include "core/cavity.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <optional>

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
/// Only vertices next to solid ones can be such.
void markIrregular(const Faces& faces, const VertexCorners& corners, std::vector<char>& solid) {
  const int* corner = faces.data();
  std::vector<int> stack;
  const auto pushNeighbours = [&](Eigen::Index v) {
    for (const int c : corners.at(v)) {
      const int w = corner[nextHalfEdge(c)];
      if (solid[at(w)] == 0) stack.push_back(w);
    }
  };
  for (Eigen::Index v = static_cast<Eigen::Index>(solid.size()) - 1; v >= 0; --v) {
    if (corners.at(v).size() == 0) solid[at(v)] = 1;
    if (solid[at(v)] != 0) pushNeighbours(v);
  }
  while (!stack.empty()) {
    const int v = stack.back();
    stack.pop_back();
    if (solid[at(v)] != 0) continue;
    // Kept faces go from one neighbour to the next; starts without a predecessor open a fan.
    bool isUsed = false;
    int openings = 0;
    for (const int c : corners.at(v)) {
      if (touches(faces, c / 3, solid)) continue;
      isUsed = true;
      const int from = corner[nextHalfEdge(c)];
      const auto precedes = [&](int other) {
        return corner[previousHalfEdge(other)] == from && !touches(faces, other / 3, solid);
      };
      const IndexRange all = corners.at(v);
      if (std::none_of(all.begin(), all.end(), precedes)) ++openings;
    }
    if (isUsed && openings <= 1) continue;
    solid[at(v)] = 1;
    pushNeighbours(v);
  }
}

/// Marks the vertices of pieces that are too small; whole components are not, however coarse.
void markSmallPieces(const Faces& faces, const VertexCorners& corners, std::vector<char>& solid) {
  const int* corner = faces.data();
  std::vector<int> piece(solid.size(), -1);
  std::vector<std::size_t> faceCount;
  std::vector<char> isTrimmed;
  std::vector<Eigen::Index> stack;
  for (std::size_t seed = 0; seed < solid.size(); ++seed) {
    if (solid[seed] != 0 || piece[seed] >= 0) continue;
    char trimmed = 0;
    stack.assign(1, static_cast<Eigen::Index>(seed));
    piece[seed] = static_cast<int>(faceCount.size());
    while (!stack.empty()) {
      const Eigen::Index v = stack.back();
      stack.pop_back();
      for (const int c : corners.at(v)) {
        const int w = corner[nextHalfEdge(c)];
        if (solid[at(w)] != 0) {
          trimmed = 1;
        } else if (piece[at(w)] < 0) {
          piece[at(w)] = static_cast<int>(faceCount.size());
          stack.push_back(w);
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
    const bool hasPiece = solid[v] == 0 && piece[v] >= 0;
    if (hasPiece && isTrimmed[at(piece[v])] != 0 && faceCount[at(piece[v])] < kLeastFaces) {
      solid[v] = 1;
    }
  }
}

/// Triangles that close the holes of the kept faces; empty when a hole cannot be closed without
/// doubling an edge: its border is then marked solid.
std::optional<std::vector<int>> caps(const Points& vertices, const Faces& faces,
                                     const VertexCorners& corners, std::vector<char>& solid) {
  const int* corner = faces.data();
  // The kept faces around the borders are all that closing a hole has to know.
  std::vector<Eigen::Index> near;
  for (std::size_t v = 0; v < solid.size(); ++v) {
    if (solid[v] != 0) continue;
    const IndexRange all = corners.at(static_cast<Eigen::Index>(v));
    const bool isBorder = std::any_of(
        all.begin(), all.end(), [&](int c) { return solid[at(corner[nextHalfEdge(c)])] != 0; });
    if (!isBorder) continue;
    for (const int c : all) {
      if (!touches(faces, c / 3, solid)) near.push_back(c / 3);
    }
  }
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());

  Mesh mesh;
  std::vector<int> vertexOf;
  for (const Eigen::Index f : near) {
    for (const int v : faces.row(f)) vertexOf.push_back(v);
  }
  std::sort(vertexOf.begin(), vertexOf.end());
  vertexOf.erase(std::unique(vertexOf.begin(), vertexOf.end()), vertexOf.end());
  for (const int v : vertexOf) mesh.add_vertex({vertices(v, 0), vertices(v, 1), vertices(v, 2)});
  const auto local = [&](int v) {
    const auto place = std::lower_bound(vertexOf.begin(), vertexOf.end(), v) - vertexOf.begin();
    return Mesh::Vertex_index(static_cast<Mesh::size_type>(place));
  };
  const auto whole = [&](Mesh::Vertex_index v) { return vertexOf[v.idx()]; };
  for (const Eigen::Index f : near) {
    if (mesh.add_face(local(faces(f, 0)), local(faces(f, 1)), local(faces(f, 2))) ==
        Mesh::null_face()) {
      for (const int v : faces.row(f)) solid[at(v)] = 1;
      return std::nullopt;
    }
  }
  // A border of these faces is one of the cavity where the face beyond is not kept.
  const auto isHole = [&](Mesh::Halfedge_index h) {
    const int from = whole(mesh.source(h));
    const int to = whole(mesh.target(h));
    const IndexRange all = corners.at(from);
    return std::any_of(all.begin(), all.end(), [&](int c) {
      return corner[nextHalfEdge(c)] == to && touches(faces, c / 3, solid);
    });
  };
  std::vector<Mesh::Halfedge_index> borders;
  CGAL::Polygon_mesh_processing::extract_boundary_cycles(mesh, std::back_inserter(borders));
  std::vector<int> triangles;
  bool isClosed = true;
  for (const Mesh::Halfedge_index border : borders) {
    if (!isHole(border)) continue;
    std::vector<int> loop;
    for (const auto h : CGAL::halfedges_around_face(border, mesh)) {
      loop.push_back(whole(mesh.target(h)));
    }
    std::vector<Mesh::Face_index> cap;
    // The least area takes time up to the cube of the border's length: a long border is first tried
    // in a plane, a very long one only there and among the triangles of a Delaunay triangulation.
    constexpr std::size_t kLong = 48;
    constexpr std::size_t kVeryLong = 128;
    CGAL::Polygon_mesh_processing::triangulate_hole(
        mesh, border, std::back_inserter(cap),
        CGAL::parameters::use_2d_constrained_delaunay_triangulation(loop.size() > kLong)
            .do_not_use_cubic_algorithm(loop.size() > kVeryLong));
    if (cap.empty()) {
      // Retreat by one ring.
      for (const int v : loop) solid[at(v)] = 1;
      isClosed = false;
    }
    for (const Mesh::Face_index f : cap) {
      for (const Mesh::Vertex_index v : mesh.vertices_around_face(mesh.halfedge(f))) {
        triangles.push_back(whole(v));
      }
    }
  }
  if (!isClosed) return std::nullopt;
  return triangles;
}

} // namespace

CavitySurface cavitySurface(const Points& vertices, const Faces& faces,
                            const VertexCorners& corners, std::vector<char> solid) {
  for (;;) {
    markIrregular(faces, corners, solid);
    if (std::none_of(solid.begin(), solid.end(), [](char mark) { return mark != 0; })) {
      return {faces, std::move(solid)};
    }
    markSmallPieces(faces, corners, solid);
    const std::optional<std::vector<int>> closing = caps(vertices, faces, corners, solid);
    if (!closing) continue;

    Eigen::Index kept = 0;
    for (Eigen::Index f = 0; f < faces.rows(); ++f) kept += touches(faces, f, solid) ? 0 : 1;
    const auto added = static_cast<Eigen::Index>(closing->size() / 3);
    CavitySurface cavity;
    cavity.faces.resize(kept + added, 3);
    Eigen::Index row = 0;
    for (Eigen::Index f = 0; f < faces.rows(); ++f) {
      if (!touches(faces, f, solid)) cavity.faces.row(row++) = faces.row(f);
    }
    cavity.faces.bottomRows(added) = Eigen::Map<const Faces>(closing->data(), added, 3);
    cavity.solid = std::move(solid);
    return cavity;
  }
}

CavitySurface cavitySurface(const Points& vertices, const Faces& faces, std::vector<char> solid) {
  return cavitySurface(vertices, faces, vertexCorners(vertices.rows(), faces), std::move(solid));
}

} // namespace massprops
