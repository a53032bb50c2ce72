#include "core/optimum/foot_depth.h"

#include "core/goals/registry.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

namespace massprops {
namespace {

/// Of the best of all bodies on that contact area.
double reserve(const GroundContact& contact, const PosedModel& posed, AdmissibleCells cells,
               Fillings states, const Options& options) {
  PosedModel moved = posed;
  const Vec3 shift =
      (contact.centre - posed.frame.rotation * posed.frame.origin) / posed.frame.length;
  moved.vertices.rowwise() -= shift.transpose();
  moved.contact = scaled(contact.area, posed.frame.length);
  const std::unique_ptr<Goal> goal = makeGoal(options, moved, moved.vertices);
  const Moments solid = moments(moved.vertices, moved.faces, goal->usesInertia());
  if (cells.rows() > 0) {
    // Goals of standing do not look at second moments.
    cells.middleCols<3>(1) -= cells.col(0) * shift.transpose();
    for (Filling& state : states) state.level -= shift.z();
    return reserveOf(optimalBound(*goal, options.weights, solid, states, cells));
  }
  double reached = -std::numeric_limits<double>::infinity();
  const std::vector<LinearConditions> conditions = goal->conditions();
  for (const LinearConditions& condition : conditions) {
    reached = std::max(reached, levelReached(condition, solid));
  }
  return conditions.empty() ? -largestViolation(*goal, solid) : reached - goal->wantedLevel();
}

} // namespace

double reserveOf(const OptimalBound& bound) {
  const LevelBound* best = bound.bestLevel();
  return best != nullptr ? best->reached - bound.wantedLevel : -bound.violationInAll;
}

bool isAmple(double reserve) {
  constexpr double kHalfADegree = 0.009; // its tangent
  return reserve >= kHalfADegree;
}

std::optional<double> betterFootDepth(const LowestPart& lowest, const PosedModel& posed,
                                      const AdmissibleCells& cells, const Fillings& states,
                                      const Options& options) {
  constexpr int kSteps = 4;
  constexpr int kHalvings = 3;
  constexpr double kWorthIt = 1e-3;
  const auto reserveAt = [&](double depth) {
    const GroundContact contact = lowest.contactAt(depth);
    return contact.area.polygon.empty() ? -std::numeric_limits<double>::infinity()
                                        : reserve(contact, posed, cells, states, options);
  };
  const double cut = posed.foot->depth;
  double most = reserveAt(cut) + kWorthIt;
  if (isAmple(most)) return std::nullopt;
  std::optional<double> best;
  double before = cut;
  for (int i = 1; i <= kSteps; ++i) {
    double depth = cut + (lowest.deepestWanted() - cut) * i / kSteps;
    const double reached = reserveAt(depth);
    if (isAmple(reached)) {
      for (int k = 0; k < kHalvings; ++k) {
        const double middle = 0.5 * (before + depth);
        (isAmple(reserveAt(middle)) ? depth : before) = middle;
      }
      return depth;
    }
    if (reached > most) {
      most = reached;
      best = depth;
    }
    before = depth;
  }
  return best;
}

} // namespace massprops
