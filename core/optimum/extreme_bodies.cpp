#include "core/optimum/extreme_bodies.h"

namespace massprops {

Moments ExtremeBodies::withLeast(const AffineRow& functional) const {
  const Eigen::Index terms = functional.segment<6>(4).isZero(0.0) ? 4 : 10;
  const Vector change = filling_ * (cells_.leftCols(terms) * functional.head(terms).transpose());
  Moments cavity = Moments::Zero();
  for (Eigen::Index c = 0; c < cells_.rows(); ++c) {
    if (change[c] < 0.0) cavity += cells_.row(c).transpose();
  }
  return solid_ + filling_ * cavity;
}

Moments ExtremeBodies::withLeastRatio(const AffineRow& dividend, const AffineRow& divisor,
                                      const Moments& start) const {
  constexpr int kMostSteps = 30;
  const auto ratioOf = [&](const Moments& body) {
    return valueOf(dividend, body) / valueOf(divisor, body);
  };
  Moments best = start;
  double ratio = ratioOf(best);
  for (int step = 1; step < kMostSteps; ++step) {
    const Moments body = withLeast(dividend - ratio * divisor);
    const double next = ratioOf(body);
    if (!(next < ratio)) break;
    ratio = next;
    best = body;
  }
  return best;
}

} // namespace massprops
