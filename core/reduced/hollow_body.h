// The body that a search ends with, and whether it serves the goal better than another.
#pragma once

#include "core/physics/moments.h"
#include "core/reduced/cavity_search.h"

namespace massprops {

/// Measured on triangles.
struct Body {
  Moments mass;        ///< working frame, material of density 1
  double volume = 0.0; ///< of the material, working unit
  /// All terms, and without the smoothness of the offsets and the outer surface's displacement,
  /// which bodies without offsets do not have.
  double objective = 0.0, momentObjective = 0.0;
  double violation = 0.0;        ///< largest of the goal's constraints
  std::optional<double> measure; ///< `Goal::measure`
};

/// The model as it came in, existing cavities and all.
Body inputBody(const CavityTask& task);

/// With the cavity that was found. \pre its status is Found or NoGain
Body hollowBody(const CavityTask& task, const CavityResult& cavity);

/// With a best possible cavity, behind an outer surface that rests.
Body hollowBody(const CavityTask& task, const Points& inner, const Faces& faces);

/// Whether the first violates the constraints less or, where both keep them, has the greater
/// measure or, where that is not all that counts, the lower objective.
bool servesBetter(const CavityTask& task, const Body& a, const Body& b);

/// The same for cavities; none is worse than any.
bool servesBetter(const CavityTask& task, const CavityResult& a, const CavityResult& b);

/// Whether the solid body serves the goal at least as well; never of an open surface, of which a
/// shell is asked for whatever a solid body could do.
bool isUseless(const CavityTask& task, const CavityResult& cavity);

/// Share of what a cavity could gain that is not gained, 0 for the best possible: in the verdict
/// where that is one number, else in the objective where it can be compared, else in the violation
/// of the constraints. The bound knows nothing of
/// smoothness, so that term is left out on both sides.
double gapToBound(const OptimalBound& bound, const Body& before, const Body& after);

/// Puts a body that serves the goal better than the bound's own in its place: what was delivered is
/// possible, and cells know the region only so well. Smoothness and the outer surface's
/// displacement do not count.
void raiseTo(const CavityTask& task, const Body& delivered, OptimalBound& bound);

} // namespace massprops
