// Yo-yo: the body spins about its vertical axle, balanced on both sides of the string.
#pragma once

#include "core/base/options.h"
#include "core/goals/goal.h"
#include "core/goals/verdict.h"

#include <memory>

namespace massprops {

/// Minimises (I_a² + I_b²)/I_zz², the centre of mass at `pivot`, the middle of the axle, and the
/// axle a principal axis whose moment is not the middle one. [BWBSH14, Sec. 4]
std::unique_ptr<Goal> makeYoYoGoal(const Moments& solidMassMoments, const Weights& weights,
                                   const Vec3& pivot);

/// Offset, tilt and moments of the axle, and the distance of the centre from its middle.
std::unique_ptr<Verdict> makeYoYoVerdict(const Moments& solidMassMoments, const Vec3& pivot,
                                         double lengthUnit);

} // namespace massprops
