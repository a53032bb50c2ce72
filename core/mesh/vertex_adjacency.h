// Which vertices of a mesh are joined by edges.
#pragma once

#include "core/base/types.h"

#include <vector>

namespace massprops {

/// For every vertex its neighbours, ascending.
class VertexAdjacency {
public:
  std::size_t size() const { return begin_.size() - 1; }
  IndexRange operator[](std::size_t v) const {
    return {all_.data() + begin_[v], all_.data() + begin_[v + 1]};
  }

private:
  friend VertexAdjacency vertexAdjacency(Eigen::Index vertexCount, const Faces& faces);
  std::vector<int> begin_; ///< of every vertex in `all_`, and the end
  std::vector<int> all_;
};

VertexAdjacency vertexAdjacency(Eigen::Index vertexCount, const Faces& faces);

} // namespace massprops
