// Hang: the body hangs upright from a point.
#pragma once

#include "core/base/options.h"
#include "core/goals/goal.h"
#include "core/goals/verdict.h"

#include <memory>

namespace massprops {

/// Minimises |c − p|_xy² + c_z, the centre of mass plumb below `suspension`. [PWLSH13, Sec. 4]
std::unique_ptr<Goal> makeHangGoal(const Vec3& suspension, const Weights& weights);

/// The angle that it hangs off upright.
std::unique_ptr<Verdict> makeHangVerdict(const Vec3& suspension, double lengthUnit);

} // namespace massprops
