// Spin: the body spins as a top about a vertical axis.
#pragma once

#include "core/base/options.h"
#include "core/goals/goal.h"
#include "core/goals/verdict.h"

#include <memory>

namespace massprops {

/// Minimises (m/m_solid) c_z + (I_a² + I_b²)/I_zz², the centre of mass on the vertical through
/// `axis` and above the ground, where the axis ends in the tip, the axis a principal one, and its
/// moment not between the other two about the tip. [BWBSH14, Sec. 4; MAB15, Sec. 5]
std::unique_ptr<Goal> makeSpinGoal(const Moments& solidMassMoments, const Weights& weights,
                                   const Vec2& axis = Vec2::Zero());

/// Offset and tilt of the axis, and the speed from which it keeps the body upright. It spins where
/// a hand gives it that speed: `handSpeed` in rpm. `lengthUnit`: millimetres per working unit.
std::unique_ptr<Verdict> makeSpinVerdict(const Moments& solidMassMoments, const Vec2& axis,
                                         double lengthUnit, double handSpeed);

} // namespace massprops
