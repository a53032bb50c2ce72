#include "core/mesh/connectivity.h"

#include "core/base/parallel.h"

#include <algorithm>

namespace massprops {

namespace {

/// The corners that `isListed`.
template <class Listed>
VertexCorners listOfCorners(Eigen::Index vertexCount, const Faces& faces, const Listed& isListed) {
  VertexCorners result;
  std::vector<int>& begin = result.begin;
  begin.assign(static_cast<std::size_t>(vertexCount) + 1, 0);
  const int* corner = faces.data();
  const auto count = static_cast<int>(faces.size());
  for (int i = 0; i < count; ++i) {
    if (isListed(i)) ++begin[static_cast<std::size_t>(corner[i]) + 1];
  }
  for (std::size_t v = 1; v < begin.size(); ++v) begin[v] += begin[v - 1];
  result.corners.resize(static_cast<std::size_t>(begin.back()));
  for (int i = 0; i < count; ++i) {
    if (!isListed(i)) continue;
    int& at = begin[static_cast<std::size_t>(corner[i])];
    result.corners[static_cast<std::size_t>(at++)] = i;
  }
  // Each has become the next one's.
  std::copy_backward(begin.begin(), begin.end() - 1, begin.end());
  begin.front() = 0;
  return result;
}

} // namespace

VertexCorners vertexCorners(Eigen::Index vertexCount, const Faces& faces) {
  return listOfCorners(vertexCount, faces, [](int) { return true; });
}

std::vector<int> oppositeHalfEdges(const VertexCorners& corners, const Faces& faces) {
  const int* corner = faces.data();
  std::vector<int> opposite(static_cast<std::size_t>(faces.size()), -1);
  constexpr Eigen::Index kChunk = 32768;
  forChunks(faces.size(), kChunk, [&](const Chunk& chunk) {
    for (Eigen::Index h = chunk.begin; h < chunk.end; ++h) {
      const int from = corner[h];
      const int to = corner[nextHalfEdge(static_cast<int>(h))];
      if (from > to) continue; // the other one finds it
      for (const int other : corners.at(to)) {
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

std::vector<int> oppositeHalfEdges(Eigen::Index vertexCount, const Faces& faces) {
  // Only those to smaller indices are looked for.
  const int* corner = faces.data();
  return oppositeHalfEdges(
      listOfCorners(vertexCount, faces,
                    [corner](int h) { return corner[h] > corner[nextHalfEdge(h)]; }),
      faces);
}

EdgeCounts countEdges(Eigen::Index vertexCount, const Faces& faces) {
  const VertexCorners at = vertexCorners(vertexCount, faces);
  const int* corner = faces.data();
  constexpr Eigen::Index kChunk = 8192;
  std::vector<EdgeCounts> parts(static_cast<std::size_t>(chunkCount(vertexCount, kChunk)));
  forChunks(vertexCount, kChunk, [&](const Chunk& chunk) {
    EdgeCounts& counts = parts[static_cast<std::size_t>(chunk.number)];
    // Where the edges from and to a vertex lead, larger indices only: each edge is met once.
    std::vector<int> from;
    std::vector<int> to;
    for (Eigen::Index v = chunk.begin; v < chunk.end; ++v) {
      from.clear();
      to.clear();
      for (const int c : at.at(v)) {
        const int next = corner[nextHalfEdge(c)];
        const int previous = corner[previousHalfEdge(c)];
        if (next > v) from.push_back(next);
        if (previous > v) to.push_back(previous);
      }
      std::sort(from.begin(), from.end());
      std::sort(to.begin(), to.end());
      for (auto f = from.begin(), t = to.begin(); f != from.end() || t != to.end();) {
        const int end = t == to.end() || (f != from.end() && *f < *t) ? *f : *t;
        int forward = 0;
        int backward = 0;
        for (; f != from.end() && *f == end; ++f) ++forward;
        for (; t != to.end() && *t == end; ++t) ++backward;
        if (forward + backward == 1) ++counts.boundary;
        if (forward + backward > 2) ++counts.nonManifold;
        if (forward + backward == 2 && forward != backward) ++counts.incoherent;
      }
    }
  });
  EdgeCounts all;
  for (const EdgeCounts& part : parts) {
    all.boundary += part.boundary;
    all.nonManifold += part.nonManifold;
    all.incoherent += part.incoherent;
  }
  return all;
}

} // namespace massprops
