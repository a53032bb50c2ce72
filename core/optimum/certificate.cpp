#include "core/optimum/certificate.h"

#include "core/optimum/positive_part_bound.h"

#include <utility>
#include <vector>

namespace massprops {
namespace {

/// The proof with its margin, if that is positive.
std::optional<Certificate> withMargin(Certificate proof, const Moments& solid,
                                      const TriangleTree& surface, double wall) {
  const Eigen::Matrix<double, 11, 1> w = proof.functionals.rowwise().sum(); // of the solid
  const Eigen::Matrix<double, 11, 1> size = proof.functionals.cwiseAbs().rowwise().sum();
  const double rounding = kOutwards * (size.head<10>().dot(solid.cwiseAbs()) + size[10]);
  const double ofSolid = w.head<10>().dot(solid) + w[10] - rounding;
  if (ofSolid <= 0.0) return std::nullopt;
  const LayeredQuadric worth = worthOfHollowing(proof.functionals, proof.fillings);
  proof.margin = ofSolid - positivePartBound(worth, surface, wall, ofSolid);
  return proof.margin > 0.0 ? std::optional(std::move(proof)) : std::nullopt;
}

} // namespace

std::optional<Certificate> certificate(const LinearConditions& conditions, double wantedLevel,
                                       const LevelBound& bound, const Moments& solid,
                                       const Fillings& fillings, const TriangleTree& surface,
                                       double wall) {
  Certificate result;
  std::vector<Eigen::Index> counting;
  for (Eigen::Index s = 0; s < bound.multipliers.cols(); ++s) {
    if (bound.multipliers.col(s).isZero()) continue;
    counting.push_back(s);
    result.fillings.push_back(fillings[static_cast<std::size_t>(s)]);
  }
  result.multipliers = bound.multipliers(Eigen::all, counting);
  result.rows = conditions.atZero + wantedLevel * conditions.slopes;
  result.functionals = result.rows.transpose() * result.multipliers;
  return withMargin(std::move(result), solid, surface, wall);
}

std::optional<Certificate> certificate(const Vec3& normal, double limit, const Moments& solid,
                                       const Filling& filling, const TriangleTree& surface,
                                       double wall) {
  Certificate result;
  result.fillings = {filling};
  result.functionals.setZero(11, 1);
  result.functionals(0, 0) = limit;
  result.functionals.block<3, 1>(1, 0) = -normal;
  return withMargin(std::move(result), solid, surface, wall);
}

} // namespace massprops
