// The best that any cavity could do: what is reached is measured against it.
#pragma once

#include "core/base/options.h"
#include "core/goals/goal.h"
#include "core/optimum/admissible_cells.h"
#include "core/optimum/layered_quadric.h"
#include "core/optimum/level_bound.h"
#include "core/physics/filling.h"

#include <optional>
#include <vector>

namespace massprops {

/// A body hollowed where a quadric is positive, the shape of the best cavity for every goal that
/// depends on mass moments alone: a plane's side for those without inertia. [HLW24, Sec. 4; docs/
/// math.md "The limit"]
struct OptimalBound {
  /// Known this exactly: a lower violation counts as none.
  static constexpr double kReachable = 1e-4;

  Moments massMoments = Moments::Zero(); ///< in the first of its states
  double objective = 0.0;                ///< terms 1, 2, 3 and 5
  /// No body that is hollow within the cells and keeps the constraints has a lower objective;
  /// empty: not known.
  std::optional<double> objectiveAtLeast;
  /// Largest of the goal's constraints; > 0: no cavity was found to hold all.
  double violation = 0.0;
  /// The same of the best body in all cells, when this body is of less, see `withBodyWithin`.
  Moments massMomentsInAll = Moments::Zero();
  double violationInAll = 0.0;
  /// Of this body in all its states, where the goal's measure is all that counts.
  std::optional<double> measure;
  /// Of the goal's conditions, in their order; empty where they are not linear, or where this body
  /// meets them and the goal has no measure.
  std::vector<LevelBound> levels;
  double wantedLevel = 0.0; ///< of the goal
  /// If no cavity that has its centre of mass within these does what the goal asks for: they hold
  /// all that cavities can have, as far as the cells tell. See `Goal::noneCan`.
  std::optional<HalfSpaces> outOfReach;
  /// Positive where the body is hollow.
  LayeredQuadric worth;
  /// States that the proof of the best level rests on, and those without a level of contents.
  Fillings binding;

  /// Whether the best body that was found does what the goal asks for.
  bool isReachable() const;
  /// Of the levels the one whose body is best; null without levels.
  const LevelBound* bestLevel() const;
};

/// The best hollow body within the cells, of which there must be one. `solid`: moments of the body
/// without a cavity, density 1; `fillings`: the states in which it is to serve the goal, those with
/// a level of contents only where the goal has a measure that is all that counts.
OptimalBound optimalBound(const Goal& goal, const Weights& weights, const Moments& solid,
                          const Fillings& fillings, const AdmissibleCells& cells);

/// The same proofs, but the body is the best within `opened`, a part of the bound's cells: what can
/// be delivered is measured against it. No rows: it is the solid body.
OptimalBound withBodyWithin(const AdmissibleCells& opened, OptimalBound bound, const Goal& goal,
                            const Weights& weights, const Moments& solid, const Fillings& fillings);

} // namespace massprops
