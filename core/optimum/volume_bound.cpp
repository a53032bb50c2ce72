#include "core/optimum/volume_bound.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

namespace massprops {
namespace {

/// The moments of a cavity of at most this volume whose integral of a functional is the largest.
Moments bathtub(const Moments& functional, const AdmissibleCells& cells, double volume) {
  const Vector gains = cells * functional;
  std::vector<Eigen::Index> order(static_cast<std::size_t>(cells.rows()));
  std::iota(order.begin(), order.end(), Eigen::Index{0});
  const auto worth = [&](Eigen::Index c) { return gains[c] / cells(c, 0); };
  std::stable_sort(order.begin(), order.end(),
                   [&](Eigen::Index a, Eigen::Index b) { return worth(a) > worth(b); });
  Moments cavity = Moments::Zero();
  for (const Eigen::Index c : order) {
    const double share = std::min((volume - cavity[0]) / cells(c, 0), 1.0);
    if (share <= 0.0 || gains[c] <= 0.0) break;
    cavity += share * cells.row(c).transpose();
  }
  return cavity;
}

/// Dinkelbach's iteration, as in `greatestLevel`.
double greatestLevel(const LinearConditions& conditions, const Vector& multipliers,
                     const Moments& solid, double perVolume, const AdmissibleCells& cells,
                     double volume) {
  constexpr int kMostSteps = 30;
  const AffineRow atZero = multipliers.transpose() * conditions.atZero;
  const AffineRow slopes = multipliers.transpose() * conditions.slopes;
  double level = -valueOf(atZero, solid) / valueOf(slopes, solid);
  for (int step = 0; step < kMostSteps; ++step) {
    const AffineRow w = atZero + level * slopes;
    const Moments body =
        solid - perVolume * bathtub(perVolume * w.head<10>().transpose(), cells, volume);
    const double next = -valueOf(atZero, body) / valueOf(slopes, body);
    if (!(next > level)) break;
    level = next;
  }
  return level;
}

/// The measure of bodies that reach this level, which lies between those of two bodies.
double measureAt(double level, const Goal& goal, const LinearConditions& conditions,
                 const Moments& low, const Moments& high) {
  constexpr int kHalvings = 50;
  const auto mixed = [&](double share) { return Moments(low + share * (high - low)); };
  double below = 0.0;
  double above = 1.0;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (below + above);
    (levelReached(conditions, mixed(middle)) < level ? below : above) = middle;
  }
  return *goal.measure(mixed(above));
}

} // namespace

std::optional<double> greatestMeasure(const Goal& goal, const OptimalBound& bound,
                                      const Moments& solid, const Fillings& fillings,
                                      const AdmissibleCells& cells, double volume) {
  if (!goal.measure(solid) || fillings.size() != 1 || cells.rows() == 0) return std::nullopt;
  const double perVolume = 1.0 - fillings.front().density; // what a cavity takes off
  const std::vector<LinearConditions> conditions = goal.conditions();
  if (conditions.empty() && bound.levels.empty()) {
    // A mass, which the volume says all about.
    const double most = std::min(volume, cells.col(0).sum());
    return std::max(*goal.measure(solid),
                    *goal.measure(solid - perVolume * most * Moments::Unit(0)));
  }
  if (conditions.size() != 1 || bound.levels.size() != 1) return std::nullopt;
  const LevelBound& best = bound.levels.front();
  const double level =
      greatestLevel(conditions.front(), best.multipliers.col(0), solid, perVolume, cells, volume);
  const Moments& most = best.states.front();
  if (level >= levelReached(conditions.front(), most)) return goal.measure(most);
  if (level <= levelReached(conditions.front(), solid)) return goal.measure(solid);
  return measureAt(level, goal, conditions.front(), solid, most);
}

} // namespace massprops
