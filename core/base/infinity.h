// Farther away than anything.
#pragma once

#include <limits>

namespace massprops {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

} // namespace massprops
