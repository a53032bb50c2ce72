// A leaning animal of any resolution, for measurements.
#pragma once

#include "core/base/types.h"

namespace massprops::benchmarks {

/// About `vertexCount` vertices: a smooth union of capsules on flat feet, closed and free of
/// crossings. A coarse mesh of it is refined by cutting its edges in half until it is fine enough,
/// with the vertices drawn back onto the surface. The same bits on every run.
TriangleMesh organicModel(Eigen::Index vertexCount);

} // namespace massprops::benchmarks
