// Where something ceases to hold.
#pragma once

#include <cmath>

namespace massprops {

/// A number at which it holds, and within `precision` > 0 of which it does not somewhere. It holds
/// at `good`, and not at `bad`.
template <class Holds>
double lastThatHolds(double good, double bad, double precision, const Holds& holds) {
  while (std::abs(bad - good) > precision) {
    const double middle = 0.5 * (good + bad);
    (holds(middle) ? good : bad) = middle;
  }
  return good;
}

} // namespace massprops
