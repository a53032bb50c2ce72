// By how much a print may differ from what was calculated.
#pragma once

#include "core/goals/verdict.h"
#include "core/reduced/cavity_search.h"

namespace massprops {

/// One deviation at a time, all others none; the verdict holds for every smaller one.
struct PrintMargins {
  /// Least density of what lies deeper in the material than the perimeters, as a share of it: the
  /// infill that a slicer may print it with.
  double infill = 1.0;
  /// By which the cavity's surface may lie too deep or too shallow everywhere, working length; at
  /// most the wall.
  double wall = 0.0;
  /// Mass of material that may be left anywhere in the cavity, all in the worst place; density 1,
  /// working unit; at most the cavity's whole volume.
  double residue = 0.0;
};

/// Of the body that was found, whose verdict must be reached. `perimeters`: how thick a slicer
/// prints every skin without infill, working length. \pre the cavity's status is Found, the outer
/// surface is closed
PrintMargins printMargins(const CavityTask& task, const CavityResult& cavity,
                          const Verdict& verdict, double perimeters);

} // namespace massprops
