// Stand (published): the objective that the literature prints, in millimetres.
#pragma once

#include "core/base/options.h"
#include "core/goals/goal.h"
#include "core/model/contact.h"

#include <memory>

namespace massprops {

/// Minimises c_x² + c_y² + c_z, in millimetres about the centre of the area, the centre of mass
/// kept above the area, shrunk by a tenth: another body for another size. Neighbouring edges of a
/// polygon with very many corners have one constraint in common, that of the edge that is violated
/// most. Its verdict is Stand's. [MAB15, Sec. 5; Thesis, Eqs. (3.24), (3.25)]
std::unique_ptr<Goal> makePublishedStandGoal(const ContactArea& area, double lengthUnit,
                                             const Weights& weights);

} // namespace massprops
