// Stand: the body stands on its contact area.
#pragma once

#include "core/base/options.h"
#include "core/goals/goal.h"
#include "core/goals/verdict.h"
#include "core/model/contact.h"

#include <memory>

namespace massprops {

/// Minimises c_x² + c_y² + c_z over the area's centre, the centre of mass kept above the area,
/// shrunk by a tenth. Neighbouring edges of a polygon with very many corners have one constraint in
/// common, that of the edge that is violated most. [PWLSH13, Sec. 4; MAB15, Sec. 5]
std::unique_ptr<Goal> makeStandGoal(const ContactArea& area, const Weights& weights);

/// The tipping angle. `lengthUnit`: model units per working unit, here and for the other goals.
std::unique_ptr<Verdict> makeStandVerdict(const ContactArea& area, double lengthUnit);

} // namespace massprops
