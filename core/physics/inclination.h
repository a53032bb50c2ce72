// A body inclined in the water at constant displacement, and the potential energy of that.
#pragma once

#include "core/base/types.h"

namespace massprops {

/// Lengths in any unit.
struct FloatingBody {
  Points vertices;        ///< of the outer surface, n×3
  Faces faces;            ///< closed, outward
  Vec3 centre;            ///< of mass
  double displaced = 0.0; ///< volume of water as heavy as the body
  /// Of openings that the surface has lids over, k×3: where one gets under water the body fills.
  Points rims;
  double volume = 0.0;        ///< inside of the surface
  Vec3 middle = Vec3::Zero(); ///< its centroid
};

/// \pre 0 < `displaced`
FloatingBody floatingBody(Points vertices, Faces faces, const Vec3& centre, double displaced,
                          Points rims = Points(0, 3));

/// A body whose weight is within this share of all the water's that it can displace is neutral
/// under water: it hovers.
constexpr double kNeutral = 1e-4;

/// What rounding makes of a lever or a metacentric height of 0, in the body's unit, which is its
/// diagonal where it counts.
constexpr double kNoLever = 1e-9;

/// A search for a pose turns the body by no more than this in a step, radians: waterlines, and with
/// them what is known of the energy, change from there on.
constexpr double kMostTurn = 0.1;

bool sinks(const FloatingBody& body);
bool isUnderWater(const FloatingBody& body);

/// The body held with `up` (unit, in the body's frame) upwards, free to rise and sink.
struct Inclination {
  Vec3 up;
  double level;   ///< of the water, as up·x; under water that of the highest point
  Vec3 arm;       ///< c − B, from the centre of buoyancy to that of mass
  double energy;  ///< potential energy over the weight, less a constant: arm·up
  Mat3 stiffness; ///< J/V: second moment of the waterplane over the displaced volume
  bool isDry;     ///< no rim of an opening is under water

  /// For a turn of `up` towards `t`, unit and horizontal: the righting lever, positive where it
  /// turns back, and the metacentric height, which is the lever's rate by the angle.
  double lever(const Vec3& t) const { return arm.dot(t); }
  double metacentricHeight(const Vec3& t) const { return t.dot(stiffness * t) - energy; }
};

/// Exact. \pre the body does not sink. docs/math.md "Floating pose"
Inclination inclined(const FloatingBody& body, const Vec3& up);

/// Its `energy` alone, in some half of the time.
double inclinedEnergy(const FloatingBody& body, const Vec3& up);

/// Two horizontal unit vectors, orthogonal to each other, one a column.
using Horizontal = Eigen::Matrix<double, 3, 2>;
Horizontal horizontal(const Vec3& up);

} // namespace massprops
