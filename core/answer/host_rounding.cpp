#include "core/answer/host_rounding.h"

#include <cmath>

namespace massprops {

double roundingStep(const std::function<Points(const Points&)>& representable,
                    const Points& points) {
  constexpr Eigen::Index kSamples = 1000;
  constexpr double kNoFraction = 0.6180339887498949; // lest the samples end in few digits
  if (!representable || points.rows() == 0) return 0.0;
  // The points themselves are stored already: samples a little towards their middle.
  const Eigen::RowVector3d middle = points.colwise().mean();
  Points samples(kSamples, 3);
  for (Eigen::Index i = 0; i < kSamples; ++i) {
    const Eigen::RowVector3d p = points.row(i * points.rows() / kSamples);
    const double turns = kNoFraction * static_cast<double>(i + 1);
    samples.row(i) = p + 0.01 * (turns - std::floor(turns)) * (middle - p);
  }
  return 2.0 * (representable(samples) - samples).cwiseAbs().maxCoeff();
}

} // namespace massprops
