// What the optimisation minimises, as far as it depends on a body's moments alone.
#pragma once

#include "core/base/minimize.h"
#include "core/base/options.h"
#include "core/goals/goal.h"

namespace massprops {

/// d(moments)/d(variables), 10×x.
using MomentJacobian = Eigen::Matrix<double, 10, Eigen::Dynamic>;

/// Terms 1, 2, 3 and 5 of the objective (docs/math.md, "Objective") of a body with these mass
/// moments. `volumeShare`: volume of the material over that of the solid.
double momentObjective(const Goal& goal, const Weights& weights, const Moments& massMoments,
                       double volumeShare);

/// The same with its derivatives by x variables, and the goal's constraints unless weight 5 is 0,
/// which leaves them out altogether. `volumeShareGradient`: x entries.
Evaluation evaluateBody(const Goal& goal, const Weights& weights, const Moments& massMoments,
                        const MomentJacobian& massJacobian, double volumeShare,
                        const Vector& volumeShareGradient);

} // namespace massprops
