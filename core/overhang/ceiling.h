// Whether a cavity's ceiling carries itself while it is printed.
#pragma once

#include "core/base/types.h"

#include <vector>

namespace massprops {

/// What a printer would have to print on air; lengths of the cavity's.
struct Ceiling {
  /// Of the circle that fits into the widest place flatter than asked for, seen from above, the
  /// diameter: what has to be bridged.
  double widestSpan = 0.0;
  /// Places that are lower than all around them, by more than `depth`: a print would begin there in
  /// mid-air. In the cavity's coordinates.
  std::vector<Vec3> tips;
};

/// Longer bridges sag, millimetres. [Hubs]
constexpr double kBridge = 5.0;
/// What begins in mid-air and is carried after two or three layers holds, millimetres.
constexpr double kTipDepth = 0.5;

/// \param cavity closed, outward
/// \param toPrint its third axis points up in the printer
/// \param angle against the horizontal, radians: what is flatter does not carry itself
/// \param depth of a tip that counts, a length
Ceiling ceilingOf(const TriangleMesh& cavity, const Mat3& toPrint, double angle, double depth);

} // namespace massprops
