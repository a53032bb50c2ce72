#include "core/answer/host_rounding.h"

namespace massprops {

double roundingStep(const std::function<Points(const Points&)>& representable,
                    const Points& points) {
  constexpr Eigen::Index kSamples = 1000;
  if (!representable || points.rows() == 0) return 0.0;
  // The points themselves are stored already: samples a little towards their middle.
  const Eigen::RowVector3d middle = points.colwise().mean();
  Points samples(kSamples, 3);
  for (Eigen::Index i = 0; i < kSamples; ++i) {
    const Eigen::RowVector3d p = points.row(i * points.rows() / kSamples);
    const double share = 0.01 * static_cast<double>(i + 1) / static_cast<double>(kSamples);
    samples.row(i) = p + share * (middle - p);
  }
  return 2.0 * (representable(samples) - samples).cwiseAbs().maxCoeff();
}

} // namespace massprops
