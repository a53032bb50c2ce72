// How coarse the coordinates are that the caller can store.
#pragma once

#include "core/base/types.h"

#include <functional>

namespace massprops {

/// The step, length, to which `representable` rounds coordinates near these points (n×3); 0 where
/// it is empty. Within a few per cent, from how far it moves points between them.
double roundingStep(const std::function<Points(const Points&)>& representable,
                    const Points& points);

} // namespace massprops
