#include "core/optimum/certificate.h"

#include "core/optimum/positive_part_bound.h"

#include <utility>
#include <vector>

namespace massprops {
namespace {

enum class Wanted {
  Any,     ///< that is positive
  Greatest ///< that the effort allows
};

/// Positive: no body has less than this sum of the functionals.
double marginOf(const Certificate& proof, const Moments& solid, PositivePartBounds& hollowing,
                std::size_t mostCubes, Wanted wanted = Wanted::Any) {
  const Eigen::Matrix<double, 11, 1> w = proof.functionals.rowwise().sum(); // of the solid
  const Eigen::Matrix<double, 11, 1> size = proof.functionals.cwiseAbs().rowwise().sum();
  const double rounding = kOutwards * (size.head<10>().dot(solid.cwiseAbs()) + size[10]);
  const double ofSolid = w.head<10>().dot(solid) + w[10] - rounding;
  if (ofSolid <= 0.0) return ofSolid;
  const LayeredQuadric worth = worthOfHollowing(proof.functionals, proof.fillings);
  const double enough = wanted == Wanted::Any ? ofSolid : 0.0;
  return ofSolid - hollowing.of(worth, enough, mostCubes);
}

/// The proof with its margin, if that is positive.
std::optional<Certificate> withMargin(Certificate proof, const Moments& solid,
                                      PositivePartBounds& hollowing) {
  proof.margin = marginOf(proof, solid, hollowing, kMostCubes);
  return proof.margin > 0.0 ? std::optional(std::move(proof)) : std::nullopt;
}

/// What there is to prove.
Certificate claim(const LinearConditions& conditions, double level, const LevelBound& bound,
                  const Fillings& fillings) {
  Certificate result;
  std::vector<Eigen::Index> counting;
  for (Eigen::Index s = 0; s < bound.multipliers.cols(); ++s) {
    if (bound.multipliers.col(s).isZero()) continue;
    counting.push_back(s);
    result.fillings.push_back(fillings[static_cast<std::size_t>(s)]);
  }
  result.multipliers = bound.multipliers(Eigen::all, counting);
  result.rows = conditions.atZero + level * conditions.slopes;
  result.functionals = result.rows.transpose() * result.multipliers;
  return result;
}

/// By how much the sum of the conditions grows with the level, for the bound's best body.
double slopeOf(const LinearConditions& conditions, const LevelBound& bound) {
  double slope = 0.0;
  for (Eigen::Index s = 0; s < bound.multipliers.cols(); ++s) {
    const AffineRow sum = bound.multipliers.col(s).transpose() * conditions.slopes;
    slope += valueOf(sum, bound.states[static_cast<std::size_t>(s)]);
  }
  return slope;
}

} // namespace

std::optional<Certificate> certificate(const LinearConditions& conditions, double wantedLevel,
                                       const LevelBound& bound, const Moments& solid,
                                       const Fillings& fillings, const TriangleTree& surface,
                                       double wall) {
  PositivePartBounds hollowing(surface, wall);
  return withMargin(claim(conditions, wantedLevel, bound, fillings), solid, hollowing);
}

std::optional<double> provedLevel(const LinearConditions& conditions, const LevelBound& bound,
                                  const Moments& solid, const Fillings& fillings,
                                  const TriangleTree& surface, double wall, std::size_t mostCubes) {
  // Of the step by which the bound would be exact: another subdivision is not quite as good.
  constexpr double kBeyond = 1.1, kWithin = 0.9;
  constexpr int kMostSteps = 3;
  const double slope = slopeOf(conditions, bound);
  PositivePartBounds hollowing(surface, wall);
  const auto marginAt = [&](double level, Wanted wanted) {
    return marginOf(claim(conditions, level, bound, fillings), solid, hollowing, mostCubes, wanted);
  };
  double level = bound.level;
  double margin = marginAt(level, Wanted::Greatest);
  if (margin > 0.0) {
    const double lower = level - kWithin * margin / slope;
    return marginAt(lower, Wanted::Any) > 0.0 ? lower : level;
  }
  for (int step = 0; step < kMostSteps; ++step) {
    level -= kBeyond * margin / slope;
    margin = marginAt(level, Wanted::Any);
    if (margin > 0.0) return level;
  }
  return std::nullopt;
}

std::vector<Certificate> certificates(const HalfSpaces& set, const Moments& solid,
                                      const Filling& filling, const TriangleTree& surface,
                                      double wall) {
  PositivePartBounds hollowing(surface, wall);
  std::vector<Certificate> proofs;
  for (Eigen::Index i = 0; i < set.limits.size(); ++i) {
    Certificate proof;
    proof.fillings = {filling};
    proof.functionals.setZero(11, 1);
    proof.functionals(0, 0) = set.limits[i];
    proof.functionals.block<3, 1>(1, 0) = -set.normals.row(i).transpose();
    std::optional<Certificate> proved = withMargin(std::move(proof), solid, hollowing);
    if (!proved) return {};
    proofs.push_back(*std::move(proved));
  }
  return proofs;
}

} // namespace massprops
