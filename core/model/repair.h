// Small defects that are mended without asking, and counted.
#pragma once

#include "core/base/types.h"

#include <string>

namespace massprops {

/// What was mended; all zero and empty for a clean mesh.
struct Repairs {
  int unusedVertices = 0;    ///< left out
  int mergedVertices = 0;    ///< lay exactly on another one
  int zeroAreaFaces = 0;     ///< removed, or collapsed where that keeps the surface closed
  int duplicateFaces = 0;    ///< removed
  int flippedComponents = 0; ///< faced the wrong way throughout
  int replacedCavities = 0;  ///< existing cavities that the new one takes the place of
  std::string mended;        ///< by mending.h, in words; empty: nothing, the rest was enough
  double distance = 0.0;     ///< the mended surface lies within this of the given one, length
  std::string warning;       ///< a sentence where the mended model is not quite the given one

  Repairs& operator+=(const Repairs& before);

  /// "12 duplicate vertices merged, 1 component flipped", or "none".
  std::string describe() const;
};

struct RepairedMesh {
  TriangleMesh mesh;
  Repairs repairs;
};

/// Leaves out unused vertices and faces that use a vertex twice; where the surface is open, merges
/// vertices with the same coordinates (as every STL file has them); leaves out faces that are there
/// twice. \pre finite coordinates, indices in range
RepairedMesh mergedAndCompacted(TriangleMesh mesh);

/// Removes faces without area by collapsing and flipping edges. A face that cannot be removed
/// without harm to the surface stays. \pre a closed 2-manifold
RepairedMesh withoutZeroAreaFaces(RepairedMesh input);

} // namespace massprops
