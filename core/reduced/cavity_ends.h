// Where a cavity ends because what moves inwards has no room for more, or no use.
#pragma once

#include "core/mesh/vertex_adjacency.h"
#include "core/reduced/cavity_search.h"

#include <vector>

namespace massprops {

/// Of a cavity's vertices, n of them.
struct CavityEnds {
  /// Those of the fans that an offset surface ends in: it turns away from the outer surface there
  /// and runs to the skeleton.
  std::vector<char> turned;
  /// The end that a vertex belongs to: of a fan, with vertices whose edges became long as far as
  /// they hang together with it or with what is solid, or up to two edges away; −1: to none.
  /// Vertices of different ends are no neighbours.
  std::vector<int> end;
  int count = 0;
};

/// `neighbours`: of what moves. \pre an offset surface, found
CavityEnds cavityEnds(const CavityTask& task, const CavityResult& found,
                      const VertexAdjacency& neighbours);

} // namespace massprops
