// Float: the body floats upright at a waterline.
#pragma once

#include "core/base/options.h"
#include "core/goals/goal.h"
#include "core/goals/verdict.h"

#include <memory>

namespace massprops {

/// Minimises c_z; the body as heavy as the water it displaces at the waterline, its centre of mass
/// above or below the centre of buoyancy and under the metacentre. `waterLevel`: share of the
/// height; `waterDensity`: as a multiple of the material's. [WW16; docs/math.md "Float"]
/// \throw InvalidInput when the body has next to no volume below the waterline
std::unique_ptr<Goal> makeFloatGoal(const Points& outer, const Faces& faces, double waterLevel,
                                    double waterDensity, const Weights& weights);

/// The pose in which the body really floats, all others, and how far it may heel. `rims`: points of
/// openings, k×3, that must stay above the water. \throw as the goal
std::unique_ptr<Verdict> makeFloatVerdict(const Points& outer, const Faces& faces,
                                          double waterLevel, double waterDensity, double lengthUnit,
                                          const Points& rims = Points(0, 3));

} // namespace massprops
