#include "core/goals/goal.h"

#include <algorithm>
#include <cmath>

namespace massprops {

double valueOf(const AffineRow& functional, const Moments& massMoments) {
  return functional.head<10>().dot(massMoments) + functional[10];
}

LinearConditions linearConditions(const AffineRows& equalities, const AffineRows& inequalities,
                                  const AffineRow& perLevel) {
  const Eigen::Index rows = 2 * equalities.rows() + inequalities.rows();
  LinearConditions conditions{AffineRows(rows, 11), perLevel.replicate(rows, 1)};
  conditions.atZero << equalities, -equalities, inequalities;
  return conditions;
}

double levelReached(const LinearConditions& conditions, const Moments& massMoments) {
  const auto at = [&](const AffineRows& rows) {
    return Vector(rows.leftCols<10>() * massMoments + rows.col(10));
  };
  return -at(conditions.atZero).cwiseQuotient(at(conditions.slopes)).maxCoeff();
}

std::optional<double> Goal::measure(const Moments& /*massMoments*/) const {
  return std::nullopt;
}

std::optional<HalfSpaces> Goal::noneCan(const Moments& /*best*/,
                                        const std::function<HalfSpaces()>& /*centres*/) const {
  return std::nullopt;
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
