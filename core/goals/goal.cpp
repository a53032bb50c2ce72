#include "core/goals/goal.h"

#include <algorithm>
#include <cmath>

namespace massprops {

VerdictBounds Goal::verdictBounds(const Moments& /*massMoments*/, double /*level*/) const {
  return {};
}

double largestViolation(const Goal& goal, const Moments& massMoments) {
  double largest = 0.0;
  for (const double e : goal.equalities(massMoments).values) {
    largest = std::max(largest, std::abs(e));
  }
  for (const double g : goal.inequalities(massMoments).values) largest = std::max(largest, g);
  return largest;
}

} // namespace massprops
