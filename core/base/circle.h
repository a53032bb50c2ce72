// Directions all round.
#pragma once

#include "core/base/angles.h"
#include "core/base/types.h"

#include <cmath>

namespace massprops {

/// Equal steps in which a circle is gone round, 5° each: a length in some direction differs from
/// that in one of these by no more than 0.1 %.
constexpr int kAround = 72;

/// Of length 1, so many steps counter-clockwise from the first axis.
inline Vec2 onCircle(int step) {
  const double angle = 2.0 * kPi * step / kAround;
  return {std::cos(angle), std::sin(angle)};
}

} // namespace massprops
