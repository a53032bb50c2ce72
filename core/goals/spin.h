// Spin: the body spins as a top about a vertical axis.
#pragma once

#include "core/base/options.h"
#include "core/goals/goal.h"
#include "core/goals/verdict.h"

#include <memory>
#include <string>

namespace massprops {

/// Minimises (m/m_solid) c_z + (I_a² + I_b²)/I_zz², the centre of mass on the vertical through
/// `axis` and above the ground, where the axis ends, the axis a principal one.
/// [BWBSH14, Sec. 4; MAB15, Sec. 5]
std::unique_ptr<Goal> makeSpinGoal(const Moments& solidMassMoments, const Weights& weights,
                                   const Vec2& axis = Vec2::Zero());

/// Offset and tilt of the axis, and whether its moment is the largest or the smallest.
std::unique_ptr<Verdict> makeSpinVerdict(const Moments& solidMassMoments, const Vec2& axis,
                                         double lengthUnit);

/// The greater violation in words, of the centre's offset and of the products of inertia: the first
/// four of Spin's and Yo-yo's equalities.
std::string axisViolation(const Eigen::Vector4d& equalities, double lengthUnit);

} // namespace massprops
