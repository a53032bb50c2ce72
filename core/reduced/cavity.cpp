#include "core/reduced/cavity.h"

#include "core/base/parallel.h"
#include "core/mesh/components.h"
#include "core/mesh/hole_filling.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace massprops {
namespace {

/// Fewer connected faces than this, left over from a larger component, make no cavity worth
/// printing.
constexpr Eigen::Index kLeastFaces = 24;

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

Faces keptFaces(const Faces& faces, const std::vector<char>& solid) {
  Faces kept(faces.rows(), 3);
  Eigen::Index count = 0;
  for (Eigen::Index f = 0; f < faces.rows(); ++f) {
    if (!touches(faces, f, solid)) kept.row(count++) = faces.row(f);
  }
  return kept.topRows(count);
}

/// Marks the vertices of pieces that are too small; whole components are not, however coarse.
void markSmallPieces(const Faces& faces, std::vector<char>& solid) {
  const auto n = static_cast<Eigen::Index>(solid.size());
  for (const Faces& piece : connectedComponents(n, keptFaces(faces, solid))) {
    if (piece.rows() >= kLeastFaces || countEdges(n, piece).boundary == 0) continue;
    for (const int v : piece.reshaped()) solid[at(v)] = 1;
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

/// Triangles that close a hole; none when it cannot be closed without making the surface
/// non-manifold.
Faces cap(const Points& vertices, const Faces& faces, const VertexCorners& corners,
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
  const Submesh patch = submesh(vertices, faces(near, Eigen::all));
  const auto local = [&](int v) {
    const auto place = std::lower_bound(patch.vertexOf.begin(), patch.vertexOf.end(), v);
    return static_cast<int>(place - patch.vertexOf.begin());
  };
  std::vector<int> border(loop.size());
  std::transform(loop.begin(), loop.end(), border.begin(), local);
  return holeFilling(patch.mesh, border).unaryExpr([&](int v) { return patch.vertexOf[at(v)]; });
}

/// Triangles that close the holes of the kept faces; empty when one cannot be closed: its border is
/// then marked solid.
std::optional<Faces> caps(const Points& vertices, const Faces& faces, const VertexCorners& corners,
                          std::vector<char>& solid) {
  const std::vector<std::vector<int>> loops = holes(faces, corners, solid);
  std::vector<Faces> parts(loops.size());
  forChunks(static_cast<Eigen::Index>(loops.size()), 1, [&](const Chunk& chunk) {
    parts[at(chunk.begin)] = cap(vertices, faces, corners, solid, loops[at(chunk.begin)]);
  });
  bool isClosed = true;
  for (std::size_t i = 0; i < loops.size(); ++i) {
    if (parts[i].rows() > 0) continue;
    isClosed = false;
    // Retreat by one ring.
    for (const int v : loops[i]) solid[at(v)] = 1;
  }
  if (!isClosed) return std::nullopt;
  return joined(parts);
}

} // namespace

CavitySurface cavitySurface(const Points& vertices, const Faces& faces,
                            const VertexCorners& corners, std::vector<char> solid) {
  for (;;) {
    markIrregular(faces, corners, solid);
    if (std::none_of(solid.begin(), solid.end(), [](char mark) { return mark != 0; })) {
      return {faces, faces.rows(), std::move(solid)};
    }
    markSmallPieces(faces, solid);
    const std::optional<Faces> closing = caps(vertices, faces, corners, solid);
    if (!closing) continue;
    const Faces kept = keptFaces(faces, solid);
    return {joined({kept, *closing}), kept.rows(), std::move(solid)};
  }
}

} // namespace massprops
