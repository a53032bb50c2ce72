// The level that a body reaches as a variable of the optimisation, for the smooth objective of a
// goal that asks for a high level is nearly that only.
#pragma once

#include "core/goals/objective.h"

#include <optional>
#include <vector>

namespace massprops {

/// The one condition whose level is the goal's measure and all that it asks for; empty: there is
/// none.
std::optional<LinearConditions> conditionsOfMeasure(const Goal& goal, const Moments& body);

/// The level as one more variable, the last, as high as the conditions let it be in every state:
/// minimises weight 1 times the share of volume less weight 2 times the level.
class LevelProblem {
public:
  /// `start`: the body's states where the other variables begin and the last is 0.
  LevelProblem(LinearConditions conditions, const Weights& weights,
               const std::vector<BodyState>& start);

  /// `level`: the last variable, above what the body reaches at the start in units that change it
  /// as much as the others may. `volumeShareGradient`: by the others.
  Evaluation at(const std::vector<BodyState>& states, double volumeShare,
                const Vector& volumeShareGradient, double level) const;

private:
  Eigen::Index rows() const { return conditions_.atZero.rows(); }

  LinearConditions conditions_;
  double volumeWeight_, levelWeight_;
  double start_; ///< level
  double unit_ = 1.0;
  Vector perLevel_; ///< how fast each condition grows with the level at the start
};

} // namespace massprops
