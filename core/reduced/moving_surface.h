// What moves inwards, and the smooth functions that move it.
#pragma once

#include "core/base/types.h"
#include "core/mesh/decimation.h"
#include "core/mesh/interpolation.h"
#include "core/model/posed_model.h"
#include "core/reduced/harmonics.h"
#include "core/reduced/laplacian.h"
#include "core/reduced/skeleton.h"

#include <functional>
#include <memory>
#include <vector>

namespace massprops {

/// Nothing of it changes while a cavity is looked for. Working frame.
struct MovingSurface {
  /// n×3, and triangles: the outer surface, with what closes an open one, or a copy of it, coarser
  /// or finer. Closed, outward.
  Points vertices;
  Faces faces;
  /// Lumped, n entries of total 1.
  Vector mass = {};
  /// On the carrier's p vertices; on these where the interpolation is the identity.
  HarmonicBasis basis = {};
  /// From the carrier's vertices to these, n×p.
  Interpolation interpolation = Interpolation::identity(0);
  /// The coarser copy that carries the smooth functions.
  DecimatedMesh carrier = {};
  /// n×n cotangent Laplacian; empty where the smoothness of the offsets has no weight.
  SparseMatrix laplacian = {};
  bool isCopy = false; ///< or else the outer surface itself
};

struct CoarseningOptions {
  int basisSize = 36;
  bool mayCopy = true;         ///< if not, the surface itself moves
  bool isCarrierCoarse = true; ///< if not, the functions live on what moves
  bool isSmooth = false;       ///< whether the Laplacian of what moves is needed
};

struct Coarsening {
  std::shared_ptr<const MovingSurface> moving;
  /// For every vertex of what moves the vertex of the posed model that it is; empty where there are
  /// others among them.
  std::vector<int> vertexOf;
  /// n×3: the skeleton point of every vertex of what moves, smoothed over the surface.
  Points axis;
  Skeleton skeleton; ///< of the carrier's vertices
  double secondsCopy = 0.0, secondsSkeleton = 0.0, secondsBasis = 0.0;
};

/// Copies the model twice, for what moves and for what carries the functions, and calculates
/// skeleton and basis on the coarser copy. A surface of long or uneven triangles is refined first.
/// `whenCopied`: called in between; `beside`: work for the core that the skeleton leaves free,
/// called from another thread.
/// \throw InvalidInput when the copies have too few vertices for the basis
Coarsening coarsen(const PosedModel& posed, const CoarseningOptions& options,
                   const std::function<void()>& whenCopied, const std::function<void()>& beside);

} // namespace massprops
