// How much of a body is under water, as the water rises along one direction.
#pragma once

#include "core/base/types.h"

#include <vector>

namespace massprops {

/// A closed surface as seen by water whose surface is level: of each face its shadow and the
/// heights of its corners. What hydrostatics asks most often needs no more.
/// docs/math.md "Displaced volume"
class Immersion {
public:
  /// `up`: unit, in the body's frame.
  Immersion(const Points& vertices, const Faces& faces, const Vec3& up);

  struct Sums {
    double volume = 0.0; ///< of the part below the level
    double area = 0.0;   ///< of the waterplane
    double depths = 0.0; ///< ∫(level − up·x) over that part, length⁴
  };
  /// `level`: as up·x.
  Sums below(double level) const;

  /// The level at which the body displaces `volume`, between 0 and the body's own, but for
  /// roundings.
  double levelFor(double volume) const;

private:
  /// `shadow`: area of the face's projection along `up`, positive where it looks up. Heights over
  /// the lowest point.
  struct Face {
    double shadow, low, middle, high;
  };

  std::vector<Face> faces_;
  double lowest_, height_;
};

} // namespace massprops
