#include "core/reduced/cavity.h"

#include "core/base/parallel.h"
#include "core/mesh/hole_filling.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace massprops {
namespace {

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

/// The vertices around each hole, in the sense of the faces that are left out. \pre regular marks
std::vector<std::vector<int>> holes(const Faces& faces, const VertexCorners& corners,
                                    const std::vector<char>& solid) {
  const int* corner = faces.data();
  const auto isKeptBeyond = [&](int from, int to) {
    const IndexRange all = corners.at(to);
    return std::any_of(all.begin(), all.end(), [&](int c) {
      return corner[nextHalfEdge(c)] == from && !touches(faces, c / 3, solid);
    });
  };
  // Every border vertex has one fan of kept faces, and so one border edge that leaves it.
  std::vector<int> after(solid.size(), -1);
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int from = faces(f, (k + 1) % 3);
      const int to = faces(f, (k + 2) % 3);
      const bool isLeftOut = solid[at(faces(f, k))] != 0 && solid[at(from)] == 0;
      if (isLeftOut && solid[at(to)] == 0 && isKeptBeyond(from, to)) after[at(from)] = to;
    }
  }
  std::vector<std::vector<int>> loops;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    for (int k = 0; k < 3; ++k) {
      const int first = faces(f, (k + 1) % 3);
      if (after[at(first)] != faces(f, k)) continue;
      loops.emplace_back();
      for (int v = first; after[at(v)] >= 0;) {
        loops.back().push_back(v);
        v = std::exchange(after[at(v)], -1);
      }
    }
  }
  return loops;
}

/// Triangles that close a hole, three corners each; none when it cannot be closed without making
/// the surface non-manifold.
std::vector<int> cap(const Points& vertices, const Faces& faces, const VertexCorners& corners,
                     const std::vector<char>& solid, const std::vector<int>& loop) {
  // The kept faces around its border are all that closing a hole has to know.
  std::vector<Eigen::Index> near;
  for (const int v : loop) {
    for (const int c : corners.at(v)) {
      if (!touches(faces, c / 3, solid)) near.push_back(c / 3);
    }
  }
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  std::vector<int> vertexOf;
  for (const Eigen::Index f : near) {
    for (const int v : faces.row(f)) vertexOf.push_back(v);
  }
  std::sort(vertexOf.begin(), vertexOf.end());
  vertexOf.erase(std::unique(vertexOf.begin(), vertexOf.end()), vertexOf.end());

  const auto local = [&](int v) {
    return static_cast<int>(std::lower_bound(vertexOf.begin(), vertexOf.end(), v) -
                            vertexOf.begin());
  };
  TriangleMesh patch{Points(static_cast<Eigen::Index>(vertexOf.size()), 3),
                     Faces(static_cast<Eigen::Index>(near.size()), 3)};
  for (std::size_t i = 0; i < vertexOf.size(); ++i) {
    patch.vertices.row(static_cast<Eigen::Index>(i)) = vertices.row(vertexOf[i]);
  }
  for (std::size_t i = 0; i < near.size(); ++i) {
    patch.faces.row(static_cast<Eigen::Index>(i)) = faces.row(near[i]).unaryExpr(local);
  }
  std::vector<int> border(loop.size());
  std::transform(loop.begin(), loop.end(), border.begin(), local);
  const Faces added = holeFilling(patch, border);
  std::vector<int> triangles(at(added.size()));
  std::transform(added.data(), added.data() + added.size(), triangles.begin(),
                 [&](int v) { return vertexOf[at(v)]; });
  return triangles;
}

/// Triangles that close the holes of the kept faces; empty when one cannot be closed: its border is
/// then marked solid.
std::optional<std::vector<int>> caps(const Points& vertices, const Faces& faces,
                                     const VertexCorners& corners, std::vector<char>& solid) {
  const std::vector<std::vector<int>> loops = holes(faces, corners, solid);
  std::vector<std::vector<int>> triangles(loops.size());
  forChunks(static_cast<Eigen::Index>(loops.size()), 1, [&](const Chunk& chunk) {
    triangles[at(chunk.begin)] = cap(vertices, faces, corners, solid, loops[at(chunk.begin)]);
  });
  bool isClosed = true;
  std::vector<int> all;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    all.insert(all.end(), triangles[i].begin(), triangles[i].end());
    if (!triangles[i].empty()) continue;
    isClosed = false;
    // Retreat by one ring.
    for (const int v : loops[i]) solid[at(v)] = 1;
  }
  if (!isClosed) return std::nullopt;
  return all;
}

} // namespace

CavitySurface cavitySurface(const Points& vertices, const Faces& faces,
                            const VertexCorners& corners, std::vector<char> solid) {
  for (;;) {
    markIrregular(faces, corners, solid);
    if (std::none_of(solid.begin(), solid.end(), [](char mark) { return mark != 0; })) {
      return {faces, faces.rows(), std::move(solid)};
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
    cavity.firstCapFace = kept;
    cavity.solid = std::move(solid);
    return cavity;
  }
}

} // namespace massprops
