// A smooth function that lies a little above the greatest of some values.
#pragma once

#include "core/base/types.h"

#include <cmath>

namespace massprops {

/// log Σ exp(s v)/s of the values v: their greatest or more, by log(number)/s at most.
struct SoftMaximum {
  double value;
  Vector shares; ///< its derivatives by the values: positive, of sum 1
};

/// \pre there are values
inline SoftMaximum softMaximum(const Vector& values, double sharpness) {
  const double greatest = values.maxCoeff();
  SoftMaximum result{0.0, (sharpness * (values.array() - greatest)).exp()};
  const double sum = result.shares.sum();
  result.shares /= sum;
  result.value = greatest + std::log(sum) / sharpness;
  return result;
}

} // namespace massprops
