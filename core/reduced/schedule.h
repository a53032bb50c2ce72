// When the stages of a run begin, foretold from the model's size.
#pragma once

#include "core/base/types.h"

namespace massprops {

/// Per cent of the time.
struct Schedule {
  int copy, skeleton, directions, search;
  static constexpr int kEnd = 95; ///< of the search
};

/// `mayCopy`: whether a copy of the model's n vertices moves inwards.
Schedule scheduleFor(Eigen::Index vertexCount, int basisSize, bool mayCopy);

} // namespace massprops
