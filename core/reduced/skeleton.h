// The mean curvature skeleton: curves, and the point of them that every surface vertex shrinks to.
#pragma once

#include "core/base/types.h"

#include <cstddef>

namespace massprops {

/// One segment a row, indices into Points.
using Segments = Eigen::Matrix<int, Eigen::Dynamic, 2, Eigen::RowMajor>;

struct Skeleton {
  /// n×3: row i is the skeleton point to which vertex i contracts.
  Points points;
  /// m×3 points, the former among them, and the segments between them that are the skeleton's
  /// curves: a tree for each component without handles. Of components on which the flow did not
  /// fail.
  Points nodes;
  Segments segments;
  /// Components on which the flow failed; their points lie half-way through the body, against the
  /// vertex normal.
  int failedComponents = 0;
};

/// Memory for the contracting mesh; a mesh needs about a third of it. The flow splits edges in a
/// loop that has no other bound and may never end on degenerate input [CGAL issue 7893].
constexpr std::size_t kFlowBytesPerVertex = 2048;

/// Contracts every connected component under mean curvature flow, medially centred. [TAOZ12]
/// Two calls with the same coordinates give the same bytes, whatever the program did before.
/// \throw std::bad_alloc when there is no memory for the flow
/// \pre closed 2-manifolds with coordinates of order one and far fewer digits than a double has
/// (see `snapped`)
Skeleton meanCurvatureSkeleton(const Points& vertices, const Faces& faces,
                               std::size_t flowBytesPerVertex = kFlowBytesPerVertex);

} // namespace massprops
