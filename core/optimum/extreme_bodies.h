// The hollow bodies that have least of an affine functional of their moments, or of a ratio of two.
#pragma once

#include "core/goals/goal.h"
#include "core/optimum/admissible_cells.h"

namespace massprops {

/// Of all bodies that are hollow within some cells. [docs/math.md "Out of reach"]
class ExtremeBodies {
public:
  /// `solid`: moments of the body without a cavity, density 1; `fillDensity`: as a multiple of the
  /// material's. Refers to the solid and the cells.
  ExtremeBodies(const Moments& solid, double fillDensity, const AdmissibleCells& cells)
      : solid_(solid), filling_(fillDensity - 1.0), cells_(cells) {}

  /// Hollow where that lowers the functional.
  Moments withLeast(const AffineRow& functional) const;

  /// By Dinkelbach's iteration from another body. \pre `divisor` is positive for all
  Moments withLeastRatio(const AffineRow& dividend, const AffineRow& divisor,
                         const Moments& start) const;

private:
  const Moments& solid_;
  double filling_; ///< density of the filling less that of the material
  const AdmissibleCells& cells_;
};

} // namespace massprops
