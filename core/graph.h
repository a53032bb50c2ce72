// Which vertices of a mesh are joined by edges, and functions limited by them.
#pragma once

#include "core/types.h"

#include <vector>

namespace massprops {

/// For every vertex its neighbours, ascending.
class Neighbours {
public:
  std::size_t size() const { return begin_.size() - 1; }
  IndexRange operator[](std::size_t v) const {
    return {all_.data() + begin_[v], all_.data() + begin_[v + 1]};
  }

private:
  friend Neighbours vertexNeighbours(Eigen::Index vertexCount, const Faces& faces);
  std::vector<int> begin_; ///< of every vertex in `all_`, and the end
  std::vector<int> all_;
};

Neighbours vertexNeighbours(Eigen::Index vertexCount, const Faces& faces);

/// The greatest function below `values` that changes by at most `slope` × length along any edge.
Vector lipschitzBelow(const Points& vertices, const Neighbours& neighbours, const Vector& values,
                      double slope);

/// The least function above `values` that changes by at most `slope` × length along any edge.
Vector lipschitzAbove(const Points& vertices, const Neighbours& neighbours, const Vector& values,
                      double slope);

} // namespace massprops
