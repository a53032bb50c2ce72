// What the optimisation minimises, as far as it depends on a body's moments alone.
#pragma once

#include "core/base/minimize.h"
#include "core/base/options.h"
#include "core/goals/goal.h"
#include "core/physics/filling.h"

#include <functional>
#include <optional>
#include <vector>

namespace massprops {

/// d(moments)/d(variables), 10×x.
using MomentJacobian = Eigen::Matrix<double, 10, Eigen::Dynamic>;

/// Mass moments with their derivatives.
struct BodyState {
  Moments mass;
  MomentJacobian jacobian;
};

/// The body of density 1 between an outer surface and a cavity, in each state. `cavity`: its
/// derivatives are by the first of the outer surface's variables; `below`: of its part below a
/// level, asked for with contents up to one.
std::vector<BodyState> bodyStates(const Fillings& fillings, const BodyState& outer,
                                  const BodyState& cavity,
                                  const std::function<BodyState(double)>& below = {});

/// Terms 1, 2, 3 and 5 of the objective (docs/math.md, "Objective") of a body with these mass
/// moments, one for each of its states (filling.h): the soft maximum of the goal's objective, and
/// the constraints of all. `volumeShare`: volume of the material over that of the solid.
double momentObjective(const Goal& goal, const Weights& weights, const std::vector<Moments>& states,
                       double volumeShare);

/// The same with its derivatives by x variables, and the goal's constraints unless weight 5 is 0,
/// which leaves them out altogether. `volumeShareGradient`: x entries.
Evaluation evaluateBody(const Goal& goal, const Weights& weights,
                        const std::vector<BodyState>& states, double volumeShare,
                        const Vector& volumeShareGradient);

/// For what a goal wants instead of constraints that cannot be kept: none on the volume, which
/// would be bought with them.
Weights insteadOfConstraints(Weights weights);

/// Largest in any state.
double largestViolation(const Goal& goal, const std::vector<Moments>& states);

/// Of the worst state.
std::optional<double> measure(const Goal& goal, const std::vector<Moments>& states);

} // namespace massprops
