#include "core/half_edges.h"

#include "core/parallel.h"

#include <algorithm>
#include <atomic>
#include <utility>

namespace massprops {

VertexCorners vertexCorners(Eigen::Index vertexCount, const Faces& faces) {
  VertexCorners result;
  result.begin.assign(static_cast<std::size_t>(vertexCount) + 1, 0);
  const int* corner = faces.data();
  for (Eigen::Index i = 0; i < faces.size(); ++i) {
    ++result.begin[static_cast<std::size_t>(corner[i]) + 1];
  }
  for (std::size_t v = 1; v < result.begin.size(); ++v) result.begin[v] += result.begin[v - 1];
  result.corners.resize(static_cast<std::size_t>(faces.size()));
  std::vector<int> end(result.begin.begin(), result.begin.end() - 1);
  for (Eigen::Index i = 0; i < faces.size(); ++i) {
    int& at = end[static_cast<std::size_t>(corner[i])];
    result.corners[static_cast<std::size_t>(at++)] = static_cast<int>(i);
  }
  return result;
}

std::vector<int> oppositeHalfEdges(Eigen::Index vertexCount, const Faces& faces) {
  const VertexCorners at = vertexCorners(vertexCount, faces);
  const int* corner = faces.data();
  std::vector<int> opposite(static_cast<std::size_t>(faces.size()), -1);
  constexpr Eigen::Index kChunk = 32768;
  forChunks(faces.size(), kChunk, [&](const Chunk& chunk) {
    for (Eigen::Index h = chunk.begin; h < chunk.end; ++h) {
      const int from = corner[h];
      const int to = corner[nextHalfEdge(static_cast<int>(h))];
      if (from > to) continue; // the other one finds it
      for (const int other : at.at(to)) {
        if (corner[nextHalfEdge(other)] == from) {
          opposite[static_cast<std::size_t>(h)] = other;
          opposite[static_cast<std::size_t>(other)] = static_cast<int>(h);
          break;
        }
      }
    }
  });
  return opposite;
}

bool hasTwoFacesAtEveryEdge(Eigen::Index vertexCount, const Faces& faces) {
  const VertexCorners at = vertexCorners(vertexCount, faces);
  const int* corner = faces.data();
  std::atomic<bool> isSo = true;
  constexpr Eigen::Index kChunk = 8192;
  forChunks(vertexCount, kChunk, [&](const Chunk& chunk) {
    // What the edges from and to a vertex lead to.
    std::vector<int> from;
    std::vector<int> to;
    for (Eigen::Index v = chunk.begin; v < chunk.end && isSo; ++v) {
      from.clear();
      to.clear();
      for (const int c : at.at(v)) {
        from.push_back(corner[nextHalfEdge(c)]);
        to.push_back(corner[previousHalfEdge(c)]);
      }
      std::sort(from.begin(), from.end());
      std::sort(to.begin(), to.end());
      if (from != to || std::adjacent_find(from.begin(), from.end()) != from.end()) isSo = false;
    }
  });
  return isSo;
}

std::vector<EdgeUse> edgeUses(Eigen::Index vertexCount, const Faces& faces) {
  const VertexCorners at = vertexCorners(vertexCount, faces);
  const int* corner = faces.data();
  std::vector<EdgeUse> uses;
  uses.reserve(static_cast<std::size_t>(faces.size() / 2));
  std::vector<std::pair<int, int>> ends; // the larger index, and whether the face runs backwards
  for (Eigen::Index v = 0; v < vertexCount; ++v) {
    ends.clear();
    for (const int c : at.at(v)) {
      const int next = corner[nextHalfEdge(c)];
      const int previous = corner[previousHalfEdge(c)];
      if (next > v) ends.emplace_back(next, 0);
      if (previous > v) ends.emplace_back(previous, 1);
    }
    std::sort(ends.begin(), ends.end());
    for (std::size_t i = 0; i < ends.size(); ++i) {
      if (i == 0 || ends[i].first != ends[i - 1].first) uses.emplace_back();
      ++(ends[i].second == 0 ? uses.back().forward : uses.back().backward);
    }
  }
  return uses;
}

} // namespace massprops
