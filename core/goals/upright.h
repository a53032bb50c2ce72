// What counts as upright, and as exact.
#pragma once

namespace massprops {

/// Verdict: degrees that nobody sees a body hang or float off upright by, nor an axis wobble.
constexpr double kUpright = 0.5;

/// Verdict: as exact as a print can be, as a share of a mass or of the diagonal.
constexpr double kExact = 1e-3;

} // namespace massprops
