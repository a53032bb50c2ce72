// What a cavity holds, and what the body weighs with it.
#pragma once

#include "core/physics/moments.h"

#include <limits>
#include <vector>

namespace massprops {

/// A cavity with contents up to a level: frozen, as far as the body's mass is concerned.
struct Filling {
  double density = 0.0; ///< as a multiple of the material's
  /// A height in the working frame; by default above everything.
  double level = std::numeric_limits<double>::infinity();

  bool isPartial() const { return level < std::numeric_limits<double>::infinity(); }
};

/// States of one body, one at least. Reported as the body is the first.
using Fillings = std::vector<Filling>;

/// Moments of the part below the plane z = level, those of degree 2 left 0. Exact for a closed
/// polyhedron.
Moments momentsBelow(const Points& vertices, const Faces& faces, double level);

/// The same, and the exact rates (n×4) when vertex i moves along row i of `directions`. Continuous
/// while no face lies in the plane. [docs/math.md "Contents up to a level"]
MomentsWithRates momentsBelowWithRates(const Points& vertices, const Faces& faces,
                                       const Points& directions, double level);

/// Mass moments in each state of a body of density 1 between the two surfaces, of which `outer` has
/// these moments and the inner one is given outward. Degree 2 leaves partial contents out.
std::vector<Moments> filledMoments(const Moments& outer, const Points& inner, const Faces& faces,
                                   const Fillings& fillings);

} // namespace massprops
